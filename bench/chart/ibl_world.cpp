#include "bench/chart/ibl_world.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "reference/microfacet.hpp"

namespace tessera::chart {
namespace {

using reference::Vec3;
constexpr double pi = std::numbers::pi;

Vec3 direction(int x, int y, int width, int height) {
  const double theta = pi * (y + 0.5) / height, phi = 2 * pi * ((x + 0.5) / width - 0.5);
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

Image paint(const std::function<double(const Vec3&)>& radiance) {
  constexpr int width = 256, height = 128;
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) std::fill_n(image.at(x, y), 3, float(radiance(direction(x, y, width, height))));
  return image;
}

reference::SpherePicture as_sphere(const Image& image) {
  return {image.width, image.height, {image.pixels.begin(), image.pixels.end()}, false};
}

EnvironmentSettings bake_settings() {
  EnvironmentSettings settings;
  settings.specular_size = settings.background_size = 128;
  settings.irradiance = IrradianceForm::harmonics;
  return settings;
}

double sky(const Vec3& d) {
  const Vec3 sun = normalize(Vec3{0.4, 0.5, 0.6});
  const double above = d.y > 0 ? 0.4 + 0.5 * (1 - d.y) : 0.1 + 0.03 * std::sin(15 * d.x) * std::sin(15 * d.z);
  return above + (dot(d, sun) > std::cos(0.05) ? 80 : 0);
}

double room(const Vec3& d) {
  const double azimuth = std::atan2(d.z, d.x);
  const bool window = d.y > 0.05 && d.y < 0.5 && std::sin(5 * azimuth + 1) > 0.6;
  return window ? 3 + std::cos(2 * azimuth) : d.y > 0.9 ? 0.6 : 0.05;
}

double studio(const Vec3& d) {
  const auto strip = [&](double at, double half) {
    return std::abs(std::atan2(d.z, d.x) - at) < half && std::abs(d.y) < 0.7;
  };
  return 0.08 + (strip(0.8, 0.12) ? 6 : 0) + (strip(-1.4, 0.3) ? 1.5 : 0) + (strip(2.6, 0.06) ? 4 : 0);
}

}  // namespace

World::World(GivenEnvironment given, const EnvironmentSettings& settings, const Kernels& kernels)
    : id(std::move(given.id)),
      title(std::move(given.title)),
      picture(std::move(given.picture)),
      environment(build_environment(picture, settings, kernels)),
      map(as_sphere(picture), 0),
      mean(environment.data().statistics.mean[1]) {
  const int width = picture.width, height = picture.height;
  for (int y = 0; y < height; ++y) {
    const double rows = std::cos(pi * y / height) - std::cos(pi * (y + 1) / height);
    for (int x = 0; x < width; ++x)
      texels_.push_back({direction(x, y, width, height), rows * 2 * pi / width, double(picture.at(x, y)[1])});
  }
}

double World::reflected(const Vec3& n, const Vec3& v, double alpha) const {
  const double nv = dot(n, v);
  const Vec3 t = normalize(v - n * nv), b = cross(n, t), local{dot(v, t), 0, nv};
  double sum = 0;
  const double finer = picture.width / 256.0;
  if (alpha * finer >= 0.08) {
    for (const Texel& texel : texels_) {
      const Vec3 l{dot(texel.d, t), dot(texel.d, b), dot(texel.d, n)};
      if (l.z > 0)
        sum += reference::specular_brdf_over_fresnel(local, l, alpha) * l.z * texel.solid_angle * texel.radiance;
    }
    return sum;
  }
  // Heitz 2018: a point (r, phi) of the disc to a visible normal; its weight is G2 / G1.
  const int side = std::clamp(int(64 * finer), 64, 256);
  const Vec3 w = normalize(Vec3{alpha * local.x, 0, local.z}), t2 = cross(w, Vec3{0, 1, 0});
  const double s = (1 + w.z) / 2, theta_v = std::acos(nv);
  const double masked_v = 1 / (1 + reference::ggx_lambda(theta_v, alpha));
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const double r = std::sqrt((j + 0.5) / side), phi = 2 * pi * (i + 0.5 * (j % 2) + 0.25) / side;
      const double x = r * std::cos(phi), y = (1 - s) * std::sqrt(1 - x * x) + s * r * std::sin(phi);
      const Vec3 p = Vec3{0, 1, 0} * x + t2 * y + w * std::sqrt(std::max(0.0, 1 - x * x - y * y));
      const Vec3 h = normalize(Vec3{alpha * p.x, alpha * p.y, std::max(p.z, 1e-9)});
      const Vec3 l = h * (2 * dot(local, h)) - local;
      if (l.z <= 0) continue;
      const double G2 = reference::smith_masking_shadowing(theta_v, std::acos(std::min(l.z, 1.0)), alpha);
      sum += G2 / masked_v * map.radiance(t * l.x + b * l.y + n * l.z).y / (side * side);
    }
  return sum;
}

std::vector<World> make_worlds(const Session& session) {
  const Kernels& kernels = *session.kernels.back();
  std::vector<World> worlds;
  for (const GivenEnvironment& given : session.pictures) worlds.emplace_back(given, EnvironmentSettings{}, kernels);
  if (!worlds.empty()) return worlds;
  worlds.emplace_back(GivenEnvironment{"sky", "a sky with a sun", paint(sky)}, bake_settings(), kernels);
  worlds.emplace_back(GivenEnvironment{"room", "a room with windows", paint(room)}, bake_settings(), kernels);
  worlds.emplace_back(GivenEnvironment{"studio", "strip lights in a studio", paint(studio)}, bake_settings(), kernels);
  return worlds;
}

}  // namespace tessera::chart
