// Radiance planes to a film's pixels, where rows lie on cache lines and where they do not.
#include <gtest/gtest.h>

#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"
#include "kernels/runnable_kernels.hpp"

namespace tessera {
namespace {

TEST(StorePixels, WritesItsRectangleAndNothingElse) {
  for (const Kernels* k : runnable_kernels())
    for (const int width : {1, 4, 8, 11, 12, 16, 28, 30, 31, 32})
      for (const int height : {1, 2, 3, 5, 8, 32})
        for (const int blocks : {(width + 3) / 4, tile_size / 4})
          for (const std::size_t row_stride : {std::size_t{4} * 32, std::size_t{4} * 33})
            for (const std::size_t first : {std::size_t{0}, std::size_t{4}}) {
              AlignedVector<float> planes[4], film(row_stride * 33, -7), expected = film;
              for (int c = 0; c < 4; ++c)
                for (int i = 0; i < 4 * blocks * ((height + 3) / 4 * 4); ++i) planes[c].push_back(float(2000 * c + i));
              const bool opaque = height % 2 == 0;
              for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                  for (int c = 0; c < 4; ++c)
                    expected[first + std::size_t(y) * row_stride + std::size_t(4 * x + c)] =
                        c == 3 && opaque ? 1.0f : float(2000 * c + (y / 4 * blocks + x / 4) * 16 + y % 4 * 4 + x % 4);
              k->store_pixels({{planes[0].data(), planes[1].data(), planes[2].data()},
                               opaque ? nullptr : planes[3].data(),
                               blocks,
                               width,
                               height,
                               film.data() + first,
                               row_stride});
              ASSERT_EQ(film, expected) << k->isa << ' ' << width << 'x' << height << " stride " << row_stride;
            }
}

}  // namespace
}  // namespace tessera
