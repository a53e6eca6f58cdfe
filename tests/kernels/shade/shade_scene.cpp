#include "kernels/shade/shade_scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/half.hpp"
#include "precompute/dfg.hpp"

namespace tessera::test {
namespace {

using reference::Vec3;

constexpr int dfg_size = 32;

// Nearest half of a value in [2^-14, 65504], or 0.
std::uint16_t to_half(double value) {
  if (value < 0x1p-14) return 0;
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);     // in [0.5, 1)
  const int scaled = int(std::nearbyint(mantissa * 2048));  // in [1024, 2048]
  return std::uint16_t((exponent + 14) * 1024 + scaled - 1024);
}

// OpenGL 4.6, table 8.19, solved for the direction: s, t in [-1,1].
Vec3 face_direction(int face, double s, double t) {
  switch (face) {
    case 0:
      return {1, -t, -s};
    case 1:
      return {-1, -t, s};
    case 2:
      return {s, 1, t};
    case 3:
      return {s, -1, -t};
    case 4:
      return {s, -t, 1};
    default:
      return {-s, -t, -1};
  }
}

// The same table read forwards.
int face_of(const Vec3& d, double* s, double* t) {
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  if (ax >= ay && ax >= az) return *s = (d.x < 0 ? d.z : -d.z) / ax, *t = -d.y / ax, d.x < 0 ? 1 : 0;
  if (ay >= az) return *s = d.x / ay, *t = (d.y < 0 ? -d.z : d.z) / ay, d.y < 0 ? 3 : 2;
  return *s = (d.z < 0 ? -d.x : d.x) / az, *t = -d.y / az, d.z < 0 ? 5 : 4;
}

double lerp(double a, double b, double t) { return a + (b - a) * t; }
Vec3 lerp(const Vec3& a, const Vec3& b, double t) { return a + (b - a) * t; }

// (A, B) by quadrature; the same for every environment.
const DfgTable& dfg_table() {
  static const DfgTable table = [] {
    std::vector<float> pairs;
    for (int j = 0; j < dfg_size; ++j)
      for (int i = 0; i < dfg_size; ++i) {
        const double r = (j + 0.5) / dfg_size;
        const auto albedo = reference::directional_albedo((i + 0.5) / dfg_size, r * r, 24);
        pairs.push_back(float(albedo.A));
        pairs.push_back(float(albedo.B));
      }
    return DfgTable(pairs.data(), dfg_size);
  }();
  return table;
}

}  // namespace

GBuffer::GBuffer(std::size_t count) : count_(count) {
  const std::size_t stride = (count + max_lanes - 1) / max_lanes * max_lanes;
  values_.assign(stride * (gbuffer_planes + 3), 0.0f);
  float* next = values_.data();
  const auto plane = [&] {
    float* const p = next;
    next += stride;
    return p;
  };
  for (auto* group : {view_.position, view_.normal, view_.base_color, view_.emissive})
    for (int c = 0; c < 3; ++c) group[c] = plane();
  for (float** p : {&view_.metallic, &view_.roughness, &view_.occlusion, &view_.alpha, &view_.unlit, &view_.depth})
    *p = plane();
  for (float*& p : radiance_) p = plane();
}

std::vector<float*> GBuffer::planes() {
  std::vector<float*> result;
  const std::size_t stride = (count_ + max_lanes - 1) / max_lanes * max_lanes;
  for (int k = 0; k < gbuffer_planes; ++k) result.push_back(values_.data() + k * stride);
  return result;
}

void GBuffer::set(std::size_t i, const reference::ShadeSurface& s) {
  const auto put = [i](float* const planes[3], const Vec3& v) {
    planes[0][i] = float(v.x);
    planes[1][i] = float(v.y);
    planes[2][i] = float(v.z);
  };
  put(view_.position, s.position);
  put(view_.normal, s.normal);
  put(view_.base_color, s.base_color);
  put(view_.emissive, s.emissive);
  view_.metallic[i] = float(s.metallic);
  view_.roughness[i] = float(s.roughness);
  view_.occlusion[i] = float(s.occlusion);
  view_.alpha[i] = 1;
  view_.unlit[i] = s.unlit ? 1.0f : 0.0f;
}

reference::ShadeSurface GBuffer::surface(std::size_t i) const {
  const auto get = [i](float* const planes[3]) { return Vec3{planes[0][i], planes[1][i], planes[2][i]}; };
  return {get(view_.position), get(view_.normal),  get(view_.base_color), get(view_.emissive),
          view_.metallic[i],   view_.roughness[i], view_.occlusion[i],    view_.unlit[i] > 0.5f};
}

Environment::Environment(int size, int levels, const std::function<Vec3(const Vec3&, int)>& radiance,
                         const double (&sh)[9][3])
    : size_(size), levels_(levels), texels_(cube_texel_count(size, levels) * 4) {
  for (int level = 0; level < levels; ++level) {
    const int n = size >> level;
    for (int face = 0; face < 6; ++face)
      for (int j = -1; j <= n; ++j)
        for (int i = -1; i <= n; ++i) {
          const Vec3 d = face_direction(face, (2 * i + 1.0) / n - 1, (2 * j + 1.0) / n - 1);
          const Vec3 value = radiance(reference::normalize(d), level);
          std::uint16_t* texel = &texels_[cube_texel_index(size, levels, level, face, i, j) * 4];
          for (const double channel : {value.x, value.y, value.z, 1.0}) *texel++ = to_half(channel);
        }
  }
  for (int k = 0; k < 9; ++k)
    for (int c = 0; c < 3; ++c) sh_[k][c] = float(sh[k][c]);
}

Environment Environment::constant(double radiance) {
  const double sh[9][3] = {{radiance, radiance, radiance}};
  return {8, 4, [=](const Vec3&, int) { return Vec3{radiance, radiance, radiance}; }, sh};
}

EnvironmentView Environment::view() const {
  EnvironmentView view{};
  view.specular = view.background = {texels_.data(), size_, levels_};
  std::copy(&sh_[0][0], &sh_[0][0] + 27, &view.irradiance_sh[0][0]);
  return view;
}

DfgView Environment::dfg() const { return dfg_table().view(); }

reference::ShadeEnvironment Environment::reference() const {
  const auto texel = [this](int level, int face, int x, int y) {
    const std::uint16_t* t = &texels_[4 * cube_texel_index(size_, levels_, level, face, x - 1, y - 1)];
    return Vec3{half_to_float(t[0]), half_to_float(t[1]), half_to_float(t[2])};
  };
  const auto bilinear = [this, texel](const Vec3& direction, int level) {
    double s = 0, t = 0;
    const int face = face_of(direction, &s, &t), n = size_ >> level;
    const double x = (s + 1) / 2 * n + 0.5, y = (t + 1) / 2 * n + 0.5;  // counted from the border's centre
    const int i = std::min(int(x), n), j = std::min(int(y), n);
    return lerp(lerp(texel(level, face, i, j), texel(level, face, i + 1, j), x - i),
                lerp(texel(level, face, i, j + 1), texel(level, face, i + 1, j + 1), x - i), y - j);
  };
  reference::ShadeEnvironment result;
  result.max_lod = levels_ - 1;
  result.radiance = [this, bilinear](const Vec3& direction, double lod) {
    const int fine = int(lod), coarse = std::min(fine + 1, levels_ - 1);
    return lerp(bilinear(direction, fine), bilinear(direction, coarse), lod - fine);
  };
  result.irradiance_over_pi = [this](const Vec3& n) {
    const double basis[9] = {
        1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
    Vec3 sum;
    for (int k = 0; k < 9; ++k) sum = sum + Vec3{sh_[k][0], sh_[k][1], sh_[k][2]} * basis[k];
    return sum;
  };
  result.dfg = [](double NoV, double roughness) {
    const auto axis = [](double u, int* i) {
      const double x = std::clamp(u * dfg_size - 0.5, 0.0, dfg_size - 1.0);
      *i = std::min(int(x), dfg_size - 2);
      return x - *i;
    };
    int i = 0, j = 0;
    const double x = axis(NoV, &i), y = std::round(axis(roughness, &j) * 32768) / 32767;  // rows: kernels count so
    const auto channel = [&](int c) {
      const auto at = [&](int column, int row) { return dfg_table().node(column, row)[std::size_t(c)]; };
      return lerp(lerp(at(i, j), at(i + 1, j), x), lerp(at(i, j + 1), at(i + 1, j + 1), x), y);
    };
    return reference::DirectionalAlbedo{channel(0), channel(1)};
  };
  return result;
}

reference::ShadeSurface random_surface(std::mt19937& random, const Vec3& eye) {
  std::uniform_real_distribution<double> unit(0, 1), symmetric(-1, 1);
  const auto vec3 = [&](auto& distribution) {
    const double x = distribution(random), y = distribution(random), z = distribution(random);
    return Vec3{x, y, z};
  };
  reference::ShadeSurface s;
  s.position = vec3(symmetric);
  const Vec3 towards = reference::normalize(eye - s.position);
  s.normal = reference::normalize(vec3(symmetric) + towards * (1.5 * unit(random)));
  s.base_color = vec3(unit);
  s.metallic = std::clamp(1.4 * unit(random) - 0.2, 0.0, 1.0);
  s.roughness = std::clamp(1.2 * unit(random) - 0.1, 0.0, 1.0);
  s.occlusion = unit(random);
  if (unit(random) < 0.3) s.emissive = vec3(unit) * 3;
  s.unlit = unit(random) < 0.05;
  return s;
}

std::vector<LightView> all_kinds_of_lights() {
  std::vector<LightView> lights;
  for (const LightType type : {LightType::directional, LightType::point, LightType::spot})
    for (const Falloff falloff : {Falloff::inverse_square, Falloff::windowed_plus_one})
      for (const float range : {0.0f, 4.0f}) {
        const float turn = float(lights.size());
        LightView light{};
        light.type = type;
        light.falloff = falloff;
        const Vec3 from = reference::normalize({std::sin(turn), 0.6, std::cos(turn)});
        const Vec3 position = from * 3.0;
        light.position[0] = float(position.x), light.position[1] = float(position.y),
        light.position[2] = float(position.z);
        light.direction[0] = -float(from.x), light.direction[1] = -float(from.y), light.direction[2] = -float(from.z);
        light.color[0] = 1 + turn, light.color[1] = 3, light.color[2] = 0.5f;
        light.inverse_range_squared = range > 0 ? 1 / (range * range) : 0;
        // Inner and outer half angle: cosines 0.97 and 0.9.
        light.spot_scale = 1 / (0.97f - 0.9f);
        light.spot_offset = -0.9f * light.spot_scale;
        lights.push_back(light);
      }
  return lights;
}

reference::ShadeLight to_reference(const LightView& light) {
  using Type = reference::ShadeLight::Type;
  reference::ShadeLight result;
  result.type = light.type == LightType::directional ? Type::directional
                : light.type == LightType::point     ? Type::point
                                                     : Type::spot;
  result.plus_one = light.falloff == Falloff::windowed_plus_one;
  result.position = {light.position[0], light.position[1], light.position[2]};
  result.direction = {light.direction[0], light.direction[1], light.direction[2]};
  result.color = {light.color[0], light.color[1], light.color[2]};
  result.range = light.inverse_range_squared > 0 ? 1 / std::sqrt(double(light.inverse_range_squared)) : 0;
  result.cos_outer = -double(light.spot_offset) / light.spot_scale;
  result.cos_inner = (1 - double(light.spot_offset)) / light.spot_scale;
  return result;
}

ShadeArgs shade_args(GBuffer& gbuffer, const Vec3& eye, const std::vector<LightView>& lights,
                     const Environment* environment) {
  ShadeArgs args{};
  args.gbuffer = gbuffer.view();
  args.count = gbuffer.count();
  args.features = feature_all;
  args.eye[0] = float(eye.x), args.eye[1] = float(eye.y), args.eye[2] = float(eye.z), args.eye[3] = 1;
  args.lights = lights.data();
  args.light_count = std::uint32_t(lights.size());
  if (environment != nullptr) {
    args.environment = environment->view();
    args.dfg = environment->dfg();
  }
  for (int c = 0; c < 3; ++c) args.radiance[c] = gbuffer.radiance()[c];
  return args;
}

}  // namespace tessera::test
