// Prints a hash of every kernel's output on pseudo-random input, one line per kernel, for each instruction set that
// this CPU runs: "isa kernel hash". All lines of a kernel must agree, here and on every other machine and compiler.
// Uses the kernels alone, so that it can be built for, and run as, another architecture.
//
// To add a kernel: a function that fills inputs from a Random, calls it, and adds what it wrote to a Hash; a row in
// `subjects`.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <memory>
#include <vector>

#include "kernels/interface.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera {
namespace {

// splitmix64: the same numbers with every standard library.
class Random {
 public:
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
  float unit() { return static_cast<float>(next() >> 40) * 0x1p-24f; }
  float between(float low, float high) { return low + (high - low) * unit(); }
  float any_bits() { return std::bit_cast<float>(static_cast<std::uint32_t>(next())); }
  std::vector<float> units(std::size_t count, float low = 0, float high = 1) {
    std::vector<float> out(count);
    for (float& x : out) x = between(low, high);
    return out;
  }

 private:
  std::uint64_t state_ = 1;
};

// FNV-1a over 32-bit words; one NaN for all.
class Hash {
 public:
  void add(std::uint32_t word) { value_ = (value_ ^ word) * 0x100000001b3u; }
  void add(float x) { add(x != x ? 0x7fc00000u : std::bit_cast<std::uint32_t>(x)); }
  template <class T>
  void add(const std::vector<T>& values) {
    for (const T& x : values) add(x);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

void hash_evaluate(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr std::size_t count = 20011;
  std::vector<float> a(count), b(count), out(count);
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = i % 2 ? random.any_bits() : random.between(-4, 4);
    b[i] = i % 2 ? random.any_bits() : random.between(-4, 4);
  }
  for (int f = 0; f <= static_cast<int>(MathFunction::float_to_half); ++f) {
    kernels.evaluate(static_cast<MathFunction>(f), a.data(), b.data(), out.data(), count);
    hash.add(out);
  }
}

void hash_bsdf(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr std::size_t count = 5003;
  std::vector<std::vector<float>> in;
  for (int k = 0; k < max_term_inputs; ++k) in.push_back(random.units(count));
  std::vector<float> out(count + max_lanes);
  for (const BsdfTerm term : {BsdfTerm::D_GGX, BsdfTerm::V_SmithGGXCorrelated, BsdfTerm::F_Schlick, BsdfTerm::DV_GGX}) {
    BsdfTermArgs args{term, {}, out.data(), count};
    for (int k = 0; k < max_term_inputs; ++k) args.in[k] = in[static_cast<std::size_t>(k)].data();
    kernels.evaluate_bsdf(args);
    hash.add(std::vector<float>(out.begin(), out.begin() + count));
  }
}

void hash_encode(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr std::size_t count = 4099;
  std::vector<float> rgba(4 * count);
  for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = i % 16 ? random.unit() : random.any_bits();
  for (int curve = 0; curve <= static_cast<int>(ToneCurve::khronos_neutral); ++curve) {
    std::vector<std::uint8_t> out(4 * count);
    kernels.encode({rgba.data(), count, 1.3f, static_cast<ToneCurve>(curve), out.data()});
    for (const std::uint8_t byte : out) hash.add(std::uint32_t{byte});
  }
}

void hash_downsample(const Kernels& kernels, Random& random, Hash& hash) {
  const int sizes[][2] = {{64, 32}, {37, 22}, {1, 9}, {5, 5}};
  for (const auto& [width, height] : sizes) {
    const std::vector<float> in = random.units(std::size_t{4} * width * height);
    std::vector<float> out(std::size_t{4} * std::max(1, width / 2) * std::max(1, height / 2));
    kernels.downsample({in.data(), width, height, out.data()});
    hash.add(out);
  }
}

void hash_halves(const Kernels& kernels, Random& random, Hash& hash) {
  std::vector<float> in(5001), out(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = i % 2 ? random.any_bits() : random.between(-1e-4f, 1e-4f);
  std::vector<std::uint16_t> halves(in.size());
  kernels.pack_half(in.data(), halves.data(), in.size());
  kernels.unpack_half(halves.data(), out.data(), out.size());
  for (const std::uint16_t half : halves) hash.add(std::uint32_t{half});
  hash.add(out);
}

// A camera that looks down the z axis at [-2, 2]^3, and random triangles there.
struct Soup {
  static constexpr int width = 100, height = 70;
  std::vector<float> positions;
  std::vector<VertexAttributes> attributes;
  std::vector<Triangle> triangles;
  ViewTransform view{
      {60, 0, -50, 200}, {0, -60, -35, 140}, {0, 0, 0, 0.1f}, {0, 0, -1, 4}, {0, 0, 4, 1}, width, height};

  explicit Soup(Random& random) {
    for (std::uint32_t i = 0; i < 400; ++i) {
      const float center[3] = {random.between(-2, 2), random.between(-2, 2), random.between(-2, 4.5f)};
      const float size = random.unit();
      for (int k = 0; k < 3; ++k) {
        for (const float c : center) positions.push_back(c + size * random.between(-1, 1));
        VertexAttributes v{};
        v.normal[2] = 1;
        for (auto& set : v.uv)
          for (float& x : set) x = random.unit();
        for (float& x : v.color) x = random.unit();
        attributes.push_back(v);
      }
      triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0});
    }
  }
  GeometryView geometry() const {
    return {positions.data(), attributes.data(), triangles.data(), static_cast<std::uint32_t>(attributes.size()),
            static_cast<std::uint32_t>(triangles.size())};
  }
};

void hash_raster(const Kernels& kernels, Random& random, Hash& hash) {
  const Soup soup(random);
  const GeometryView geometry = soup.geometry();
  std::vector<ProjectedVertex> projected(geometry.vertex_count + max_lanes);
  kernels.project_vertices(soup.view, soup.positions.data(), geometry.vertex_count, projected.data());
  for (std::uint32_t i = 0; i < geometry.vertex_count; ++i) {
    hash.add(projected[i].flags);
    if (projected[i].flags & needs_clip) continue;
    hash.add(static_cast<std::uint32_t>(projected[i].x));
    hash.add(static_cast<std::uint32_t>(projected[i].y));
    hash.add(projected[i].depth);
  }
  const std::uint8_t double_sided = 1;
  for (const int samples : {1, 4, 16}) {
    std::vector<SetupTriangle> setup(std::size_t{max_setup_per_triangle} * geometry.triangle_count);
    GeometryCounters counters{};
    const std::uint32_t count = kernels.setup_triangles({geometry, soup.view, projected.data(), &double_sided, samples,
                                                         0, geometry.triangle_count, setup.data(), &counters});
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < count; ++i) {
      list.push_back(i);
      for (int k = 0; k < 3; ++k) hash.add(static_cast<std::uint32_t>(setup[i].x[k] ^ setup[i].y[k] << 16));
      for (const float x : {setup[i].depth, setup[i].depth_dx, setup[i].depth_dy}) hash.add(x);
    }
    struct alignas(64) Planes {
      float depth[tile_pixels * max_samples];
      std::uint32_t triangle[tile_pixels * max_samples];
    };
    const auto planes = std::make_unique<Planes>();
    const auto fragments = std::vector<Fragment>(std::size_t{tile_pixels} * samples + max_lanes);
    for (int y = 0; y < Soup::height; y += tile_size)
      for (int x = 0; x < Soup::width; x += tile_size) {
        const VisibilityTile tile{x,
                                  y,
                                  std::min(tile_size, Soup::width - x),
                                  std::min(tile_size, Soup::height - y),
                                  samples,
                                  planes->depth,
                                  planes->triangle};
        RasterCounters raster{};
        kernels.clear_visibility(tile);
        kernels.rasterize_opaque({tile, setup.data(), list.data(), count}, &raster);
        std::vector<Fragment> visible = fragments;
        visible.resize(kernels.collect_visible(tile, visible.data()));
        for (const Fragment& f : visible) {
          hash.add(f.triangle);
          hash.add(std::uint32_t{f.pixel} << 16 | f.samples);
          for (int s = 0; s < samples; ++s)
            if (f.samples >> s & 1) hash.add(planes->depth[s * tile_pixels + f.pixel]);
        }
      }
  }
}

// Plane after plane, each on a 64-byte boundary.
class GBuffer {
 public:
  static constexpr std::size_t count = 997, capacity = 1024;
  static_assert(capacity % max_lanes == 0);
  struct alignas(64) Plane {
    float values[capacity];
  };
  std::vector<Plane> planes{gbuffer_planes};

  GBufferView view() {
    std::size_t next = 0;
    const auto plane = [&] { return planes[next++].values; };
    GBufferView v{};
    for (float*& p : v.position) p = plane();
    for (float*& p : v.normal) p = plane();
    for (float*& p : v.base_color) p = plane();
    v.metallic = plane();
    v.roughness = plane();
    v.occlusion = plane();
    for (float*& p : v.emissive) p = plane();
    v.alpha = plane();
    v.unlit = plane();
    v.depth = plane();
    return v;
  }
};

std::vector<std::uint16_t> random_cube(const Kernels& kernels, Random& random, int size, int levels) {
  const std::vector<float> texels = random.units(4 * cube_level_offset(size, levels), 0, 3);
  std::vector<std::uint16_t> halves(texels.size());
  kernels.pack_half(texels.data(), halves.data(), halves.size());
  return halves;
}

void hash_shade(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr int size = 16, levels = 5, dfg_size = 16;
  const std::vector<std::uint16_t> cube = random_cube(kernels, random, size, levels);
  std::vector<float> dfg(2 * dfg_size * dfg_size);
  kernels.dfg_table({dfg.data(), dfg_size, 0, dfg_size});
  hash.add(dfg);

  GBuffer gbuffer;
  for (auto& plane : gbuffer.planes)
    for (float& x : plane.values) x = random.unit();
  const GBufferView g = gbuffer.view();
  for (std::size_t i = 0; i < GBuffer::capacity; ++i) {
    g.unlit[i] = i % 16 == 0;
    const float z = random.between(-1, 1), r = __builtin_sqrtf(1 - z * z);
    const bool along_x = i % 2;
    for (int k = 0; k < 3; ++k) g.position[k][i] = random.between(-3, 3);
    g.normal[0][i] = along_x ? r : 0;
    g.normal[1][i] = along_x ? 0 : r;
    g.normal[2][i] = z;
    if (i % 8 == 1)  // hostile values: any bits in one plane
      gbuffer.planes[i % gbuffer_planes].values[i] = random.any_bits();
  }
  const LightView lights[] = {
      {LightType::directional, Falloff::inverse_square, {0, 0, 0}, {0, -1, 0}, {1, 2, 3}, 0, 0, 1},
      {LightType::point, Falloff::windowed_plus_one, {1, 2, 1}, {0, -1, 0}, {9, 9, 5}, 0.04f, 0, 1},
      {LightType::spot, Falloff::inverse_square, {-2, 2, 0}, {0.6f, -0.8f, 0}, {20, 10, 10}, 0, 3, -2},
  };
  EnvironmentView environment{{cube.data(), size, levels}, {cube.data(), size, levels}, {}};
  for (auto& coefficient : environment.irradiance_sh)
    for (float& x : coefficient) x = random.between(-0.2f, 0.5f);
  std::vector<GBuffer::Plane> radiance(3);
  kernels.shade({g,
                 GBuffer::count,
                 feature_all,
                 {0, 1, 6, 1},
                 lights,
                 3,
                 environment,
                 {dfg.data(), dfg_size},
                 {radiance[0].values, radiance[1].values, radiance[2].values}});
  for (const auto& plane : radiance)
    for (std::size_t i = 0; i < GBuffer::count; ++i) hash.add(plane.values[i]);

  for (std::size_t i = 0; i < GBuffer::capacity; ++i) {
    g.position[0][i] = static_cast<float>(i % 32);
    g.position[1][i] = static_cast<float>(i / 32);
  }
  for (const float lod : {0.0f, 1.7f, 9.0f}) {
    kernels.background({{-1, 1, -1},
                        {0.07f, 0, 0},
                        {0, -0.07f, 0},
                        environment.background,
                        lod,
                        g.position[0],
                        g.position[1],
                        GBuffer::count,
                        {radiance[0].values, radiance[1].values, radiance[2].values}});
    for (const auto& plane : radiance)
      for (std::size_t i = 0; i < GBuffer::count; ++i) hash.add(plane.values[i]);
  }
}

void hash_environment(const Kernels& kernels, Random& random, Hash& hash) {
  constexpr int size = 16, levels = 5, samples = 37;
  const std::vector<float> equirect = random.units(3 * 64 * 32);
  const std::vector<std::uint16_t> cube = random_cube(kernels, random, size, levels);
  std::vector<float> lobe[5];
  for (std::vector<float>& values : lobe) values.resize(samples + max_lanes);
  for (int i = 0; i < samples; ++i) {
    const float z = random.between(0.2f, 1), r = __builtin_sqrtf(1 - z * z);
    lobe[0][i] = i % 2 ? r : 0;
    lobe[1][i] = i % 2 ? 0 : -r;
    lobe[2][i] = z;
    lobe[3][i] = 1.0f / samples;
    lobe[4][i] = random.between(0, 4);
  }
  for (int face = 0; face < 6; ++face) {
    std::vector<float> out(4 * size * size + max_lanes);
    kernels.equirect_to_cube({{equirect.data(), 64, 32}, {0.8f, 0.6f}, 2, {face, size, 0, size, out.data()}});
    hash.add(std::vector<float>(out.begin(), out.begin() + 4 * size * size));
    kernels.prefilter_cube({{cube.data(), size, levels},
                            {lobe[0].data(), lobe[1].data(), lobe[2].data(), lobe[3].data(), lobe[4].data(), samples},
                            {face, size, 0, size, out.data()}});
    hash.add(std::vector<float>(out.begin(), out.begin() + 4 * size * size));
  }
}

struct Subject {
  const char* name;
  void (*run)(const Kernels&, Random&, Hash&);
};
const Subject subjects[] = {
    {"evaluate", hash_evaluate},     {"evaluate_bsdf", hash_bsdf},      {"encode", hash_encode},
    {"downsample", hash_downsample}, {"halves", hash_halves},           {"raster", hash_raster},
    {"shade", hash_shade},           {"environment", hash_environment},
};

}  // namespace
}  // namespace tessera

int main() {
  using namespace tessera;
  for (const Kernels* kernels : runnable_kernels())
    for (const Subject& subject : subjects) {
      Random random;
      Hash hash;
      subject.run(*kernels, random, hash);
      std::printf("%s %s %016llx\n", kernels->isa, subject.name, static_cast<unsigned long long>(hash.value()));
    }
}
