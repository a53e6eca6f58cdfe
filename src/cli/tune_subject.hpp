// What `tune` measures: frames of one scene under different settings.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "cli/picture.hpp"
#include "frame/frame.hpp"
#include "frame/picture_error.hpp"
#include "precompute/environment.hpp"

namespace tessera::cli {

/// One environment in several sizes, each baked when it is first asked for.
class Environments {
 public:
  using Bake = std::function<std::unique_ptr<Environment>(int size)>;
  /// first: what is there, with reflections of its size; may be null. bake: null if there are no others.
  Environments(std::unique_ptr<Environment> first, Bake bake);
  /// size 0: the first.
  const Environment* get(int size);

 private:
  std::unique_ptr<Environment> first_;
  Bake bake_;
  std::map<int, std::unique_ptr<Environment>> others_;  // by size
};

/// Compares frames with the exact one as a display shows them. Keeps references to what it is made of.
class TuneSubject {
 public:
  TuneSubject(Renderer& renderer, Environments& environments, const View& view, const Look& look,
              const Kernels& kernels)
      : renderer_(renderer), environments_(environments), view_(view), look_(look), kernels_(kernels) {}

  /// Renders with settings that become the exact ones. Returns the number of pixels that show any of the scene: the
  /// errors are over these.
  std::size_t set_exact(const RenderSettings& settings);
  PictureError error(const RenderSettings& settings);
  double frame_ms(const RenderSettings& settings);
  /// Of the last frame.
  [[nodiscard]] const FrameStatistics& statistics() const { return frame_.statistics; }

 private:
  // Renders, and encodes as the picture's RGB bytes.
  std::vector<unsigned char> shown(const RenderSettings& settings, const FrameRequest& request);
  void light(const RenderSettings& settings);

  Renderer& renderer_;
  Environments& environments_;
  const View& view_;
  const Look look_;
  const Kernels& kernels_;
  Frame frame_;
  std::vector<unsigned char> exact_;
  std::vector<std::uint8_t> counts_;  // 1 for a pixel that shows any of the scene
};

}  // namespace tessera::cli
