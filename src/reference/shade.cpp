#include "reference/shade.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/fresnel.hpp"
#include "reference/microfacet.hpp"

namespace tessera::reference {
namespace {

constexpr double Vec3::*channels[3] = {&Vec3::x, &Vec3::y, &Vec3::z};

double angle(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

// Light arriving at the point, per unit of the light's color, on a surface facing it.
double attenuation(const ShadeLight& light, const Vec3& to_light) {
  if (light.type == ShadeLight::Type::directional) return 1;
  const double d = length(to_light);
  const double ratio = light.range > 0 ? std::pow(d / light.range, 4) : 0;
  const double window = std::clamp(1 - ratio, 0.0, 1.0);
  double result = light.plus_one ? window * window / (d * d + 1) : window / (d * d);
  if (light.type == ShadeLight::Type::spot) {
    const double c = -dot(normalize(to_light), light.direction);
    const double ramp = std::clamp((c - light.cos_outer) / (light.cos_inner - light.cos_outer), 0.0, 1.0);
    result *= ramp * ramp;
  }
  return result;
}

}  // namespace

Vec3 shade(const ShadeSurface& s, const Vec3& eye, const std::vector<ShadeLight>& lights,
           const ShadeEnvironment& environment) {
  if (s.unlit) return s.base_color;
  const Vec3 n = s.normal, v = normalize(eye - s.position);
  const double NoV = std::clamp(dot(n, v), 1e-4, 1.0);
  Vec3 result = s.emissive;

  const double r = std::max(s.roughness, 0.045), alpha = r * r;
  for (const ShadeLight& light : lights) {
    const bool directional = light.type == ShadeLight::Type::directional;
    const Vec3 to_light = directional ? light.direction * -1 : light.position - s.position;
    const Vec3 l = normalize(to_light);
    const double NoL = std::clamp(dot(n, l), 0.0, 1.0);
    if (NoL <= 0) continue;
    const Vec3 h = normalize(l + v), nxh = cross(n, h);
    const double NoH = std::max(dot(n, h), 0.0);
    const double sin2 = NoH > 0 ? dot(nxh, nxh) : 1;
    const double D = ggx_distribution(sin2, NoH * NoH, alpha);
    const double G = 1 / (1 + ggx_lambda(angle(NoV), alpha) + ggx_lambda(angle(NoL), alpha));
    const double lobe = D * G / (4 * NoV * NoL);
    const double E = attenuation(light, to_light) * NoL;
    for (auto c : channels) {
      const double f0 = 0.04 * (1 - s.metallic) + s.base_color.*c * s.metallic;
      const double lambert = s.base_color.*c * (1 - s.metallic) / std::numbers::pi;
      const double F = fresnel_schlick(f0, std::clamp(dot(v, h), 0.0, 1.0));
      result.*c += ((1 - F) * lambert + F * lobe) * light.color.*c * E;
    }
  }

  if (environment.radiance) {
    const DirectionalAlbedo dfg = environment.dfg(NoV, s.roughness);
    const Vec3 R = n * (2 * dot(n, v)) - v;
    const Vec3 along_R = environment.radiance(R, s.roughness * environment.max_lod);
    const Vec3 around_n = environment.irradiance_over_pi(n);
    for (auto c : channels) {
      const double f0 = 0.04 * (1 - s.metallic) + s.base_color.*c * s.metallic;
      const double kS = f0 + (std::max(1 - s.roughness, f0) - f0) * std::pow(1 - NoV, 5);
      const double FssEss = kS * dfg.A + dfg.B, Ems = 1 - dfg.E();
      const double Favg = f0 + (1 - f0) / 21;
      const double FmsEms = Ems * FssEss * Favg / (1 - Favg * Ems);
      const double kD = s.base_color.*c * (1 - s.metallic) * (1 - FssEss - FmsEms);
      result.*c += (FssEss * along_R.*c + (FmsEms + kD) * std::max(around_n.*c, 0.0)) * s.occlusion;
    }
  }
  return result;
}

}  // namespace tessera::reference
