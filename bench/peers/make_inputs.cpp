// Writes the inputs of the deferred-shading workload (bench/workload/inputs.hpp lists them):
//   tessera_peer_inputs FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bench/peers/scene.hpp"
#include "bench/workload/inputs.hpp"
#include "frame/dispatch.hpp"
#include "precompute/dfg.hpp"
#include "precompute/irradiance.hpp"
#include "precompute/prefilter.hpp"

namespace tessera::peers {
namespace {

constexpr int cube_size = 256, cube_levels = 9;

template <class T>
void write(const std::string& path, const T* values, std::size_t count) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(values), std::streamsize(count * sizeof(T)));
  if (!file) throw output_error("{}: cannot be written", path);
}

CubeLevel painted_sky() {
  CubeLevel level(cube_size);
  float* texel = level.texels.data();
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < cube_size; ++j)
      for (int i = 0; i < cube_size; ++i, texel += 4) {
        const CubeDirection d = texel_direction(face, i, j, cube_size);
        const Radiance radiance = sky(d.x, d.y, d.z);
        texel[0] = radiance.red, texel[1] = radiance.green, texel[2] = radiance.blue, texel[3] = 1;
      }
  return level;
}

// The texels of all levels without their borders.
std::vector<std::uint16_t> plain_texels(const CubeView& cube) {
  std::vector<std::uint16_t> out;
  for (int level = 0; level < cube.levels; ++level) {
    const std::size_t n = std::size_t(cube.size) >> level, stride = (n + 2) * 4;
    const std::uint16_t* face = cube.texels + cube_level_offset(cube.size, level) * 4;
    for (int f = 0; f < 6; ++f, face += (n + 2) * stride)
      for (std::size_t j = 1; j <= n; ++j) {
        const std::uint16_t* row = face + j * stride + 4;
        out.insert(out.end(), row, row + n * 4);
      }
  }
  return out;
}

void write_environment(const std::string& folder, const Kernels& kernels) {
  const CubeLevel level = painted_sky();
  std::vector<float> rgb;
  for (std::size_t i = 0; i < level.texels.size(); i += 4)
    rgb.insert(rgb.end(), level.texels.data() + i, level.texels.data() + i + 3);
  const IrradianceSh sh = project_irradiance(CubeFacesView{rgb.data(), cube_size}, 0, kernels);
  write(folder + "/sh9.f32", &sh.coefficients[0][0], 27);
  // A curve of 0: level k is for roughness k / 8.
  const std::vector<std::uint16_t> texels = plain_texels(prefiltered(level, cube_levels, 0, kernels, 0).view());
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
  const DfgTable table = build_dfg_table(kernels);
  std::vector<std::uint16_t> halves(table.texels.size());
  kernels.pack_half(table.texels.data(), halves.data(), halves.size());
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
