// Writes the inputs of the deferred-shading workload (bench/workload/inputs.hpp lists them):
//   tessera_peer_inputs FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bench/peers/environment.hpp"
#include "bench/peers/scene.hpp"
#include "bench/workload/inputs.hpp"
#include "frame/dispatch.hpp"
#include "precompute/dfg.hpp"

namespace tessera::peers {
namespace {

template <class T>
void write(const std::string& path, const T* values, std::size_t count) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(values), std::streamsize(count * sizeof(T)));
  if (!file) throw output_error("{}: cannot be written", path);
}

// The texels of all levels without their borders.
std::vector<std::uint16_t> plain_texels(const CubeView& cube) {
  std::vector<std::uint16_t> out;
  for (int level = 0; level < cube.levels; ++level) {
    const int n = cube.size >> level;
    for (int k = 0; k < 6 * n; ++k) {
      const std::uint16_t* row = cube.texels + cube_texel_index(cube.size, cube.levels, level, k / n, 0, k % n) * 4;
      out.insert(out.end(), row, row + n * 4);
    }
  }
  return out;
}

void write_environment(const std::string& folder, const Kernels& kernels) {
  const PaintedEnvironment painted = paint_environment(kernels);
  write(folder + "/sh9.f32", &painted.irradiance.coefficients[0][0], 27);
  const std::vector<std::uint16_t> texels = plain_texels(painted.reflections.view());
  write(folder + "/env.rgba16f", texels.data(), texels.size());
}

void write_all(const std::string& folder) {
  const Kernels& kernels = select_kernels("");
  std::filesystem::create_directories(folder);
  const std::vector<float> gbuffer = cast_gbuffer(workload::width, workload::height);
  write(folder + "/w1_gbuffer.f32", gbuffer.data(), gbuffer.size());
  write(folder + "/camera.f32", eye, 4);
  for (const int count : {1, 4, 16}) {
    const std::vector<float> lights = place_lights(count);
    write(folder + "/lights_" + std::to_string(count) + ".f32", lights.data(), lights.size());
  }
  write_environment(folder, kernels);
  const AlignedVector<float> pairs = dfg_pairs(kernels);
  std::vector<std::uint16_t> halves(pairs.size());
  kernels.pack_half(pairs.data(), halves.data(), pairs.size());
  write(folder + "/dfg.rg16f", halves.data(), halves.size());
}

}  // namespace
}  // namespace tessera::peers

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: tessera_peer_inputs FOLDER\n");
    return 2;
  }
  try {
    tessera::peers::write_all(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tessera_peer_inputs: error: %s\n", error.what());
    return 4;
  }
}
