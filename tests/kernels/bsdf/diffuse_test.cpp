#define TESSERA_ISA diffuse_test
#include "kernels/bsdf/diffuse.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/bsdf/diffuse_inputs.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/diffuse.hpp"

namespace tessera::test {
namespace {

namespace kernel = TESSERA_ISA;
using reference::Vec3;
using Inputs = std::initializer_list<const std::vector<float>*>;

void expect_agreement(const char* term, const DiffuseInputs& in, Inputs inputs,
                      double (*lobe)(double, double, const Vec3&, const Vec3&), bool of_albedo_1 = true) {
  for (const Kernels* kernels : runnable_kernels()) {
    const auto f = evaluate_term(*kernels, term, inputs);
    for (std::size_t k = 0; k < f.size(); ++k) {
      const auto& e = in.exact[k];
      const double expected = lobe(of_albedo_1 ? 1 : e.albedo, e.roughness, e.v, e.l);
      // Relative; absolute below a hundredth of a white Lambert surface. Grazing pairs, where Oren and Nayar's tangent
      // is up to 1000, multiply the rounding of LoV.
      ASSERT_NEAR(f[k], expected, 2e-6 * std::max(expected, 3e-3) + 4e-8 / std::max(e.v.z, e.l.z))
          << kernels->isa << ' ' << in.NoV[k] << ' ' << in.NoL[k] << ' ' << in.roughness[k];
    }
  }
}

TEST(Diffuse, AgreesWithReference) {
  const DiffuseInputs in = diffuse_inputs();
  const Inputs burley = {&in.roughness, &in.NoV, &in.NoL, &in.LoH};
  const Inputs oren_nayar = {&in.roughness, &in.NoV, &in.NoL, &in.LoV};
  expect_agreement(
      "Fd_Lambert", in, {&in.albedo},
      [](double albedo, double, const Vec3&, const Vec3&) { return albedo / kernel::pi; }, false);
  expect_agreement("Fd_Burley", in, burley, reference::burley_diffuse);
  expect_agreement("Fd_Frostbite", in, burley, reference::frostbite_diffuse);
  expect_agreement("Fd_OrenNayar", in, oren_nayar, reference::oren_nayar_diffuse);
  expect_agreement("Fd_AshikhminShirley", in, {&in.roughness, &in.NoV, &in.NoL}, reference::ashikhmin_shirley_diffuse);
}

// Burley's promise is the artist's eye, not energy: a white rough surface returns half as much again as it receives
// at grazing angles. Frostbite's stays below 1, at the price of 30 % elsewhere.
TEST(Diffuse, AlbedoAboveOneIsBurleysAlone) {
  double burley = 0, frostbite = 0, oren_nayar = 0;
  for (const double r : {0.0, 0.25, 0.5, 0.75, 1.0})
    for (const double mu : {0.01, 0.05, 0.2, 0.5, 1.0}) {
      const auto albedo = [&](auto lobe) {
        return reference::hemispherical_albedo([&](const Vec3& v, const Vec3& l) { return lobe(v, l); }, mu);
      };
      const auto LoH = [](const Vec3& v, const Vec3& l) { return dot(l, normalize(l + v)); };
      burley = std::max(
          burley, albedo([&](const Vec3& v, const Vec3& l) { return kernel::Fd_Burley(r, v.z, l.z, LoH(v, l)); }));
      frostbite =
          std::max(frostbite,
                   albedo([&](const Vec3& v, const Vec3& l) { return kernel::Fd_Frostbite(r, v.z, l.z, LoH(v, l)); }));
      oren_nayar =
          std::max(oren_nayar,
                   albedo([&](const Vec3& v, const Vec3& l) { return kernel::Fd_OrenNayar(r, v.z, l.z, dot(v, l)); }));
    }
  EXPECT_NEAR(burley, 1.55, 0.06);
  EXPECT_NEAR(frostbite, 1.02, 0.02);
  EXPECT_NEAR(oren_nayar, 1.01, 0.01);
}

// Swapping v and l changes nothing: to the last bit, since all are symmetric as written but for one product's order.
TEST(Diffuse, Reciprocal) {
  const float cosines[] = {0.0f, 1e-4f, 0.03f, 0.4f, 0.83f, 1.0f};
  for (const float v : cosines)
    for (const float l : cosines)
      for (const float r : {0.0f, 0.5f, 1.0f})
        for (const float c : {0.0f, 0.3f, 1.0f}) {
          EXPECT_EQ(kernel::Fd_Burley(r, v, l, c), kernel::Fd_Burley(r, l, v, c));
          EXPECT_EQ(kernel::Fd_Frostbite(r, v, l, c), kernel::Fd_Frostbite(r, l, v, c));
          EXPECT_EQ(kernel::Fd_OrenNayar(r, v, l, c), kernel::Fd_OrenNayar(r, l, v, c));
          EXPECT_NEAR(kernel::Fd_AshikhminShirley(r, v, l), kernel::Fd_AshikhminShirley(r, l, v), 1e-7f);
        }
}

TEST(Diffuse, FiniteAndNotNegativeAtTheEndsOfTheDomain) {
  const float ends[] = {0.0f, 1e-40f, 1e-4f, 0.5f, 1.0f};
  for (const float v : ends)
    for (const float l : ends)
      for (const float r : ends)
        for (const float c : {-1.0f, -1e-40f, 0.0f, 0.5f, 1.0f}) {
          const float LoH = c < 0 ? 0 : c;
          for (const float f : {kernel::Fd_Burley(r, v, l, LoH), kernel::Fd_Frostbite(r, v, l, LoH),
                                kernel::Fd_OrenNayar(r, v, l, c), kernel::Fd_AshikhminShirley(r, v, l)})
            ASSERT_TRUE(f >= 0 && f < 1e30f) << v << ' ' << l << ' ' << r << ' ' << c << ": " << f;
        }
}

}  // namespace
}  // namespace tessera::test
