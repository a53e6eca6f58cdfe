#include "bench/workload/inputs.hpp"

#include <algorithm>
#include <fstream>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "frame/dispatch.hpp"

namespace tessera::workload {

template <class T>
std::vector<T> read_array(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw input_error("{}: cannot be opened", path);
  const auto bytes = static_cast<std::size_t>(file.tellg());
  std::vector<T> values(bytes / sizeof(T));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(values.data()), std::streamsize(values.size() * sizeof(T)));
  if (!file) throw input_error("{}: cannot be read", path);
  return values;
}

template std::vector<float> read_array(const std::string&);
template std::vector<std::uint16_t> read_array(const std::string&);
template std::vector<std::uint32_t> read_array(const std::string&);

namespace {

template <class T>
std::vector<T> read_exactly(const std::string& path, std::size_t count) {
  std::vector<T> values = read_array<T>(path);
  if (values.size() != count) throw input_error("{}: holds {} values, expected {}", path, values.size(), count);
  return values;
}

constexpr int cube_size = 256, cube_levels = 9, dfg_size = 128;

}  // namespace

static DfgTable read_dfg(const std::string& path, const Kernels& kernels) {
  const auto halves = read_exactly<std::uint16_t>(path, std::size_t{2} * dfg_size * dfg_size);
  std::vector<float> pairs(halves.size());
  kernels.unpack_half(halves.data(), pairs.data(), halves.size());
  return {pairs.data(), dfg_size};
}

Surroundings::Surroundings(const std::string& folder, const Kernels& kernels)
    : cube(cube_size, cube_levels), dfg(read_dfg(folder + "/dfg.rg16f", kernels)) {
  const auto camera = read_exactly<float>(folder + "/camera.f32", 4);
  std::copy(camera.begin(), camera.end(), eye);
  std::size_t texels = 0;
  for (int level = 0; level < cube_levels; ++level)
    texels += std::size_t{6} * (cube_size >> level) * (cube_size >> level);
  const auto halves = read_exactly<std::uint16_t>(folder + "/env.rgba16f", 4 * texels);
  std::size_t offset = 0;
  for (int level = 0; level < cube_levels; ++level) {
    CubeLevel floats(cube_size >> level);
    kernels.unpack_half(halves.data() + offset, floats.texels.data(), floats.texels.size());
    offset += floats.texels.size();
    cube.store(level, floats, kernels);
  }
  environment.specular = cube.view();
  const auto sh = read_exactly<float>(folder + "/sh9.f32", 27);
  for (int i = 0; i < 27; ++i) environment.irradiance_sh[i / 3][i % 3] = sh[std::size_t(i)];
}

// As FilmBlocks have it.
static std::size_t store_order(int x, int y) {
  return std::size_t(y / 4 * 4 * block_size + x / 4 * 16 + y % 4 * 4 + x % 4);
}

Surroundings::Surroundings(Cube prefiltered, const IrradianceSh& sh, DfgTable table, const float* eye_position)
    : cube(std::move(prefiltered)), dfg(std::move(table)) {
  std::copy_n(eye_position, 4, eye);
  environment.specular = cube.view();
  std::copy_n(&sh.coefficients[0][0], 27, &environment.irradiance_sh[0][0]);
}

BlockedGBuffer::BlockedGBuffer(const std::string& folder)
    : BlockedGBuffer(
          read_exactly<float>(folder + "/w1_gbuffer.f32", std::size_t{planes} * workload::width * workload::height),
          workload::width, workload::height) {}

BlockedGBuffer::BlockedGBuffer(const std::vector<float>& raw, int width, int height)
    : width_(width), height_(height), values_(std::size_t(blocks()) * block_floats) {
  float* const values = values_.data();
  const auto w = std::size_t(width), h = std::size_t(height);
  for (std::size_t p = 0; p < planes; ++p)
    for (std::size_t y = 0; y < h; ++y)
      for (std::size_t x = 0; x < w; ++x) {
        const std::size_t block = y / block_size * std::size_t(blocks_x()) + x / block_size;
        values[(block * planes + p) * block_pixels + store_order(int(x % block_size), int(y % block_size))] =
            raw[(p * h + y) * w + x];
      }
  const Kernels& kernels = select_kernels();
  parallel_for(std::size_t(blocks()), [&](std::size_t i) {
    GBufferView view{};
    view_block(int(i), view);
    kernels.clamp_surfaces(view, block_pixels);
  });
}

BlockedGBuffer::BlockedGBuffer(const BlockedGBuffer& other, int width, int height)
    : width_(width), height_(height), values_(std::size_t(blocks()) * block_floats) {
  parallel_for(std::size_t(blocks()), [&](std::size_t i) {
    std::copy_n(other.values_.data() + i % std::size_t(other.blocks()) * block_floats, block_floats,
                values_.data() + i * block_floats);
  });
}

void BlockedGBuffer::view_block(int index, GBufferView& view) const {
  float* const base = values_.data() + std::size_t(index) * block_floats;
  const auto plane = [&](int p) { return base + std::size_t(p) * block_pixels; };
  for (int k = 0; k < 3; ++k) {
    view.position[k] = plane(k);
    view.normal[k] = plane(3 + k);
    view.base_color[k] = plane(6 + k);
  }
  view.metallic = plane(9);
  view.roughness = plane(10);
  view.occlusion = plane(11);
}

LightSet::LightSet(const std::vector<float>& records) {
  for (std::size_t i = 0; i + 8 <= records.size(); i += 8) {
    LightView light{};
    light.type = LightType::point;
    light.falloff = Falloff::windowed_plus_one;
    for (std::size_t k = 0; k < 3; ++k) {
      light.position[k] = records[i + k];
      light.color[k] = records[i + 4 + k];
    }
    light.inverse_range_squared = 1 / (records[i + 3] * records[i + 3]);
    lights.push_back(light);
  }
  bounds = LightBounds(lights);
}

namespace {
// "L256t" -> "256"
std::string count_of(const std::string& variant) {
  const bool lettered = variant.ends_with('t') || variant.ends_with('c');
  return variant.substr(1, variant.size() - (lettered ? 2 : 1));
}
}  // namespace

LightSet::LightSet(const std::string& folder, const std::string& variant)
    : LightSet(read_array<float>(folder + "/lights_" + count_of(variant) + ".f32")) {
  const std::string count = count_of(variant);
  culled = variant.ends_with('c');
  if (!variant.ends_with('t')) return;
  constexpr int tiles = (width + block_size - 1) / block_size * ((height + block_size - 1) / block_size);
  offsets = read_exactly<std::uint32_t>(folder + "/tiles_" + count + ".off.u32", std::size_t{tiles} + 1);
  indices = read_array<std::uint32_t>(folder + "/tiles_" + count + ".idx.u32");
  for (const std::uint32_t index : indices)
    if (index >= lights.size())
      throw input_error("{}/tiles_{}.idx.u32: light {} of {}", folder, count, index, lights.size());
  if (offsets.back() > indices.size()) throw input_error("{}/tiles_{}.off.u32: points past the lists", folder, count);
}

}  // namespace tessera::workload
