// A tile's planes to a film's pixels, where rows lie on cache lines and where they do not.
#include <gtest/gtest.h>

#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera {
namespace {

TEST(StorePixels, WritesItsRectangleAndNothingElse) {
  AlignedVector<float> planes[4];
  for (int c = 0; c < 4; ++c)
    for (int i = 0; i < tile_pixels; ++i) planes[c].push_back(float(10000 * c + i));
  for (const Kernels* k : runnable_kernels())
    for (const int width : {1, 4, 8, 11, 12, 16, 28, 30, 31, 32})
      for (const int height : {1, 2, 3, 5, 8, 32})
        for (const std::size_t row_stride : {std::size_t{4} * 32, std::size_t{4} * 33})
          for (const std::size_t first : {std::size_t{0}, std::size_t{4}}) {
            AlignedVector<float> film(row_stride * 33, -7), expected = film;
            for (int y = 0; y < height; ++y)
              for (int x = 0; x < width; ++x)
                for (int c = 0; c < 4; ++c)
                  expected[first + std::size_t(y) * row_stride + std::size_t(4 * x + c)] =
                      float(10000 * c + (y / 4 * (tile_size / 4) + x / 4) * 16 + y % 4 * 4 + x % 4);
            k->store_pixels({{planes[0].data(), planes[1].data(), planes[2].data(), planes[3].data()},
                             width,
                             height,
                             film.data() + first,
                             row_stride});
            ASSERT_EQ(film, expected) << k->isa << ' ' << width << 'x' << height << " stride " << row_stride;
          }
}

}  // namespace
}  // namespace tessera
