// The inputs of the deferred-shading workload as they lie on disk, and as Tessera's kernels want them. The files are
// raw little-endian arrays, top row first:
//   w1_gbuffer.f32   12 planes of 1920 x 1080: position xyz, normal xyz, base colour rgb, metallic, roughness,
//   occlusion camera.f32       position of the eye lights_N.f32     N records of x y z radius r g b unused
//   tiles_N.off.u32, tiles_N.idx.u32   exact light lists of 16 x 16 pixel tiles, row-major: offsets, then indices
//   env.rgba16f      prefiltered cube, 256 x 256, 9 levels: level, face, row, texel
//   sh9.f32          9 x rgb, irradiance over pi
//   dfg.rg16f        128 x 128 pairs (A, B), texel i of row j at NoV = (i + 0.5)/128, roughness = (j + 0.5)/128
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/aligned.hpp"
#include "frame/lights.hpp"
#include "kernels/interface.hpp"
#include "precompute/cube.hpp"
#include "precompute/dfg.hpp"
#include "precompute/irradiance.hpp"

namespace tessera::workload {

inline constexpr int width = 1920, height = 1080;
inline constexpr int block_size = 16;  // pixels along a block's side
inline constexpr int block_pixels = block_size * block_size;
inline constexpr int planes = 12;
inline constexpr int most_lights = 256;
inline constexpr std::uint32_t block_floats = planes * block_pixels;

/// A whole file of plain records; an input error that names it if it cannot be read.
template <class T>
std::vector<T> read_array(const std::string& path);

/// Environment, table and eye.
struct Surroundings {
  float eye[4];
  Cube cube;
  EnvironmentView environment{};
  DfgTable dfg;

  Surroundings(const std::string& folder, const Kernels& kernels);
  /// From what is there already; eye has four numbers.
  Surroundings(Cube prefiltered, const IrradianceSh& sh, DfgTable dfg, const float* eye_position);
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
};

/// The G-buffer cut into blocks of 16 x 16 pixels, the planes of a block one after another: 12 KiB that are read once,
/// in order.
class BlockedGBuffer {
 public:
  explicit BlockedGBuffer(const std::string& folder);
  /// From 12 planes of width x height; width a multiple of block_size, height of 4.
  BlockedGBuffer(const std::vector<float>& planes_of_pixels, int width, int height);
  /// Another size, filled with the blocks of `other`, over and over.
  BlockedGBuffer(const BlockedGBuffer& other, int width, int height);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int blocks_x() const { return (width_ + block_size - 1) / block_size; }
  [[nodiscard]] int blocks_y() const { return (height_ + block_size - 1) / block_size; }
  [[nodiscard]] int blocks() const { return blocks_x() * blocks_y(); }
  /// Points a view at a block's planes. Those that the workload has none of (emissive, alpha, unlit, depth) stay as
  /// they are. In place: a copy would wait for what was just stored.
  void view_block(int index, GBufferView& view) const;

 private:
  int width_, height_;
  mutable AlignedVector<float> values_;  // GBufferView has no constant planes; shading only reads them
};

/// A set of lights, "L4"; with given lists, "L256t"; with lists that every frame makes itself, "L256c".
struct LightSet {
  std::vector<LightView> lights;
  std::vector<std::uint32_t> offsets;  // of the given lists: per block and one more; empty: every light everywhere
  std::vector<std::uint32_t> indices;  // the lists
  LightBounds bounds;                  // for lists of our own

  bool culled = false;  // the frame makes the lists

  LightSet(const std::string& folder, const std::string& variant);
  /// Records as lights_N.f32 has them; every light everywhere.
  explicit LightSet(const std::vector<float>& records);
};

}  // namespace tessera::workload
