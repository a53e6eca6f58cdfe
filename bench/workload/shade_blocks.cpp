#include "bench/workload/shade_blocks.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace tessera::workload {
namespace {

struct BlockShader {
  const Kernels& kernels;
  const BlockedGBuffer& gbuffer;
  const LightSet& lights;
  float* rgba;
  ShadeArgs args{};  // what all blocks share

  // a: a copy of args.
  void shade(int block, ShadeArgs& a) const {
    std::uint32_t list[most_lights];
    gbuffer.view_block(block, a.gbuffer);
    if (lights.culled) {
      const GBufferView& g = a.gbuffer;
      a.light_count = kernels.cull_lights(
          {{g.position[0], g.position[1], g.position[2]}, block_pixels, lights.bounds.view(), list});
      a.light_list = list;
    } else if (!lights.offsets.empty()) {
      const std::uint32_t* offset = lights.offsets.data() + block;
      a.light_count = offset[1] - offset[0];
      a.light_list = lights.indices.data() + offset[0];
    }
    const int across = gbuffer.blocks_x(), x = block % across * block_size, y = block / across * block_size;
    a.count = std::uint32_t(block_size * std::min(block_size, gbuffer.height() - y));
    a.film = {rgba + (std::size_t(y) * std::size_t(gbuffer.width()) + std::size_t(x)) * 4,
              std::size_t{4} * std::size_t(gbuffer.width()), block_size / 4};
    kernels.shade(a);
  }
};

}  // namespace

void shade_blocks(const Kernels& kernels, const BlockedGBuffer& gbuffer, const Surroundings& surroundings,
                  const LightSet& lights, float* rgba) {
  BlockShader shader{kernels, gbuffer, lights, rgba};
  shader.args.count = block_pixels;
  shader.args.features = feature_lights | feature_environment;
  std::copy(surroundings.eye, surroundings.eye + 4, shader.args.eye);
  shader.args.lights = lights.lights.data();
  shader.args.light_count = std::uint32_t(lights.lights.size());
  shader.args.environment = surroundings.environment;
  shader.args.dfg = surroundings.dfg.view();
  shader.args.fetch_ahead = 2 * block_floats;  // the next block but one
  // Neighbours in memory stay on one core; and tasks are short, so that no core waits long for another's last one.
  constexpr int blocks_per_task = 15;
  const int blocks = gbuffer.blocks();
  parallel_for(std::size_t((blocks + blocks_per_task - 1) / blocks_per_task), [&](std::size_t task) {
    const int first = int(task) * blocks_per_task;
    ShadeArgs args = shader.args;
    for (int block = first; block < std::min(first + blocks_per_task, blocks); ++block) shader.shade(block, args);
  });
}

}  // namespace tessera::workload
