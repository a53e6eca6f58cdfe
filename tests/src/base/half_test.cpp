#include "base/half.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tessera {
namespace {

TEST(Half, EveryValueEqualsItsDefinition) {
  for (std::uint32_t h = 0; h < 65536; ++h) {
    const int exponent = int(h >> 10 & 31);
    const int fraction = int(h & 1023);
    const float got = half_to_float(std::uint16_t(h));
    ASSERT_EQ(std::signbit(got), h >= 32768);
    if (exponent == 31 && fraction != 0) {
      ASSERT_TRUE(std::isnan(got));
      continue;
    }
    const double magnitude = exponent == 31  ? HUGE_VAL
                             : exponent == 0 ? std::ldexp(fraction, -24)
                                             : std::ldexp(1024 + fraction, exponent - 25);
    ASSERT_EQ(std::fabs(double(got)), magnitude) << h;
  }
}

}  // namespace
}  // namespace tessera
