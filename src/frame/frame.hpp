// The pipeline: Scene + Environment + View + Settings -> Frame.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/image.hpp"
#include "frame/gbuffer.hpp"
#include "frame/settings.hpp"
#include "frame/statistics.hpp"
#include "frame/view.hpp"
#include "kernels/interface.hpp"
#include "scene/scene.hpp"

namespace tessera {

class Environment;  // precompute/environment.hpp

/// What of a frame is wanted beside the picture.
struct FrameRequest {
  std::vector<std::string> aovs;  // names of aov_names()
  bool gbuffer = false;
};

/// One layer: `components` planes, each width * height, of the fragment that covers most of the pixel (the first of
/// equals).
struct AovLayer {
  std::string name;
  std::vector<std::string> channels;  // "normal.X" ...; one per plane
  std::vector<AlignedVector<float>> f32;
  std::vector<std::uint32_t> u32;  // set instead of f32 for ids: 0 where nothing is seen
};

/// id (triangle + 1), part (+ 1), material (+ 1), depth (distance along the view axis, world units; infinite where
/// nothing is seen), position, normal, albedo, metallic, roughness, occlusion, emissive, alpha, coverage (fraction of
/// the pixel that is covered).
const std::vector<std::string>& aov_names();

struct Frame {
  Image rgba;  // linear, premultiplied, top row first
  std::vector<AovLayer> aovs;
  GBufferImage gbuffer;
  FrameStatistics statistics;
};

/// A scene made ready for rendering: only the tables that its materials and this environment call for. Keeps references
/// to `scene`, `environment` and `kernels`; they must outlive it.
class Renderer {
 public:
  /// environment may be null: lights alone. Tables and textures are made as `first` will ask for them; what later
  /// frames ask for otherwise is made then, once.
  Renderer(const Scene& scene, const Environment* environment, const Kernels& kernels,
           const RenderSettings& first = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// What lights the frames from now on; what was made of earlier ones is kept.
  void set_environment(const Environment* environment);

  /// Fills frame; its memory is reused from call to call. Runs on settings.threads threads.
  /// Throws Error(usage) for settings out of range, for what the environment does not hold, and unknown AOV names.
  void render(const View& view, const RenderSettings& settings, const FrameRequest& request, Frame& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Shades a G-buffer as the frame that wrote it was shaded: the same bits.
void shade_gbuffer(const GBufferImage& gbuffer, const View& view, const std::vector<Light>& lights,
                   const Environment* environment, const RenderSettings& settings, const Kernels& kernels,
                   Frame& frame);

}  // namespace tessera
