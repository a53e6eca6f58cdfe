#include "precompute/dominant_light.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "precompute/texel_geometry.hpp"

namespace tessera {
namespace {

constexpr double cos_search = 0.984807753012208;  // 10 degrees: what belongs to the source lies within
constexpr double source_share = 0.1;              // of the brightest texel
constexpr double ring_width = 0.5;                // of the source's own extent, at least
constexpr double least_ring = 0.02;               // radians
constexpr double widest = 0.07;                   // radians
constexpr double least_energy = 0.01, least_contrast = 10;

double luminance(const float* rgb) {
  return 0.2126 * double(rgb[0]) + 0.7152 * double(rgb[1]) + 0.0722 * double(rgb[2]);
}

struct Texel {
  float* rgb;
  TexelDirection d;
  double chord;  // distance to the source's centre, on the unit sphere
};

struct Totals {
  double energy = 0, solid_angle = 0, brightest = 0;
  TexelDirection peak{};
};

template <class Function>
void for_each_texel(EnvironmentPicture& picture, const TexelGeometry& geometry, const Function& f) {
  for (int y = 0; y < picture.image.height; ++y)
    for (int x = 0; x < picture.image.width; ++x) f(picture.image.at(x, y), geometry.at(x, y));
}

double cosine(const TexelDirection& a, const TexelDirection& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

double chord(const TexelDirection& a, const TexelDirection& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

Totals totals_of(EnvironmentPicture& picture, const TexelGeometry& geometry) {
  Totals totals;
  for_each_texel(picture, geometry, [&](const float* rgb, const TexelDirection& d) {
    const double Y = luminance(rgb);
    totals.energy += Y * d.solid_angle;
    totals.solid_angle += d.solid_angle;
    if (Y > totals.brightest) totals.brightest = Y, totals.peak = d;
  });
  return totals;
}

// Mean of the texels between the source and a somewhat larger circle, those as bright as the source left out.
void ring_mean(const std::vector<Texel>& around, double limit, double extent, double mean[3]) {
  const double outer = extent + std::max(ring_width * extent, least_ring);
  double weight = 0;
  for (const Texel& texel : around) {
    if (texel.chord > outer || luminance(texel.rgb) >= limit) continue;
    for (int c = 0; c < 3; ++c) mean[c] += double(texel.rgb[c]) * texel.d.solid_angle;
    weight += texel.d.solid_angle;
  }
  for (int c = 0; c < 3; ++c) mean[c] = weight > 0 ? mean[c] / weight : 0;
}

}  // namespace

std::optional<DominantLight> extract_dominant_light(EnvironmentPicture& picture, const Kernels& kernels) {
  const TexelGeometry geometry(picture, kernels);
  const Totals totals = totals_of(picture, geometry);
  if (!(totals.brightest > least_contrast * totals.energy / totals.solid_angle)) return {};

  // What is near the brightest texel, and the source's centre among it.
  const double limit = source_share * totals.brightest;
  std::vector<Texel> around;
  TexelDirection centre{0, 0, 0, 0};
  for_each_texel(picture, geometry, [&](float* rgb, const TexelDirection& d) {
    if (cosine(d, totals.peak) < cos_search) return;
    around.push_back({rgb, d, 0});
    const double Y = luminance(rgb), weight = Y * d.solid_angle;
    if (Y >= limit) centre = {centre.x + weight * d.x, centre.y + weight * d.y, centre.z + weight * d.z, 0};
  });
  const double length = std::sqrt(cosine(centre, centre));
  centre = {centre.x / length, centre.y / length, centre.z / length, 0};
  double extent = 0;
  for (Texel& texel : around) {
    texel.chord = chord(texel.d, centre);
    if (luminance(texel.rgb) >= limit) extent = std::max(extent, texel.chord);
  }
  double ring[3] = {0, 0, 0};
  ring_mean(around, limit, extent, ring);

  double lost[3] = {0, 0, 0}, spread = 0, weight = 0;
  for (const Texel& texel : around) {
    const double Y = luminance(texel.rgb);
    if (Y < limit) continue;
    for (int c = 0; c < 3; ++c) lost[c] += std::max(double(texel.rgb[c]) - ring[c], 0.0) * texel.d.solid_angle;
    spread += Y * texel.d.solid_angle * (texel.chord * texel.chord);
    weight += Y * texel.d.solid_angle;
  }
  if (0.2126 * lost[0] + 0.7152 * lost[1] + 0.0722 * lost[2] < least_energy * totals.energy) return {};

  const double radius2 = 2 * spread / weight;  // a disc of radius R has the mean square R^2 / 2
  if (radius2 > widest * widest) return {};

  DominantLight light{};
  const double axis[3] = {centre.x, centre.y, centre.z};
  for (int c = 0; c < 3; ++c) {
    light.direction[c] = float(axis[c]);
    light.illuminance[c] = float(lost[c]);
  }
  light.angular_radius = float(std::sqrt(radius2));
  for (const Texel& texel : around) {
    if (luminance(texel.rgb) < limit) continue;
    for (int c = 0; c < 3; ++c) texel.rgb[c] = std::min(texel.rgb[c], float(ring[c]));
  }
  return light;
}

}  // namespace tessera
