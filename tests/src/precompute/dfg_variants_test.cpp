// The bars of the environment BRDF: how far tables (off their nodes) and fits are from the integral.
#include "precompute/dfg_variants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "frame/dispatch.hpp"
#include "kernels/run_term.hpp"
#include "reference/albedo.hpp"

namespace tessera {
namespace {

// n.v in [1e-3,1] and r in [0.02,1], as a uniform grid (the first `uniform` points, over which means are taken) and
// points crowded to the small ends. No point lies on a node but by chance.
struct Points {
  std::vector<std::vector<float>> inputs{2};
  std::vector<double> A, B;
  std::size_t uniform = 0;

  Points() {
    constexpr int n = 49;
    for (const bool crowded : {false, true})
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          const double x = double(i) / n, y = double(j) / n;
          const double mu = crowded ? std::pow(10, -3 + 3 * x) : 1e-3 + 0.999 * x;
          const double r = crowded ? std::pow(0.02, 1 - y) : 0.02 + 0.98 * y;
          inputs[0].push_back(std::clamp(float(mu), 1e-3f, 1.0f));
          inputs[1].push_back(std::clamp(float(r), 0.02f, 1.0f));
        }
    uniform = inputs[0].size() / 2;
    for (std::size_t k = 0; k < inputs[0].size(); ++k) {
      const double r = inputs[1][k];
      const reference::DirectionalAlbedo e = reference::directional_albedo(inputs[0][k], r * r, 48);
      A.push_back(e.A);
      B.push_back(e.B);
    }
  }
};

const Points& points() {
  static const Points all;
  return all;
}

struct Errors {
  double max = 0, mean = 0;  // the larger of A's and B's
};

Errors errors(const std::string& term, const DfgVariant& table = {}) {
  const Points& p = points();
  const auto found =
      test::run_term(test::require_term(select_kernels().terms, term), p.inputs, table.words.data(), table.size);
  double sum[2] = {};
  Errors e;
  for (std::size_t k = 0; k < p.A.size(); ++k) {
    const double a = std::abs(found[0][k] - p.A[k]), b = std::abs(found[1][k] - p.B[k]);
    e.max = std::max({e.max, a, b});
    if (k < p.uniform) sum[0] += a, sum[1] += b;
  }
  e.mean = std::max(sum[0], sum[1]) / double(p.uniform);
  return e;
}

Errors errors(const std::string& term, DfgAxes axes, DfgFormat format, int size, bool balanced = false) {
  const Errors e = errors(term, build_dfg_variant(select_kernels(), axes, format, size, balanced));
  testing::Test::RecordProperty(term + std::to_string(size) + (balanced ? "b" : ""), std::to_string(e.max));
  return e;
}

// The reference's own convergence over these points, n.v down to 1e-3.
TEST(DfgVariants, TheReferenceHasConverged) {
  for (const double mu : {1e-3, 3e-3, 0.02, 0.3})
    for (const double r : {0.02, 0.05, 0.3, 1.0}) {
      const auto coarse = reference::directional_albedo(mu, r * r, 48),
                 fine = reference::directional_albedo(mu, r * r, 256);
      EXPECT_NEAR(coarse.A, fine.A, 1e-6);
      EXPECT_NEAR(coarse.B, fine.B, 1e-6);
    }
}

TEST(DfgVariants, IntegralAsATermIsTheReference) { EXPECT_LT(errors("dfg_integral").max, 1.5e-5); }

// The bar of a table: 1e-4 off its nodes, reached by bilinear lookup in 64 KB and by cubic in 4 KB.
TEST(DfgVariants, WarpedTablesStayWithin1em4OffTheirNodes) {
  EXPECT_LT(errors("dfg_warped_bilinear_float", DfgAxes::warped, DfgFormat::float32, 128).max, 1e-4);
  EXPECT_LT(errors("dfg_warped_bilinear_float", DfgAxes::warped, DfgFormat::float32, 128, true).max, 6.5e-5);
  EXPECT_LT(errors("dfg_warped_bilinear_unorm16", DfgAxes::warped, DfgFormat::unorm16, 128, true).max, 7e-5);
  EXPECT_LT(errors("dfg_warped_cubic_float", DfgAxes::warped, DfgFormat::float32, 32).max, 1e-4);
  EXPECT_LT(errors("dfg_warped_cubic_unorm16", DfgAxes::warped, DfgFormat::unorm16, 32).max, 1e-4);
}

// More nodes do not help where the axes cannot resolve the corner.
TEST(DfgVariants, LinearAndRootAxesFailAtTheCorner) {
  EXPECT_GT(errors("dfg_linear_bilinear_float", DfgAxes::linear, DfgFormat::float32, 128).max, 2e-2);
  EXPECT_GT(errors("dfg_linear_bilinear_float", DfgAxes::linear, DfgFormat::float32, 512).max, 2e-3);
  EXPECT_GT(errors("dfg_root_bilinear_float", DfgAxes::root, DfgFormat::float32, 128).max, 1e-3);
}

TEST(DfgVariants, EveryCombinationConverges) {
  for (const auto& [axes, name] :
       {std::pair{DfgAxes::linear, "linear"}, {DfgAxes::root, "root"}, {DfgAxes::warped, "warped"}})
    for (const auto& [format, suffix] :
         {std::pair{DfgFormat::float32, "float"}, {DfgFormat::half, "half"}, {DfgFormat::unorm16, "unorm16"}})
      for (const std::string filter : {"nearest", "bilinear", "cubic"}) {
        const std::string term = std::string("dfg_") + name + "_" + filter + "_" + suffix;
        const Errors small = errors(term, axes, format, 16), large = errors(term, axes, format, 64);
        EXPECT_LT(large.mean, 0.6 * small.mean + 2e-4) << term;
        EXPECT_LT(large.mean, filter == "nearest" ? 2e-2 : 2e-3) << term;
      }
}

// The bar of a fit.
TEST(DfgFit, WithinItsBounds) {
  const Errors fine = errors("dfg_fit"), small = errors("dfg_fit_small");
  EXPECT_LT(fine.max, 2e-3);
  EXPECT_LT(fine.mean, 3e-4);
  EXPECT_LT(small.max, 1.4e-2);
  EXPECT_LT(small.mean, 2.6e-3);
}

// What today's published fits reach; far from ours. (The first two were fitted to other lobes.)
TEST(DfgFit, PublishedFitsAreAsFarOffAsIsKnown) {
  EXPECT_NEAR(errors("dfg_MaterialX").max, 0.1, 0.03);
  EXPECT_GT(errors("dfg_Karis").max, 0.3);
  EXPECT_GT(errors("dfg_Lazarov").max, 0.3);
}

// Any bits: finite, not negative, the same bits everywhere.
TEST(DfgVariants, AnyInputBits) {
  std::vector<std::vector<float>> inputs(2);
  std::uint32_t state = 1;
  for (int k = 0; k < 20000; ++k)
    for (auto& plane : inputs) plane.push_back(std::bit_cast<float>(state = state * 1664525 + 1013904223));
  const DfgVariant floats = build_dfg_variant(select_kernels(), DfgAxes::warped, DfgFormat::float32, 8);
  const DfgVariant words = build_dfg_variant(select_kernels(), DfgAxes::warped, DfgFormat::unorm16, 8);
  for (const Term<float>* term : [] {
         std::vector<const Term<float>*> found;
         for (const auto* const* span = select_kernels().terms; *span != nullptr; ++span)
           for (int i = 0; i < (*span)->count; ++i)
             if (std::string((*span)->first[i].name).starts_with("dfg_")) found.push_back((*span)->first + i);
         return found;
       }()) {
    const std::string name = term->name;
    const DfgVariant& table = name.ends_with("float") ? floats : words;
    const auto first = test::run_term(*term, inputs, table.words.data(), table.size);
    for (const Kernels* kernels : built_kernels()) {
      if (!cpu_runs(*kernels)) continue;
      const auto found =
          test::run_term(test::require_term(kernels->terms, name), inputs, table.words.data(), table.size);
      for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t k = 0; k < found[c].size(); ++k) {
          ASSERT_EQ(std::bit_cast<std::uint32_t>(found[c][k]), std::bit_cast<std::uint32_t>(first[c][k])) << name;
          if (name.ends_with("half")) continue;  // those words are no halves
          ASSERT_TRUE(std::isfinite(found[c][k]) && found[c][k] >= 0)
              << kernels->isa << " " << name << " " << inputs[0][k] << " " << inputs[1][k];
        }
    }
  }
}

}  // namespace
}  // namespace tessera
