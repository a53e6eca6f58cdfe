// Cubemaps with mips: radiance in floats while it is being made, halves with borders for the kernels.
#pragma once
#include <bit>
#include <cstddef>
#include <functional>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

inline constexpr int max_cube_size = 4096;  // beyond it kernels' 32-bit offsets overflow
inline constexpr float max_half = 65504;

inline int log2_of(int power_of_two) { return std::countr_zero(unsigned(power_of_two)); }

/// work(rows) over all rows of the faces of a level, in pieces of about 1024 texels, on all threads. CubeRows::out is
/// null.
void for_cube_rows(int size, const std::function<void(CubeRows)>& work);

/// One level: six faces, one after another, of size * size RGBA floats.
struct CubeLevel {
  int size = 0;
  AlignedVector<float> texels;

  explicit CubeLevel(int n) : size(n), texels(std::size_t{6} * std::size_t(n) * std::size_t(n) * 4) {}
  [[nodiscard]] std::size_t face_floats() const { return std::size_t(size) * std::size_t(size) * 4; }
  [[nodiscard]] float* face(int f) { return texels.data() + std::size_t(f) * face_floats(); }
  [[nodiscard]] const float* face(int f) const { return texels.data() + std::size_t(f) * face_floats(); }
};

/// A texel's centre as a unit vector, and its solid angle within (1 / size)^2 of itself.
struct CubeDirection {
  float x, y, z, solid_angle;
};
CubeDirection texel_direction(int face, int i, int j, int size);

/// The point (s, t) in [-1, 1]^2 of a face of the cube of half width 1.
struct FaceDirection {
  double x, y, z;
};
FaceDirection face_direction(int face, double s, double t);

/// The level below: each texel the mean of four, weighted by their solid angles, so that the sphere's total stays.
CubeLevel halved(const CubeLevel& level);

/// What CubeView views.
class Cube {
 public:
  Cube() = default;
  /// size: a power of two up to max_cube_size; 1 <= levels <= log2(size) + 1. Texels are 0.
  Cube(int size, int levels);
  /// From what texels() of another one gave. `texels` must have the length that size and levels ask for. Signs are
  /// dropped.
  Cube(int size, int levels, AlignedVector<std::uint16_t> texels);

  [[nodiscard]] CubeView view() const { return {texels_.data(), size_, levels_}; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int levels() const { return levels_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// All levels with their borders, as CubeView has them.
  [[nodiscard]] const AlignedVector<std::uint16_t>& texels() const { return texels_; }

  /// Rounds a level to halves, without signs, values above the largest half clamped to it, and fills its border.
  /// Returns how many texels were clamped.
  std::size_t store(int level, const CubeLevel& from, const Kernels& kernels);
  /// The reverse, without its border.
  [[nodiscard]] CubeLevel load(int level, const Kernels& kernels) const;

 private:
  [[nodiscard]] std::size_t offset(int level, int face, int i, int j) const;  // i, j from -1 to size
  std::uint16_t* texel(int level, int face, int i, int j) { return texels_.data() + offset(level, face, i, j); }
  void fill_border(int level, int face, const Kernels& kernels);

  AlignedVector<std::uint16_t> texels_;
  int size_ = 0, levels_ = 0;
};

}  // namespace tessera
