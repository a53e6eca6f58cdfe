#include "kernels/entry/entries.hpp"
#include "kernels/raster/project.hpp"
#include "kernels/raster/setup_vector.hpp"

namespace tessera::TESSERA_ISA {

void project_vertices(const ViewTransform& view, const float* positions, std::uint32_t count, ProjectedVertex* out) {
  for (std::uint32_t first = 0; first < count; first += Float::lanes) {
    // The last vector repeats the last vertex: nothing is read or written past the end.
    const std::uint32_t left = count - first;
    const int used = left < std::uint32_t(Float::lanes) ? int(left) : Float::lanes;
    const Int lane = lane_index();
    const Int vertex = select(lane < Int(used), lane, Int(used - 1));
    const Int index = vertex + vertex + vertex;
    const float* p = positions + std::size_t(3) * first;
    Float xyz[3];
    gather_triples(p, index, xyz);
    const Projected<Float> v = project(view, to_clip(view, xyz[0], xyz[1], xyz[2]));
    if (used == Float::lanes) {
      store_quads(reinterpret_cast<float*>(out + first), {from_bits(v.x), from_bits(v.y), v.depth, from_bits(v.flags)});
      continue;
    }
    alignas(64) std::int32_t x[Float::lanes], y[Float::lanes], flags[Float::lanes];
    alignas(64) float depth[Float::lanes];
    store(x, v.x);
    store(y, v.y);
    store(depth, v.depth);
    store(flags, v.flags);
    for (int i = 0; i < used; ++i) out[first + i] = {x[i], y[i], depth[i], std::uint32_t(flags[i])};
  }
}

std::uint32_t setup_triangles(const SetupTrianglesArgs& args) {
  const SamplePattern pattern = standard_pattern(args.samples);
  const SampleExtent extent = sample_extent(pattern);
  args.counters->in += args.count;
  std::uint32_t written = 0;
  if (args.geometry.vertex_count > max_gathered_vertices) {
    for (std::uint32_t i = 0; i < args.count; ++i)
      written += setup_one_more(args, pattern, extent, args.first + i, written);
    return written;
  }
  for (std::uint32_t i = 0; i < args.count; i += std::uint32_t(Int::lanes)) {
    const int count = static_cast<int>(min(std::int64_t(args.count - i), std::int64_t(Int::lanes)));
    written += setup_vector(args, pattern, extent, args.first + i, count, written);
  }
  return written;
}

}  // namespace tessera::TESSERA_ISA
