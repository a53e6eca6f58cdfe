// Compensated lobes in a white furnace, against the quadrature and the random walk of src/reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catalogue/method.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"
#include "reference/albedo.hpp"
#include "reference/energy_table.hpp"
#include "reference/fresnel.hpp"
#include "reference/quadrature.hpp"
#include "reference/walk.hpp"

namespace tessera::test {
namespace {

using reference::DirectionalAlbedo;
using Planes = std::vector<std::vector<float>>;

struct Table {
  int size = 0;
  std::vector<float> texels;
};
const Table& table_of(int size) {
  static const Table small{32, reference::energy_loss_table(32)}, large{64, reference::energy_loss_table(64)};
  return size == 32 ? small : large;
}

std::vector<float> evaluate(const std::string& name, const Planes& inputs, const Table& table = {}, int output = 0) {
  const Term<float>& term = require_term(runnable_kernels().back()->terms, name);
  return run_term(term, inputs, table.texels.data(), table.size)[std::size_t(output)];
}

// Reflected light under a white sky. Every f_ is affine in the single-scattering lobe: f = scale single + added(l).
double furnace(const std::string& term, const Table& table, const DirectionalAlbedo& dfg, double f0, double mu,
               double alpha) {
  std::vector<float> l, weight;
  const auto& rule = reference::gauss_legendre(8);
  double low = 0;
  for (double high = alpha / 20; low < 1; low = high, high *= 2) {  // Ems varies with l / alpha
    const double top = std::min(high, 1.0);
    for (int i = 0; i < 8; ++i) {
      l.push_back(float(low + (top - low) * rule.nodes[std::size_t(i)]));
      weight.push_back(float(2 * std::numbers::pi * (top - low) * rule.weights[std::size_t(i)]));
    }
    high = top;
  }
  const auto inputs = [&](float single) {
    const std::size_t n = l.size();
    const Planes all = {std::vector<float>(n, single), std::vector<float>(n, float(f0)),
                        std::vector<float>(n, float(mu)), l, std::vector<float>(n, float(alpha))};
    if (term == "f_SingleScattering") return Planes{all[0]};
    if (term.rfind("f_Turquin", 0) == 0) return Planes{all[0], all[1], all[2], all[4]};
    return all;
  };
  const std::vector<float> added = evaluate(term, inputs(0), table);
  // At l = 1 the added part is of moderate size.
  const double scale = double(evaluate(term, inputs(1), table).back()) - double(added.back());
  double sum = scale * (f0 * dfg.A + dfg.B);
  for (std::size_t i = 0; i < l.size(); ++i) sum += double(weight[i]) * double(l[i]) * double(added[i]);
  return sum;
}

const std::vector<double> roughnesses = {1e-3, 0.01, 0.03, 0.07, 0.12, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1};
const std::vector<double> cosines = {1e-4, 5e-4, 2e-3, 7e-3, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1};

TEST(EnergyLoss, EveryFormIsNearTheQuadrature) {
  for (const double r : roughnesses)
    for (const double mu : cosines) {
      const double alpha = r * r, exact = 1 - reference::directional_albedo(mu, alpha, 64).E();
      const Planes at = {{float(mu)}, {float(alpha)}};
      EXPECT_NEAR(evaluate("Ems_GGX", at)[0], exact, 8e-4) << r << " " << mu;
      EXPECT_NEAR(evaluate("Ems_GGX_table", at, table_of(32))[0], exact, 5.5e-4) << r << " " << mu;
      EXPECT_NEAR(evaluate("Ems_GGX_table", at, table_of(64))[0], exact, 1.5e-4) << r << " " << mu;
      // The baking quadrature: near the horizon of smooth surfaces its single precision shows.
      EXPECT_NEAR(evaluate("Ems_GGX_integral", at)[0], exact, mu < 1e-3 || r < 0.05 ? 1e-3 : 2e-5) << r << " " << mu;
    }
  for (const double r : {0.1, 0.3, 0.5, 0.8, 1.0})
    EXPECT_NEAR(evaluate("Emsavg_GGX", {{float(r * r)}})[0] / (1 - reference::average_albedo(r * r, 64)), 1, 1e-3) << r;
}

// What a person relies on: a white metal in a white room is white, and nothing is ever brighter than the room.
TEST(Furnace, WhiteMetalIsWhiteAndNothingGainsEnergy) {
  for (const double r : roughnesses)
    for (const double mu : cosines) {
      SCOPED_TRACE(testing::Message() << "roughness " << r << " NoV " << mu);
      const double alpha = r * r;
      const DirectionalAlbedo dfg = reference::directional_albedo(mu, alpha, 64);
      EXPECT_NEAR(furnace("f_KullaConty_table", table_of(64), dfg, 1, mu, alpha), 1, 4e-4);
      EXPECT_NEAR(furnace("f_KullaConty_table", table_of(32), dfg, 1, mu, alpha), 1, 1e-3);
      EXPECT_NEAR(furnace("f_Turquin_table", table_of(64), dfg, 1, mu, alpha), 1, 3e-4);
      EXPECT_NEAR(furnace("f_Turquin", {}, dfg, 1, mu, alpha), 1, 1e-3);
      for (const char* term : {"f_KullaConty", "f_Hill", "f_KullaConty_slides"}) {
        EXPECT_LE(furnace(term, {}, dfg, 1, mu, alpha), 1 + 1e-3) << term;
        EXPECT_GE(furnace(term, {}, dfg, 1, mu, alpha), 1 - 5e-3) << term;
      }
      // A white material between dielectric and metal: the diffuse part gets what the specular part leaves.
      for (const char* term : {"f_SingleScattering", "f_KullaConty", "f_KullaConty_slides", "f_KullaConty_table",
                               "f_Turquin", "f_Turquin_table", "f_Hill"})
        for (const double metallic : {0.0, 0.5, 0.9}) {
          const double f0 = 0.04 + 0.96 * metallic;
          const double specular = furnace(term, table_of(64), dfg, f0, mu, alpha);
          EXPECT_GE(specular, f0 * dfg.A + dfg.B - 1e-5) << term;
          EXPECT_LE(specular + (1 - metallic) * (1 - specular), 1 + 1e-3) << term << " " << metallic;
        }
    }
}

struct Split {
  double single, multiple;
};
Split split(const std::string& term, const DirectionalAlbedo& dfg, double f0, double mu, double alpha) {
  Planes in = {{float(f0)}, {float(dfg.A)}, {float(dfg.B)}};
  if (term == "split_KullaConty") in.push_back({float(alpha)});
  if (term == "split_Hill") in.insert(in.end(), {{float(mu)}, {float(alpha)}});
  if (term == "split_FdezAguera_kS") in.insert(in.end(), {{float(mu)}, {float(std::sqrt(alpha))}});
  return {evaluate(term, in)[0], evaluate(term, in, {}, 1)[0]};
}

TEST(Environment, SplitsAreTheirPapersFormulas) {
  for (const double r : {0.1, 0.4, 0.7, 1.0})
    for (const double mu : {0.01, 0.2, 0.6, 1.0})
      for (const double f0 : {0.0, 0.04, 0.5, 0.95, 1.0}) {
        SCOPED_TRACE(testing::Message() << "roughness " << r << " NoV " << mu << " F0 " << f0);
        const double alpha = r * r, Favg = f0 + (1 - f0) / 21;
        const DirectionalAlbedo dfg = reference::directional_albedo(mu, alpha, 64);
        const double single = f0 * dfg.A + dfg.B, Ems = 1 - dfg.E(), Eavg = reference::average_albedo(alpha, 48);
        // Bounce by bounce: the second facet on, each absorbs its share, and Eavg of what is left leaves.
        double kulla_conty = 0, fdez_aguera = 0;
        for (int k = 1; k < 400; ++k) {
          kulla_conty += Ems * Favg * Eavg * std::pow(Favg, k) * std::pow(1 - Eavg, k - 1);
          fdez_aguera += single * std::pow(Ems * Favg, k);
        }
        const Split none = split("split_SingleScattering", dfg, f0, mu, alpha);
        EXPECT_NEAR(none.single, single, 1e-6);
        EXPECT_EQ(none.multiple, 0);
        const Split kc = split("split_KullaConty", dfg, f0, mu, alpha);
        EXPECT_NEAR(kc.single, single, 1e-6);
        EXPECT_NEAR(kc.multiple, kulla_conty, 2e-4);  // Eavg is a fit
        const Split fa = split("split_FdezAguera", dfg, f0, mu, alpha);
        EXPECT_NEAR(fa.multiple, fdez_aguera, 1e-6);
        const Split turquin = split("split_Turquin", dfg, f0, mu, alpha);
        EXPECT_NEAR(turquin.single, single * (1 + f0 * Ems / dfg.E()), 2e-6);
        const Split published = split("split_FdezAguera_kS", dfg, f0, mu, alpha);
        const double kS = f0 + (std::max(1 - r, f0) - f0) * std::pow(1 - mu, 5);
        EXPECT_NEAR(published.single, kS * dfg.A + dfg.B, 1e-6);
        for (const char* term : {"split_SingleScattering", "split_KullaConty", "split_Turquin", "split_Hill",
                                 "split_FdezAguera", "split_FdezAguera_kS"}) {
          const Split s = split(term, dfg, f0, mu, alpha);
          EXPECT_LE(s.single + s.multiple, 1 + 1e-5) << term;
          if (f0 == 1 && std::string(term) != "split_SingleScattering") {
            EXPECT_NEAR(s.single + s.multiple, 1, 1e-5) << term;
          }
        }
      }
}

TEST(Hill, SeriesFollowsTheWalk) {
  std::uint64_t seed = 50;
  for (const double r : {0.3, 0.6, 1.0})
    for (const double mu : {0.05, 0.4, 0.9})
      for (const double f0 : {0.04, 0.4, 0.8}) {
        const auto schlick = [=](double c) { return reference::fresnel_schlick(f0, c); };
        const reference::Estimate walk = reference::walk_albedo({r * r, schlick}, mu, 60000, 1, ++seed).multiple;
        const DirectionalAlbedo dfg = reference::directional_albedo(mu, r * r, 64);
        EXPECT_NEAR(split("split_Hill", dfg, f0, mu, r * r).multiple, walk.mean, 5e-3 + 4 * walk.error)
            << r << " " << mu << " " << f0;
      }
}

TEST(KullaConty, IsReciprocalAndTheOthersAreNot) {
  const Table& table = table_of(32);
  for (const double r : {0.2, 0.6, 1.0}) {
    const float alpha = float(r * r);
    for (const char* term : {"f_KullaConty", "f_KullaConty_slides", "f_KullaConty_table"}) {
      const float there = evaluate(term, {{0.5f}, {0.7f}, {0.2f}, {0.9f}, {alpha}}, table)[0];
      const float back = evaluate(term, {{0.5f}, {0.7f}, {0.9f}, {0.2f}, {alpha}}, table)[0];
      EXPECT_NEAR(there, back, 1e-6f * there) << term;
    }
  }
  const float there = evaluate("f_Turquin", {{0.5f}, {0.7f}, {0.2f}, {1.0f}})[0];
  const float back = evaluate("f_Turquin", {{0.5f}, {0.7f}, {0.9f}, {1.0f}})[0];
  EXPECT_GT(std::abs(there - back), 0.1f * there);
}

// Terms that read a table or whose inputs hang together: the accuracy table's bounds, on real inputs.
TEST(EnergyTerms, WithinTheirBoundsWhereTheirInputsAgree) {
  for (const catalogue::Method& method : catalogue::energy_methods()) {
    if (!method.own_test) continue;
    Planes in = catalogue::draw_inputs(method, 2000, 9);
    if (method.term.rfind("split_", 0) == 0)
      for (std::size_t i = 0; i < in[0].size(); ++i) {  // A and B of a lobe: E is at least 0.3
        in[1][i] = 0.3f + 0.7f * in[1][i];
        in[2][i] *= 1 - in[1][i];
      }
    const Table& table = table_of(32);
    const auto exact = run_term(require_term(precise_terms, method.term), widened(in), table.texels.data(), 32);
    for (const Kernels* kernels : runnable_kernels()) {
      const auto found = run_term(require_term(kernels->terms, method.term), in, table.texels.data(), 32);
      for (std::size_t k = 0; k < found.size(); ++k)
        for (std::size_t i = 0; i < in[0].size(); ++i) {
          ASSERT_TRUE(std::isfinite(found[k][i]) && found[k][i] >= 0) << method.term << " " << describe(in, i);
          ASSERT_LE(std::abs(found[k][i] - exact[k][i]),
                    method.arithmetic_bound * std::max(std::abs(exact[k][i]), method.arithmetic_floor))
              << kernels->isa << " " << method.term << " " << describe(in, i);
        }
    }
  }
}

// Nothing that is not a number, negative or infinite, whatever the bits.
TEST(EnergyLoss, IsTotal) {
  const Table& table = table_of(32);
  const float nan = std::nanf(""), inf = INFINITY;
  for (const float mu : {0.0f, -0.0f, 1e-45f, 1e-38f, 1e-20f, 1.0f, 2.0f, -1.0f, inf, -inf, nan})
    for (const float alpha : {0.0f, -0.0f, 1e-45f, 1e-38f, 1e-20f, 1.0f, 2.0f, -1.0f, inf, -inf, nan})
      for (const Kernels* kernels : runnable_kernels())
        for (const char* term : {"Ems_GGX", "Ems_GGX_table"}) {
          const float x =
              run_term(require_term(kernels->terms, term), Planes{{mu}, {alpha}}, table.texels.data(), 32)[0][0];
          EXPECT_TRUE(x >= 0 && x <= 1) << term << " " << x << " at " << mu << ", " << alpha;
        }
}

}  // namespace
}  // namespace tessera::test
