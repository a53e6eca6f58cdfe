#include "base/stream_copy.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "base/aligned.hpp"

namespace tessera {
namespace {

TEST(StreamCopy, CopiesItsBytesAndNothingElse) {
  for (const std::size_t quads : {0, 1, 3, 4, 5, 1000})
    for (const std::size_t first : {0, 4, 12}) {
      AlignedVector<float> from(first + 4 * quads + 8), to(from.size(), -1);
      std::iota(from.begin(), from.end(), 1.0f);
      stream_copy(to.data() + first, from.data() + first, quads * 16);
      for (std::size_t i = 0; i < to.size(); ++i)
        ASSERT_EQ(to[i], i >= first && i < first + 4 * quads ? from[i] : -1) << i;
    }
}

}  // namespace
}  // namespace tessera
