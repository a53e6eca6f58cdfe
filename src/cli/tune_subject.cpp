#include "cli/tune_subject.hpp"

#include "base/parallel.hpp"
#include "base/stopwatch.hpp"

namespace tessera::cli {

Environments::Environments(std::unique_ptr<Environment> first, Bake bake)
    : first_(std::move(first)), bake_(std::move(bake)) {}

const Environment* Environments::get(int size) {
  if (size == 0 || first_ == nullptr || first_->data().specular.size() == size) return first_.get();
  std::unique_ptr<Environment>& other = others_[size];
  if (other == nullptr) other = bake_(size);
  return other.get();
}

void TuneSubject::light(const RenderSettings& settings) {
  run_with_threads(settings.threads, [&] { renderer_.set_environment(environments_.get(settings.environment_size)); });
}

std::vector<unsigned char> TuneSubject::shown(const RenderSettings& settings, const FrameRequest& request) {
  light(settings);
  renderer_.render(view_, settings, request, frame_);
  std::vector<unsigned char> rgb;
  run_with_threads(settings.threads, [&] { rgb = encode_picture(look_, frame_.rgba, 3, kernels_); });
  return rgb;
}

std::size_t TuneSubject::set_exact(const RenderSettings& settings) {
  exact_ = shown(settings, {{"coverage"}, false});
  counts_.clear();
  std::size_t pixels = 0;
  for (const float coverage : frame_.aovs.at(0).f32.at(0)) {
    counts_.push_back(coverage > 0 ? 1 : 0);
    pixels += counts_.back();
  }
  return pixels;
}

PictureError TuneSubject::error(const RenderSettings& settings) {
  return picture_error(shown(settings, {}), exact_, counts_);
}

double TuneSubject::frame_ms(const RenderSettings& settings) {
  light(settings);
  const Stopwatch watch;
  renderer_.render(view_, settings, {}, frame_);
  return watch.ms();
}

}  // namespace tessera::cli
