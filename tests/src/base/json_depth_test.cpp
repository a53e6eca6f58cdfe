#include "base/json_depth.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tessera {
namespace {

TEST(JsonDepth, CountsBracketsOutsideStrings) {
  EXPECT_FALSE(nests_deeper("", 0));
  EXPECT_FALSE(nests_deeper("3", 0));
  EXPECT_TRUE(nests_deeper("[]", 0));
  EXPECT_FALSE(nests_deeper(R"([{"a": [1]}, [2], {"b": {}}])", 3));
  EXPECT_TRUE(nests_deeper(R"([{"a": [1]}, [2], {"b": {}}])", 2));
  EXPECT_FALSE(nests_deeper(R"(["[[[", "\"[[[", "\\"])", 1));
  EXPECT_TRUE(nests_deeper(R"(["\\", [0]])", 1));
  EXPECT_TRUE(nests_deeper(std::string(100000, '['), 64));
}

}  // namespace
}  // namespace tessera
