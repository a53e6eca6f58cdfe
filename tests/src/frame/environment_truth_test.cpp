// The renderer's default light from an environment against the Monte-Carlo integral of BRDF times environment.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"
#include "frame/dispatch.hpp"
#include "frame/settings.hpp"
#include "precompute/dfg.hpp"
#include "precompute/environment.hpp"
#include "reference/environment_shade.hpp"

namespace tessera {
namespace {

using reference::Vec3;
constexpr int width = 128, height = 64;
const double pi = std::acos(-1.0);

template <class Function>
Image paint(const Function& radiance) {
  Image image(width, height, 3);
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const double theta = pi * (j + 0.5) / height, phi = 2 * pi * ((i + 0.5) / width - 0.5);
      const Vec3 d{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
      std::fill_n(image.at(i, j), 3, float(radiance(d)));
    }
  return image;
}

// Grazing views, roughness 0.2 to 0.6, metal and plastic, from twelve sides; seen from +Z.
std::vector<reference::ShadeSurface> surfaces() {
  std::vector<reference::ShadeSurface> list;
  for (const double r : {0.2, 0.35, 0.6})
    for (const double mu : {0.1, 0.2, 0.4})
      for (const double metallic : {1.0, 0.0})
        for (int k = 0; k < 12; ++k) {
          const double phi = 0.3 + k * pi / 6, s = std::sqrt(1 - mu * mu);
          reference::ShadeSurface surface;
          surface.normal = {s * std::cos(phi), s * std::sin(phi), mu};
          surface.base_color = {0.8, 0.8, 0.8};
          surface.metallic = metallic;
          surface.roughness = r;
          list.push_back(surface);
        }
  return list;
}

std::vector<float> shaded(const std::vector<reference::ShadeSurface>& list, const Environment& environment,
                          const EnvironmentShading& shading) {
  const Kernels& kernels = select_kernels();
  const DfgTable dfg = build_warped_dfg_table(kernels);
  const std::size_t stride = (list.size() + max_lanes - 1) / max_lanes * max_lanes;
  AlignedVector<float> values(stride * (gbuffer_planes + 3), 0.0f);
  const auto plane = [&](std::size_t k) { return values.data() + k * stride; };
  ShadeArgs args{};
  for (std::size_t c = 0; c < 3; ++c) {
    args.gbuffer.position[c] = plane(c);
    args.gbuffer.normal[c] = plane(3 + c);
    args.gbuffer.base_color[c] = plane(6 + c);
    args.gbuffer.emissive[c] = plane(9 + c);
    args.radiance[c] = plane(gbuffer_planes + c);
  }
  args.gbuffer.metallic = plane(12);
  args.gbuffer.roughness = plane(13);
  args.gbuffer.occlusion = plane(14);
  args.gbuffer.alpha = plane(15);
  args.gbuffer.unlit = plane(16);
  args.gbuffer.depth = plane(17);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Vec3 vectors[2] = {list[i].normal, list[i].base_color};
    for (std::size_t v = 0; v < 2; ++v) {
      plane(3 + 3 * v)[i] = float(vectors[v].x);
      plane(4 + 3 * v)[i] = float(vectors[v].y);
      plane(5 + 3 * v)[i] = float(vectors[v].z);
    }
    plane(12)[i] = float(list[i].metallic);
    plane(13)[i] = float(list[i].roughness);
    plane(14)[i] = 1;
  }
  args.count = std::uint32_t(list.size());
  args.features = feature_environment;
  args.eye[2] = 1;
  args.environment = environment.view();
  args.dfg = dfg.view();
  args.environment_shading = shading;
  kernels.shade(args);
  return {args.radiance[1], args.radiance[1] + list.size()};
}

class EnvironmentTruth : public testing::TestWithParam<int> {};

// The largest known error of real-time image-based lighting, at least halved.
TEST_P(EnvironmentTruth, GrazingReflectionsAreHalfAsWrongAsThoseOfRoundLobes) {
  const Vec3 sun = normalize(Vec3{0.5, 0.4, 0.5});
  const std::array<Image, 3> pictures = {
      paint([&](const Vec3& d) { return (d.y > 0 ? 0.8 - 0.4 * d.y : 0.1) + (dot(d, sun) > 0.995 ? 40 : 0); }),
      paint([](const Vec3& d) { return d.y > 0 && d.y < 0.5 && std::sin(5 * std::atan2(d.z, d.x)) > 0.5 ? 3 : 0.1; }),
      paint([](const Vec3& d) { return std::abs(std::atan2(d.z, d.x) - 0.8) < 0.15 ? 6 : 0.2 + 0.1 * d.y; })};
  const Image& picture = pictures[std::size_t(GetParam())];
  const Environment environment = build_environment(picture, {}, select_kernels());
  const reference::EnvironmentMap map({width, height, {picture.pixels.begin(), picture.pixels.end()}, false}, 0);
  const reference::EnergyTable table;
  const std::vector<reference::ShadeSurface> list = surfaces();
  std::vector<double> truth(list.size());
  parallel_for(list.size(), [&](std::size_t i) {
    truth[i] = integrate_environment(list[i], {0, 0, 1}, map, table, 1500, i).mean.y;
  });
  const auto mean_error = [&](const EnvironmentShading& shading) {
    const std::vector<float> found = shaded(list, environment, shading);
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i) sum += std::abs(double(found[i]) - truth[i]);
    return sum / double(found.size());
  };
  const double round = mean_error({}), now = mean_error(RenderSettings{}.environment_shading);
  EXPECT_LT(now, 0.5 * round) << round / environment.data().statistics.mean[1];
}

INSTANTIATE_TEST_SUITE_P(Worlds, EnvironmentTruth, testing::Values(0, 1, 2));

}  // namespace
}  // namespace tessera
