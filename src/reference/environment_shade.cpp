#include "reference/environment_shade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reference/albedo.hpp"
#include "reference/fresnel.hpp"
#include "reference/microfacet.hpp"
#include "reference/random.hpp"

namespace tessera::reference {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double Vec3::*channels[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
constexpr double mirror_alpha = 1e-5;  // below it the lobe is a direction

struct Frame {
  Vec3 x, y, z;
  [[nodiscard]] Vec3 to_local(const Vec3& d) const { return {dot(d, x), dot(d, y), dot(d, z)}; }
  [[nodiscard]] Vec3 to_world(const Vec3& d) const { return x * d.x + y * d.y + z * d.z; }
};

Frame frame_of(const Vec3& n) {
  const Vec3 other = std::abs(n.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 x = normalize(cross(other, n));
  return {x, cross(n, x), n};
}

// The surface in its own frame.
struct Point {
  Vec3 v, f0, albedo;
  double alpha = 0, roughness = 0;
  std::array<double, 3> multiple{};  // of the Kulla-Conty lobe: times (1 - E(l)) / pi
  std::array<double, 3> diffuse{};   // of Lambert: times 1 / pi

  [[nodiscard]] bool mirror() const { return alpha < mirror_alpha; }
};

Point prepare(const ShadeSurface& s, const Vec3& v, const EnergyTable& table) {
  Point p;
  p.v = v;
  p.roughness = s.roughness;
  p.alpha = s.roughness * s.roughness;
  const DirectionalAlbedo dfg = directional_albedo(v.z, std::max(p.alpha, 1e-6), 32);
  const double lost = p.mirror() ? 0 : 1 - dfg.E(), lost_on_average = p.mirror() ? 0 : table.average_loss(s.roughness);
  for (std::size_t c = 0; c < 3; ++c) {
    const double base = s.base_color.*channels[c], f0 = 0.04 * (1 - s.metallic) + base * s.metallic;
    const double average = f0 + (1 - f0) / 21;  // 2 integral Schlick(mu) mu dmu
    // Favg^2 Eavg / (1 - Favg (1 - Eavg)), Kulla and Conty's Fms.
    const double tint = average * average * (1 - lost_on_average) / (1 - average * lost_on_average);
    p.f0.*channels[c] = f0;
    p.multiple[c] = lost_on_average > 0 ? lost * tint / lost_on_average : 0;
    p.diffuse[c] = base * (1 - s.metallic) * (1 - (f0 * dfg.A + dfg.B) - lost * tint);
  }
  return p;
}

// Heitz 2018, "Sampling the GGX distribution of visible normals", listing 1.
Vec3 sample_visible_normal(const Vec3& v, double alpha, double u1, double u2) {
  const Vec3 stretched = normalize({alpha * v.x, alpha * v.y, v.z});
  const double across = stretched.x * stretched.x + stretched.y * stretched.y;
  const Vec3 t1 = across > 0 ? Vec3{-stretched.y, stretched.x, 0} * (1 / std::sqrt(across)) : Vec3{1, 0, 0};
  const Vec3 t2 = cross(stretched, t1);
  const double r = std::sqrt(u1), phi = 2 * pi * u2, x = r * std::cos(phi), s = (1 + stretched.z) / 2;
  const double y = (1 - s) * std::sqrt(1 - x * x) + s * r * std::sin(phi);
  const Vec3 n = t1 * x + t2 * y + stretched * std::sqrt(std::max(0.0, 1 - x * x - y * y));
  return normalize({alpha * n.x, alpha * n.y, std::max(1e-12, n.z)});
}

// Of l under the distribution above: G1(v) D(h) / (4 n.v).
double visible_density(const Point& p, const Vec3& l) {
  const Vec3 h = p.v + l;
  const double h2 = dot(h, h);
  if (h.z <= 0 || h2 <= 0) return 0;
  const double D = ggx_distribution((h.x * h.x + h.y * h.y) / h2, h.z * h.z / h2, p.alpha);
  return D / (1 + ggx_lambda(std::acos(p.v.z), p.alpha)) / (4 * p.v.z);
}

// BRDF times cosine, per channel.
Vec3 reflect(const Point& p, const Vec3& l, const EnergyTable& table) {
  Vec3 f;
  const Vec3 h = normalize(p.v + l);
  const double lobe = p.mirror() ? 0 : specular_brdf_over_fresnel(p.v, l, p.alpha) * l.z;
  const double loss = p.mirror() ? 0 : table.loss(l.z, p.roughness);
  for (std::size_t c = 0; c < 3; ++c) {
    const double F = fresnel_schlick(p.f0.*channels[c], std::clamp(dot(p.v, h), 0.0, 1.0));
    f.*channels[c] = F * lobe + (p.multiple[c] * loss + p.diffuse[c]) * l.z / pi;
  }
  return f;
}

}  // namespace

EnergyTable::EnergyTable(int size) : size_(size) {
  // Columns at mu = x^2, crowded to the horizon.
  for (int j = 0; j < size; ++j) {
    const double r = double(j) / (size - 1), alpha = std::max(r * r, 1e-6);
    for (int i = 0; i < size; ++i) {
      const double x = std::max(double(i), 0.25) / (size - 1);
      loss_.push_back(1 - directional_albedo(x * x, alpha, 32).E());
    }
    average_.push_back(1 - average_albedo(alpha, 32));
  }
}

double EnergyTable::loss(double mu, double roughness) const {
  const double x = std::sqrt(std::clamp(mu, 0.0, 1.0)) * (size_ - 1), y = std::clamp(roughness, 0.0, 1.0) * (size_ - 1);
  const int i = std::min(int(x), size_ - 2), j = std::min(int(y), size_ - 2);
  const auto at = [&](int a, int b) { return loss_[std::size_t(b) * std::size_t(size_) + std::size_t(a)]; };
  const double fx = x - i, fy = y - j;
  return (1 - fy) * ((1 - fx) * at(i, j) + fx * at(i + 1, j)) + fy * ((1 - fx) * at(i, j + 1) + fx * at(i + 1, j + 1));
}

double EnergyTable::average_loss(double roughness) const {
  const double y = std::clamp(roughness, 0.0, 1.0) * (size_ - 1);
  const int j = std::min(int(y), size_ - 2);
  return (1 - (y - j)) * average_[std::size_t(j)] + (y - j) * average_[std::size_t(j) + 1];
}

RadianceEstimate integrate_environment(const ShadeSurface& surface, const Vec3& v, const EnvironmentMap& environment,
                                       const EnergyTable& table, int rounds, std::uint64_t seed) {
  const Frame frame = frame_of(surface.normal);
  Vec3 local = frame.to_local(v);
  local.z = std::clamp(local.z, 1e-4, 1.0);  // a shading normal may turn away from the eye
  local = normalize(local);
  const Point p = prepare(surface, local, table);
  Random random(seed);

  const auto contribution = [&](const Vec3& l) -> Vec3 {
    if (l.z <= 0) return {};
    const Vec3 world = frame.to_world(l);
    const double density =
        (p.mirror() ? 0 : visible_density(p, l)) + environment.density(world) + l.z / pi;  // the balance heuristic
    return reflect(p, l, table) * environment.radiance(world) * (1 / density);
  };
  Vec3 mean, squares;
  for (int k = 1; k <= rounds; ++k) {
    const double u[6] = {random.uniform(), random.uniform(), random.uniform(),
                         random.uniform(), random.uniform(), random.uniform()};
    Vec3 round;
    if (!p.mirror()) {
      const Vec3 h = sample_visible_normal(p.v, p.alpha, u[0], u[1]);
      round = contribution(normalize(h * (2 * dot(p.v, h)) - p.v));
    }
    round = round + contribution(frame.to_local(environment.sample(u[2], u[3]).direction));
    const double r = std::sqrt(u[4]), phi = 2 * pi * u[5];
    round = round + contribution({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u[4])});
    // Welford 1962: running mean and sum of squared deviations.
    for (const auto c : channels) {
      const double before = round.*c - mean.*c;
      mean.*c += before / k;
      squares.*c += before * (round.*c - mean.*c);
    }
  }
  if (p.mirror()) {
    const Vec3 along = environment.radiance(frame.to_world({-p.v.x, -p.v.y, p.v.z}));
    for (const auto c : channels) mean.*c += fresnel_schlick(p.f0.*c, p.v.z) * along.*c;
  }
  RadianceEstimate estimate;
  estimate.mean = mean * surface.occlusion;
  for (const auto c : channels)
    estimate.error.*c = rounds > 1 ? std::sqrt(squares.*c / (double(rounds) * (rounds - 1))) * surface.occlusion : 0;
  return estimate;
}

}  // namespace tessera::reference
