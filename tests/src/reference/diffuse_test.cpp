#include "reference/diffuse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tessera::reference {
namespace {

constexpr double pi = std::numbers::pi;

TEST(HemisphericalAlbedo, OfKnownLobes) {
  for (const double mu : {0.05, 0.5, 1.0}) {
    EXPECT_NEAR(hemispherical_albedo([](const Vec3&, const Vec3&) { return 0.7 / pi; }, mu), 0.7, 1e-12);
    // integral l.z * l.z dl / pi = 2/3
    EXPECT_NEAR(hemispherical_albedo([](const Vec3&, const Vec3& l) { return l.z / pi; }, mu), 2.0 / 3, 1e-12);
  }
  EXPECT_NEAR(average_hemispherical_albedo([](const Vec3& v, const Vec3&) { return v.z / pi; }), 2.0 / 3, 1e-12);
}

TEST(FujiiDiffuse, AverageAlbedoIsTheClosedForm) {
  for (const double r : {0.2, 1.0}) {
    const auto f = [&](const Vec3& v, const Vec3& l) { return fujii_diffuse(1, r, v, l); };
    const double A = 1 / (1 + (0.5 - 2 / (3 * pi)) * r), c2 = 2.0 / 3 - 28 / (15 * pi);
    EXPECT_NEAR(average_hemispherical_albedo(f), A * (1 + c2 * r), 1e-6);
  }
}

TEST(EONDiffuse, WhiteStaysWhite) {
  const auto f = [](const Vec3& v, const Vec3& l) { return eon_diffuse(1, 0.7, v, l); };
  EXPECT_NEAR(hemispherical_albedo(f, 0.3, 4), 1, 2e-3);  // order 4: eon_diffuse is itself quadrature
}

TEST(Diffuse, SmoothSurfacesAreLambert) {
  const Vec3 v = from_angles(1.1, 0), l = from_angles(0.4, 2);
  EXPECT_NEAR(oren_nayar_diffuse(0.6, 0, v, l), 0.6 / pi, 1e-15);
  EXPECT_NEAR(fujii_diffuse(0.6, 0, v, l), 0.6 / pi, 1e-15);
  EXPECT_NEAR(eon_diffuse(0.6, 0, v, l), 0.6 / pi, 1e-12);
}

}  // namespace
}  // namespace tessera::reference
