#include "precompute/sphere_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace tessera {
namespace {

CubeLevel bumpy(int size) {
  CubeLevel level(size);
  for (std::size_t i = 0; i < level.texels.size(); ++i) level.texels[i] = float(i * 7919 % 101) / 100;
  return level;
}

// Whatever the fineness, a cut around a cap that sees the whole sphere holds its light once.
TEST(SphereTree, ACutHoldsAllLightOnce) {
  const CubeLevel radiance = bumpy(16);
  double light = 0;
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i)
        light +=
            double(radiance.face(face)[(j * 16 + i) * 4 + 1]) * double(texel_direction(face, i, j, 16).solid_angle);
  const SphereTree tree(radiance);
  SphereCut cut;
  SphereTree::Scratch scratch;
  std::size_t fewer = 6 * 16 * 16 + 1;
  for (const float fineness : {0.01f, 0.1f, 0.3f, 1.0f}) {
    tree.cut({0, 0, 1, 2}, 0.3f, fineness, scratch, cut);
    EXPECT_NEAR(std::accumulate(cut.solid_angle.begin(), cut.solid_angle.end(), 0.0), 4 * std::acos(-1.0), 0.03);
    EXPECT_NEAR(std::accumulate(cut.green.begin(), cut.green.end(), 0.0) / light, 1, 1e-5);
    EXPECT_LT(cut.x.size(), fewer);
    fewer = cut.x.size() + (fineness < 0.05f ? 1 : 0);
  }
}

// Texels as small as asked for, or the finest there are; nothing above the horizon of an axis of the cap is missing.
TEST(SphereTree, TexelsAreAsFineAsAsked) {
  const SphereTree tree(bumpy(64));
  SphereCut cut;
  SphereTree::Scratch scratch;
  const SphereTree::Cap cap{0.6f, 0, 0.8f, 0.05f};
  constexpr float alpha = 0.1f, fineness = 0.2f;
  tree.cut(cap, alpha, fineness, scratch, cut);
  double above = 0;
  for (std::size_t k = 0; k < cut.x.size(); ++k) {
    const double dx = double(cut.x[k] - cap.x), dy = double(cut.y[k]), dz = double(cut.z[k] - cap.z);
    const double distance = std::max(std::sqrt(dx * dx + dy * dy + dz * dz) - 0.05, 0.0);
    const double width = std::sqrt(double(cut.solid_angle[k])), finest = std::sqrt(4.0 / (64 * 64));
    EXPECT_LE(width, std::max(0.2 * std::sqrt(4 * 0.01 + distance * distance) * 1.001, finest));
    if (double(cut.x[k]) * 0.6 + double(cut.z[k]) * 0.8 > 0) above += double(cut.solid_angle[k]);
  }
  EXPECT_NEAR(above, 2 * std::acos(-1.0), 0.15);
}

}  // namespace
}  // namespace tessera
