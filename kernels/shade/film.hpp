// Pixels on their way to a film: once, and not read again soon.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/vector.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// A vector is 4 x Float::lanes / 4 pixels.
class FilmRows {
 public:
  TESSERA_INLINE FilmRows(const float* rgba, std::size_t stride)
      : stride_(stride), lines_(reinterpret_cast<std::uintptr_t>(rgba) % 64 == 0 && stride % 16 == 0) {}
  /// pixel: by channel. Whole cache lines go past the caches.
  TESSERA_INLINE void store(float* out, const Float (&pixel)[4]) const {
    if (lines_)
      stream_quads(out, stride_, pixel);
    else
      store_quads(out, stride_, pixel);
  }

 private:
  std::size_t stride_;
  bool lines_;  // rows lie on cache lines
};

/// FilmBlocks, if there are any.
class FilmWriter {
 public:
  TESSERA_INLINE explicit FilmWriter(const FilmBlocks& film) : film_(film), rows_(film.rgba, film.row_stride) {}
  TESSERA_INLINE explicit operator bool() const { return film_.rgba != nullptr; }
  /// at: which of the fragments is the first lane's.
  TESSERA_INLINE void store(std::uint32_t at, const Vec3<Float>& radiance) const {
    const std::uint32_t block = at / 16, x = 4 * (block % film_.blocks), y = 4 * (block / film_.blocks) + at % 16 / 4;
    rows_.store(film_.rgba + y * film_.row_stride + 4 * x, {radiance.x, radiance.y, radiance.z, Float(1)});
  }
  TESSERA_INLINE void store(std::uint32_t at, const Vec3<Pair<Float>>& radiance) const {
    store(at, {radiance.x.first, radiance.y.first, radiance.z.first});
    store(at + Float::lanes, {radiance.x.second, radiance.y.second, radiance.z.second});
  }

 private:
  FilmBlocks film_;
  FilmRows rows_;
};

}  // namespace
}  // namespace tessera::TESSERA_ISA
