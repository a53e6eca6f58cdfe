// Every term on random bit patterns, brought into its domain as a shading loop does it: clamped, NaN to the lower end.
// The result is finite, and not negative unless the method says that it may be (or interpolates a table, which here
// holds anything).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "catalogue/method.hpp"
#include "fuzz/random_bits.hpp"
#include "kernels/run_term.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera::test {
namespace {

using catalogue::Domain;
using catalogue::Method;

constexpr std::size_t block = 4096;

// Half the patterns as they come: with their even spread of exponents nearly all land on an end of the domain or among
// the subnormals. The other half keeps its mantissa and gets an exponent of the upper part of the domain.
void bring_into(const Domain& domain, float* values) {
  const float low = float(domain.low), high = float(domain.high);
  const float scale = std::max(std::abs(low), std::abs(high));
  for (std::size_t i = block / 2; i < block; ++i) {
    // 24 exponents below the largest magnitude
    const auto bits = std::bit_cast<std::uint32_t>(values[i]);
    values[i] = scale * std::bit_cast<float>((bits & 0x807fffffu) | ((103u + (bits >> 23 & 23u)) << 23));
  }
  for (std::size_t i = 0; i < block; ++i) {
    const float above = values[i] > low ? values[i] : low;  // NaN: low
    values[i] = above < high ? above : high;
  }
}

// Inputs that describe one half vector describe a unit vector: what the loop takes from the vectors cannot contradict
// itself. Everything else is independent.
void agree(const Method& method, std::vector<std::vector<float>>& in) {
  if (method.own_test && method.term.rfind("split_", 0) == 0)
    for (std::size_t i = 0; i < block; ++i) {  // A and B of a lobe: their sum is its albedo, 0.3 at least
      in[1][i] = 0.3f + 0.7f * in[1][i];
      in[2][i] *= 1 - in[1][i];
    }
  std::vector<float>*x = nullptr, *y = nullptr, *z = nullptr, *sin2 = nullptr;
  for (std::size_t k = 0; k < in.size(); ++k) {
    if (method.inputs[k] == catalogue::Quantity::XoH) x = &in[k];
    if (method.inputs[k] == catalogue::Quantity::YoH) y = &in[k];
    if (method.inputs[k] == catalogue::Quantity::NoH) z = &in[k];
    if (method.inputs[k] == catalogue::Quantity::sin2) sin2 = &in[k];
  }
  if (z == nullptr) return;
  for (std::size_t i = 0; i < block; ++i) {
    if (x != nullptr && y != nullptr) {
      const double a = double((*x)[i]), b = double((*y)[i]), c = double((*z)[i]),
                   length = std::sqrt(a * a + b * b + c * c);
      (*x)[i] = length > 0 ? float(a / length) : 0;
      (*y)[i] = length > 0 ? float(b / length) : 0;
      (*z)[i] = length > 0 ? float(c / length) : 1;
    }
    if (sin2 != nullptr) {  // where the cosine is 1 to the last bit, any angle below its resolution
      const double c = double((*z)[i]);
      (*sin2)[i] = c < 1 ? float((1 - c) * (1 + c)) : (*sin2)[i] * 0x1p-24f;
    }
  }
}

constexpr int table_size = 32;

// Words that are small numbers in every format of a table: floats, pairs of halves, pairs of unorm16.
std::vector<float> any_table(RandomBits& random) {
  std::vector<float> table(2 * table_size * table_size + 16);
  for (float& word : table) {
    const std::uint64_t bits = random.next();
    word = std::bit_cast<float>(std::uint32_t(bits % 0x3801) << 16 | std::uint32_t((bits >> 32) % 0x3801));
  }
  return table;
}

// The bits of an estimate are a machine's own.
std::vector<Method> methods_to_fuzz() {
  std::vector<Method> list = catalogue::methods();
  std::erase_if(list, [](const Method& method) { return method.estimate; });
  return list;
}

struct TermsFuzz : testing::TestWithParam<Method> {};

TEST_P(TermsFuzz, FiniteAndNotNegative) {
  const Method& method = GetParam();
  const Kernels& kernels = *runnable_kernels().back();  // the others give the same bits: terms_test, kernel_hash
  const Term<float>& term = require_term(kernels.terms, method.term);
  std::vector<std::vector<float>> in(method.inputs.size(), std::vector<float>(block));
  std::vector<std::vector<float>> out(std::size_t(term.outputs), std::vector<float>(block));
  TermArgs<float> args{};
  for (std::size_t k = 0; k < in.size(); ++k) args.in[k] = in[k].data();
  for (std::size_t k = 0; k < out.size(); ++k) args.out[k] = out[k].data();
  args.count = block;
  RandomBits random(7);
  const std::vector<float> table = any_table(random);
  args.table = table.data();
  args.table_size = table_size;
  const bool reads_table = method.own_test && method.family == "dfg";
  const float smallest = method.may_be_negative || reads_table ? -3.4e38f : 0.0f;
  for (std::uint64_t done = 0; done < fuzz_count(); done += block) {
    for (std::size_t k = 0; k < in.size(); ++k) {
      random.fill(in[k].data(), block);
      bring_into(domain_of(method, method.inputs[k]), in[k].data());
    }
    agree(method, in);
    term.run(args);
    for (const auto& plane : out) {
      int bad = 0;
      for (const float x : plane) bad |= int(!(x >= smallest)) | int(!(x <= 3.4e38f));
      if (bad == 0) continue;
      for (std::size_t i = 0; i < block; ++i)
        ASSERT_TRUE(plane[i] >= smallest && plane[i] <= 3.4e38f) << plane[i] << " at " << describe(in, i);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, TermsFuzz, testing::ValuesIn(methods_to_fuzz()),
                         [](const auto& info) { return info.param.term; });

}  // namespace
}  // namespace tessera::test
