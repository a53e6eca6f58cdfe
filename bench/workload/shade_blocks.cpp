#include "bench/workload/shade_blocks.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "base/parallel.hpp"

namespace tessera::workload {
namespace {

constexpr std::size_t film_bytes = std::size_t{width} * height * 4 * sizeof(float), huge_page = std::size_t{1} << 21;

void shade_block(const Kernels& kernels, const BlockedGBuffer& gbuffer, const Surroundings& surroundings,
                 const LightSet& lights, const Film& film, int block) {
  alignas(64) float radiance[3][block_pixels];
  ShadeArgs args{};
  args.gbuffer = gbuffer.block(block);
  args.count = block_pixels;
  args.features = feature_lights | feature_environment;
  std::copy(surroundings.eye, surroundings.eye + 4, args.eye);
  if (lights.offsets.empty()) {
    args.lights = lights.lights.data();
    args.light_count = std::uint32_t(lights.lights.size());
  } else {
    args.lights = lights.listed.data() + lights.offsets[std::size_t(block)];
    args.light_count = lights.offsets[std::size_t(block) + 1] - lights.offsets[std::size_t(block)];
  }
  args.environment = surroundings.environment;
  args.dfg = surroundings.dfg;
  for (int k = 0; k < 3; ++k) args.radiance[k] = radiance[k];
  kernels.shade(args);

  const int x0 = block % blocks_x * block_size, y0 = block / blocks_x * block_size;
  for (int y = 0; y < std::min(block_size, height - y0); ++y) {
    float* out = film.rgba() + (std::size_t(y0 + y) * width + std::size_t(x0)) * 4;
    for (int x = 0; x < block_size; ++x) {
      for (int k = 0; k < 3; ++k) out[4 * x + k] = radiance[k][y * block_size + x];
      out[4 * x + 3] = 1;
    }
  }
}

}  // namespace

Film::Film() : rgba_(static_cast<float*>(std::aligned_alloc(huge_page, (film_bytes / huge_page + 1) * huge_page))) {
  if (rgba_ == nullptr) throw std::bad_alloc();
  madvise(rgba_, film_bytes, MADV_HUGEPAGE);
  std::fill_n(rgba_, film_bytes / sizeof(float), 0.0f);
}

Film::~Film() { std::free(rgba_); }

void shade_blocks(const Kernels& kernels, const BlockedGBuffer& gbuffer, const Surroundings& surroundings,
                  const LightSet& lights, const Film& film) {
  // A row of blocks is a task: neighbours in memory stay on one core, and there are enough rows to even out.
  parallel_for(blocks_y, [&](std::size_t row) {
    for (int x = 0; x < blocks_x; ++x)
      shade_block(kernels, gbuffer, surroundings, lights, film, int(row) * blocks_x + x);
  });
}

}  // namespace tessera::workload
