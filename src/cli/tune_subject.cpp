#include "cli/tune_subject.hpp"

#include "base/parallel.hpp"
#include "base/stopwatch.hpp"

namespace tessera::cli {

std::vector<unsigned char> TuneSubject::shown(const RenderSettings& settings, const FrameRequest& request) {
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
  const Stopwatch watch;
  renderer_.render(view_, settings, {}, frame_);
  return watch.ms();
}

}  // namespace tessera::cli
