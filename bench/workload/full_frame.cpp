#include "bench/workload/full_frame.hpp"

namespace tessera::workload {

FullFrame::FullFrame(const Mesh& mesh, const Surroundings& surroundings, const LightSet& lights, const View& view)
    : scene_(mesh.scene()), view_(view) {
  scene_.lighting = {lights.lights, surroundings.environment, surroundings.dfg.view(),
                     feature_lights | feature_environment,
                     lights.bounds.worth_culling() ? lights.bounds.view() : LightBoundsView{}};
  settings_.width = view.transform.width;
  settings_.height = view.transform.height;
  settings_.samples = 1;
  settings_.background = Background::color;
  settings_.hash = false;
  settings_.environment_shading = {};  // one lookup along the mirror direction: the workload's own formula
}

void FullFrame::render(const Kernels& kernels, float* rgba) {
  statistics_.clear();
  BackgroundSource black;
  pipeline_.render(scene_, view_, settings_, black, kernels, {rgba, settings_.width, settings_.height}, statistics_);
}

}  // namespace tessera::workload
