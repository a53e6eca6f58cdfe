// What kernels/simd.hpp reads and writes, lane by lane and record by record, on every instruction set.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "kernels/isa/runnable_vocabularies.hpp"

namespace tessera {
namespace {

struct SimdMemory : testing::TestWithParam<const VocabularyTable*> {};

TEST_P(SimdMemory, Gathers) {
  const VocabularyTable& v = *GetParam();
  const std::uint32_t every = (std::uint32_t{1} << v.lanes) - 1;
  float floats[97];
  std::int32_t ints[97];
  for (int i = 0; i < 97; ++i) floats[i] = static_cast<float>(i) * 1.5f, ints[i] = 0x01020304 * i;
  const char* bytes = reinterpret_cast<const char*>(ints);
  std::mt19937 random(5);
  for (int round = 0; round < 500; ++round) {
    const std::uint32_t set = round == 0 ? 0 : round == 1 ? every : random() & every;
    std::int32_t index[max_lanes], offset[max_lanes], wild[max_lanes], wild_offset[max_lanes];
    for (int i = 0; i < v.lanes; ++i) {
      index[i] = static_cast<int>(random() % 97) - 48;  // negative too: the table's middle is passed
      offset[i] = static_cast<int>(random() % 380) - 190;
      // Inactive lanes point where no memory is.
      wild[i] = set >> i & 1 ? index[i] : 0x7fffffff;
      wild_offset[i] = set >> i & 1 ? offset[i] : -0x7fffffff;
    }
    float f[max_lanes], fm[max_lanes];
    std::int32_t low[max_lanes], high[max_lanes];
    std::int32_t n[max_lanes], nm[max_lanes], b[max_lanes], bm[max_lanes];
    v.gather_float(floats + 48, index, f);
    v.gather_int(ints + 48, index, n);
    v.gather_bytes(bytes + 190, offset, b);
    v.gather_pairs(bytes + 190, offset, low, high);
    v.gather_float_masked(floats + 48, wild, set, fm);
    v.gather_int_masked(ints + 48, wild, set, nm);
    v.gather_bytes_masked(bytes + 190, wild_offset, set, bm);
    for (int i = 0; i < v.lanes; ++i) {
      const bool active = set >> i & 1;
      std::int32_t expected, expected_high;
      std::memcpy(&expected, bytes + 190 + offset[i], 4);
      EXPECT_EQ(f[i], floats[48 + index[i]]);
      EXPECT_EQ(n[i], ints[48 + index[i]]);
      EXPECT_EQ(b[i], expected);
      EXPECT_EQ(low[i], expected);
      std::memcpy(&expected_high, bytes + 194 + offset[i], 4);
      EXPECT_EQ(high[i], expected_high);
      EXPECT_EQ(fm[i], active ? floats[48 + index[i]] : 0);
      EXPECT_EQ(nm[i], active ? ints[48 + index[i]] : 0);
      EXPECT_EQ(bm[i], active ? expected : 0);
    }
  }
}

TEST_P(SimdMemory, MaskedStoresTouchNothingElse) {
  const VocabularyTable& v = *GetParam();
  for (std::uint32_t set = 0; set < std::uint32_t{1} << v.lanes; ++set) {
    float in[max_lanes], out[max_lanes], dense[max_lanes];
    std::int32_t in_int[max_lanes], out_int[max_lanes], packed[max_lanes + 1];
    for (int i = 0; i < max_lanes; ++i)
      in[i] = float(100 + i), in_int[i] = 200 + i, out[i] = -1, out_int[i] = -1, packed[i] = -1;
    v.store_float_masked(in, set, out);
    v.store_int_masked(in_int, set, out_int);
    const int count = v.compress_store(in_int, set, packed);
    v.compress(in, set, dense);
    int next = 0;
    bool good = true;
    for (int i = 0; i < v.lanes; ++i) {
      const bool active = set >> i & 1;
      good &= out[i] == (active ? in[i] : -1) && out_int[i] == (active ? in_int[i] : -1);
      if (!active) continue;
      good &= dense[next] == in[i] && packed[next] == in_int[i];
      ++next;
    }
    for (int i = next; i < max_lanes; ++i) good &= packed[i] == -1;
    ASSERT_TRUE(good && count == next) << "mask " << set;
  }
}

TEST_P(SimdMemory, RecordsOfSeveralWords) {
  const VocabularyTable& v = *GetParam();
  std::mt19937 random(17);
  for (int round = 0; round < 1000; ++round) {
    // Exactly as long as what is read: a sanitizer sees a load beyond it.
    constexpr int records = 40, most = 12;
    std::vector<float> table(std::size_t{records} * most);
    for (float& x : table) x = float(random() % 100000);
    std::int32_t word[max_lanes];
    float out[most * max_lanes];
    for (const int size : {3, 4, 12}) {
      for (std::int32_t& w : word) w = std::int32_t(random() % (table.size() - std::size_t(size) + 1));
      word[round % v.lanes] = std::int32_t(table.size()) - size;
      const float* middle = table.data() + table.size() / 2;  // words are signed
      for (std::int32_t& w : word) w -= std::int32_t(table.size() / 2);
      (size == 3 ? v.gather_triples : size == 4 ? v.gather_quads : v.gather_three_quads)(middle, word, out);
      for (int i = 0; i < v.lanes; ++i)
        for (int k = 0; k < size; ++k) ASSERT_EQ(out[k * v.lanes + i], middle[word[i] + k]);
    }
    v.load_quads(table.data(), out);
    for (int i = 0; i < v.lanes; ++i)
      for (int k = 0; k < 4; ++k) ASSERT_EQ(out[k * v.lanes + i], table[std::size_t(4 * i + k)]);

    // Rows of four records, a line apart and further.
    for (const std::size_t row_stride : {16, 48}) {
      alignas(64) float back[48 * max_lanes / 4], streamed[48 * max_lanes / 4];
      v.store_quads(out, row_stride, back);
      v.stream_quads(out, row_stride, streamed);
      for (int i = 0; i < v.lanes; ++i)
        for (int k = 0; k < 4; ++k) {
          const std::size_t at = std::size_t(i / 4) * row_stride + std::size_t(i % 4 * 4 + k);
          ASSERT_TRUE(back[at] == table[std::size_t(4 * i + k)] && streamed[at] == back[at]);
        }
    }
    std::vector<float> scattered(std::size_t{max_lanes} * 7, -1);
    v.scatter_quads(out, 7, scattered.data());
    std::int32_t pairs[2 * max_lanes], low[max_lanes], high[max_lanes], stored[2 * max_lanes];
    for (std::int32_t& p : pairs) p = std::int32_t(random());
    v.load_pairs(pairs, low, high);
    v.store_pairs(low, high, stored);
    for (int i = 0; i < v.lanes; ++i) {
      ASSERT_TRUE(low[i] == pairs[2 * i] && high[i] == pairs[2 * i + 1]);
      ASSERT_TRUE(stored[2 * i] == low[i] && stored[2 * i + 1] == high[i]);
      for (int k = 0; k < 7; ++k)
        ASSERT_EQ(scattered[std::size_t(7 * i + k)], k < 4 ? table[std::size_t(4 * i + k)] : -1);
    }
  }
}

TEST_P(SimdMemory, LanesThatShareRecords) {
  const VocabularyTable& v = *GetParam();
  std::mt19937 random(18);
  for (int round = 0; round < 3000; ++round) {
    const int different = 1 + round % v.lanes;
    std::int32_t in[max_lanes], values[max_lanes], place4[max_lanes];
    for (std::int32_t& x : in) x = std::int32_t(random() % unsigned(different)) * 1000003 - 5000000;
    std::vector<std::int32_t> expected;  // in order of first appearance
    int place[max_lanes] = {};
    for (int i = 0; i < v.lanes; ++i) {
      const auto seen = std::find(expected.begin(), expected.end(), in[i]);
      place[i] = int(seen - expected.begin());
      if (seen == expected.end()) expected.push_back(in[i]);
    }
    const int count = v.find_distinct(in, values, place4);
    if (int(expected.size()) > v.most_distinct) {
      ASSERT_GT(count, v.most_distinct);
      continue;
    }
    ASSERT_EQ(count, int(expected.size()));
    for (int i = 0; i < v.most_distinct; ++i) ASSERT_EQ(values[i], i < count ? expected[std::size_t(i)] : 0);
    for (int i = 0; i < v.lanes; ++i) ASSERT_EQ(place4[i], 4 * place[i]);
    for (const int registers : {1, 2})
      for (const int words : {3, 12}) {
        const int most = registers * v.records_per_register;
        if (count > most) continue;
        // Exactly as long as what is read.
        std::vector<std::vector<float>> records(static_cast<std::size_t>(most), std::vector<float>(std::size_t(words)));
        std::vector<const float*> at;
        for (std::vector<float>& r : records) {
          for (float& x : r) x = float(random() % 100000);
          at.push_back(r.data());
        }
        float out[12 * max_lanes];
        v.spread_records(registers, words, at.data(), place4, out);
        for (int i = 0; i < v.lanes; ++i)
          for (int k = 0; k < words; ++k)
            ASSERT_EQ(out[k * v.lanes + i], records[std::size_t(place[i])][std::size_t(k)]);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(AllInstructionSets, SimdMemory, testing::ValuesIn(runnable_vocabularies()),
                         [](const auto& info) { return std::string(info.param->isa); });

}  // namespace
}  // namespace tessera
