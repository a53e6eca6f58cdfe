// The full frame: triangles to pixels through the renderer's own pipeline.
#pragma once
#include "bench/workload/inputs.hpp"
#include "bench/workload/mesh.hpp"
#include "frame/pipeline.hpp"

namespace tessera::workload {

class FullFrame {
 public:
  FullFrame(const Mesh& mesh, const Surroundings& surroundings, const LightSet& lights, const View& view);
  /// One frame of view's size. Nothing shaded is kept from frame to frame.
  void render(const Kernels& kernels, float* rgba);
  [[nodiscard]] const FrameStatistics& statistics() const { return statistics_; }

 private:
  PreparedScene scene_;
  View view_;
  RenderSettings settings_;
  FramePipeline pipeline_;
  FrameStatistics statistics_;
};

}  // namespace tessera::workload
