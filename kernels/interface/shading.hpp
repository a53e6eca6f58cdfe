// From the G-buffer to pixels: lights, environments, and what the film gets.
// A part of kernels/interface.hpp, which has the conventions; include that.
#pragma once
#include <cstddef>
#include <cstdint>

#include "kernels/interface/raster.hpp"

namespace tessera {

enum class LightType : std::uint32_t { directional, point, spot };
enum class Falloff : std::uint32_t {
  inverse_square,     // KHR_lights_punctual: max(min(1 - (d/range)^4, 1), 0) / d^2
  windowed_plus_one,  // Karis 2013, eq. 9: sat(1 - (d/range)^4)^2 / (d^2 + 1)
};

struct LightView {
  LightType type;
  Falloff falloff;
  float position[3];
  float direction[3];             // in which the light shines, unit
  float color[3];                 // lux (directional) or candela, times linear colour
  float inverse_range_squared;    // 0: unlimited
  float spot_scale, spot_offset;  // cone: sat(cos * scale + offset)^2
};

enum class CubeFormat : std::uint32_t {
  rgba16_float,  // four halves, none of them with its sign bit set
  rgb9_e5,       // one 32-bit word: nine bits a channel from the lowest on, five bits of a common exponent
};

// A cubemap with mips. Every face of every level has a border of one texel, so that a bilinear footprint never leaves
// it: (n + 2) x (n + 2) texels, the border holding the neighbouring faces' texels (corners: the mean of the other three
// taps). A face with its levels is one image: level 0 above, the others side by side below it. So the distance from one
// row to the next is the same in all levels.
struct CubeView {
  const std::uint16_t* texels;  // faces
  int size;                     // texels along a face of level 0, without the border; a power of two
  int levels;
  CubeFormat format = CubeFormat::rgba16_float;  // of EnvironmentView::specular alone; all others are halves
};
// All in texels; size and levels as in CubeView.
inline constexpr int cube_pitch(int size, int levels) {  // from one row to the next
  const int last = size >> (levels - 1), below = size - last + 2 * (levels - 1);
  return below > size + 2 ? below : size + 2;
}
inline constexpr int cube_face_texels(int size, int levels) {  // from one face to the next
  return cube_pitch(size, levels) * (levels > 1 ? size + 2 + size / 2 + 2 : size + 2);
}
inline constexpr std::size_t cube_texel_count(int size, int levels) {  // of all faces
  return std::size_t{6} * std::size_t(cube_face_texels(size, levels));
}
inline constexpr int cube_level_start(int size, int levels, int level) {  // from a face's first texel
  return level == 0 ? 0 : (size + 2) * cube_pitch(size, levels) + size - 2 * (size >> level) + 2 * (level - 1);
}
inline constexpr std::size_t cube_texel_index(int size, int levels, int level, int face, int i, int j) {
  // i, j: -1 to size >> level
  return std::size_t(face) * std::size_t(cube_face_texels(size, levels)) +
         std::size_t(cube_level_start(size, levels, level) + (j + 1) * cube_pitch(size, levels) + i + 1);
}

struct EnvironmentView {
  CubeView specular;    // level (levels - 1) r (1 + lod_curve (1 - r)) holds GGX-prefiltered radiance for roughness r
  CubeView background;  // plain radiance with mips; the visible background
  float irradiance_sh[9]
                     [3];  // E(n) / pi = c0 + c1 y + c2 z + c3 x + c4 xy + c5 yz + c6 (3zz - 1) + c7 xz + c8 (xx - yy)
  float lod_curve = 0;     // 0 .. 1; 0: r = k / (levels - 1)
  CubeView irradiance = {};  // E(n) / pi, level 0; without texels irradiance_sh is used
};

// How the specular lobe is looked up in prefiltered radiance, which knows only lobes that are round (n = v = r).
enum class EnvironmentLobe : std::uint32_t {
  mirror,   // one lookup along the mirror direction
  shifted,  // one, along the lobe's dominant direction: Lagarde and de Rousiers 2014
  taps2,    // two along the lobe's long axis, weighted by the BRDF
  taps4,    // four
  points8,  // eight fixed points of the lobe, each with the width that it stands for
};

// Which reflectance at normal incidence the environment's single scattering has (Fdez-Aguera 2019).
enum class EnvironmentFresnel : std::uint32_t {
  roughness,  // kS, which falls with roughness: the published code
  f0,         // F0: the derivation
};

// Where the directional albedo of the specular lobe comes from.
enum class EnvironmentAlbedo : std::uint32_t {
  table,      // DfgView
  fit,        // polynomials within 2e-3 of it (kernels/bsdf/dfg_fit.hpp)
  small_fit,  // within 1.4e-2, a third as long
};

struct EnvironmentShading {
  EnvironmentLobe lobe = EnvironmentLobe::mirror;
  EnvironmentFresnel fresnel = EnvironmentFresnel::roughness;
  bool specular_occlusion = false;  // occlusion of reflections by roughness and angle, not by occlusion alone
  EnvironmentAlbedo albedo = EnvironmentAlbedo::table;
};

// Directional albedo of the specular lobe: integral f = F0 A + F90 B. Plain: pairs (A, B), texel i of row j at NoV = (i
// + 0.5) / size, r = (j + 0.5) / size. Warped: pairs and axes of DfgWarpedAxes (kernels/light/dfg_lookup.hpp), which
// err a thousand times less between the nodes. Either has a border of one node, copies of those at its edge, so that a
// bilinear footprint never leaves it.
struct DfgView {
  // (size + 2) x (size + 2) of four numbers: the first of the pair here and in the node below, and the second. A number
  // stands for itself times dfg_step plus dfg_middle: from -1/64 (of a warped pair the second may be a little below 0)
  // to 1, within 8e-6.
  const std::int16_t* nodes;
  int size;  // without the border; at least 2
  bool warped = false;
};
inline constexpr int dfg_node_shorts = 4;
inline constexpr double dfg_step = (1 + 1.0 / 64) / 65535, dfg_middle = 32768 * dfg_step - 1.0 / 64;
inline constexpr int dfg_pitch(int size) { return size + 2; }  // from one row to the next, in nodes

enum ShadeFeature : std::uint32_t {  // what a set of fragments calls for; the smallest kernel that covers it is run
  feature_lights = 1,
  feature_environment = 2,
  feature_emissive = 4,
  feature_unlit = 8,
  feature_all = 15,
};

// Where fragments go that are pixels, one each: to a film's blocks of 4 x 4, from left to right and from top to bottom.
// Other threads see them after end_streaming().
struct FilmBlocks {
  float* rgba;             // of the first pixel; null: nowhere
  std::size_t row_stride;  // in floats
  std::uint32_t blocks;    // in a row
};

struct ShadeArgs {
  GBufferView gbuffer;
  std::uint32_t count;
  std::uint32_t features;  // a superset of what the fragments use; the result does not depend on it
  float eye[4];            // as ViewTransform::eye
  const LightView* lights;
  const std::uint32_t* light_list;  // the lights that count, by index, ascending (Kernels::cull_lights); null: all
  std::uint32_t light_count;        // of the list, or of all
  EnvironmentView environment;
  DfgView dfg;
  float* radiance[3];  // out, SoA; not multiplied by alpha. Not touched if there is a film
  // Where the next fragments will be read from memory: that many floats ahead in every plane lies what is fetched
  // meanwhile. 0: the planes are in the cache already, as a tile's are.
  std::uint32_t fetch_ahead;
  EnvironmentShading environment_shading = {};
  // If not null, radiance goes there with an alpha of 1, and `count` is that of whole blocks.
  FilmBlocks film = {};
};

// Lights as culling sees them: spheres. Arrays padded to max_lanes.
struct LightBoundsView {
  const float *x, *y, *z, *inverse_range_squared;  // 0: reaches everywhere
  std::uint32_t count;
};

struct CullLightsArgs {
  const float* position[3];  // of the fragments, as GBufferView::position
  std::uint32_t count;
  LightBoundsView lights;
  std::uint32_t* out;  // room for lights.count, rounded up to max_lanes
};

// What lies behind a tile's surfaces: the environment along the pixels' rays, or a colour. Planes are as a tile numbers
// its pixels, tile_pixels of each.
struct BackgroundArgs {
  float corner[3], dx[3], dy[3];  // direction(x, y) = corner + x dx + y dy, pixel coordinates; need not be unit
  CubeView cube;                  // without texels: color
  float lod;                      // blur
  float color[3];                 // radiance
  int x, y;                       // pixel coordinates of the tile's first pixel; within +-2^23
  int width, height;              // visible part; pixels beside it may be written, too
  const float* remaining;  // how much of each pixel's light comes from behind; null: all, and planes are only set
  float* rgba[4];          // added to, and alpha becomes 1 where something remains
};

struct StorePixelsArgs {     // a tile's planes -> pixels of a film
  const float* channels[4];  // tile_pixels each
  int width, height;         // of the tile
  float* rgba;               // of the first pixel. Other threads see it after end_streaming()
  std::size_t row_stride;    // in floats
};

enum class ToneCurve : std::uint32_t { none, reinhard, aces, khronos_neutral };

struct EncodeArgs {   // film -> what a display shows
  const float* rgba;  // linear, premultiplied
  std::size_t count;  // pixels
  float exposure;     // factor, applied before the curve
  ToneCurve curve;
  std::uint8_t* out;  // sRGB-encoded RGBA, straight alpha (PNG's convention); or RGB
  int channels = 4;
};

}  // namespace tessera
