// What `tune` measures: frames of one scene under different settings.
#pragma once
#include <vector>

#include "cli/picture.hpp"
#include "frame/frame.hpp"
#include "frame/picture_error.hpp"

namespace tessera::cli {

/// Compares frames with the exact one as a display shows them. Keeps references to what it is made of.
class TuneSubject {
 public:
  TuneSubject(Renderer& renderer, const View& view, const Look& look, const Kernels& kernels)
      : renderer_(renderer), view_(view), look_(look), kernels_(kernels) {}

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

  Renderer& renderer_;
  const View& view_;
  const Look look_;
  const Kernels& kernels_;
  Frame frame_;
  std::vector<unsigned char> exact_;
  std::vector<std::uint8_t> counts_;  // 1 for a pixel that shows any of the scene
};

}  // namespace tessera::cli
