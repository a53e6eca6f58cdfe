// What is drawn: sizes, geometry, the camera, textures and materials.
// A part of kernels/interface.hpp, which has the conventions; include that.
#pragma once
#include <cstddef>
#include <cstdint>

namespace tessera {

inline constexpr int max_lanes = 16;  // the widest vector of any instruction set, in floats
inline constexpr int tile_size = 32;  // pixels along a tile's side
inline constexpr int tile_pixels = tile_size * tile_size;

// Pixels of a tile are numbered in blocks of 4 x 4: blocks in rows, and pixels in rows inside a block. A vector of any
// width then holds pixels near each other, so that a triangle touches few vectors, and a vector's pixels see few
// triangles and neighbouring texels.
inline constexpr int tile_pixel(int x, int y) { return y / 4 * 128 + x / 4 * 16 + y % 4 * 4 + x % 4; }
inline constexpr int tile_pixel_x(int pixel) { return (pixel >> 2 & 28) + (pixel & 3); }
inline constexpr int tile_pixel_y(int pixel) { return (pixel >> 5 & 28) + (pixel >> 2 & 3); }
inline constexpr int max_samples = 16;   // samples per pixel
inline constexpr int subpixel_bits = 8;  // fixed-point window coordinates have 1/256 pixel
inline constexpr int max_frame_size = 16384;

// ---------------------------------------------------------------------------------------------------------- scene

struct Triangle {           // one 16-byte load
  std::uint32_t vertex[3];  // counter-clockwise seen from the front
  std::uint32_t binding;    // which MaterialBinding shades it
};

struct VertexAttributes {  // 64 bytes: one cache line
  float normal[3];
  float tangent[4];  // w = handedness of the bitangent; all zero: derive the frame from the UVs
  float uv[2][2];    // [set][u, v]
  float color[4];    // linear RGBA, 1 where the file has none
  float unused;
};
static_assert(sizeof(VertexAttributes) == 64);

// In place of VertexAttributes: a surface described vertex by vertex, without textures (scans, simulations). The
// material's factors multiply what is here, as they multiply texels.
struct SurfaceVertex {  // 48 bytes
  float position[3];    // the same as in GeometryView::positions
  float normal[3];
  float base_color[3];
  float metallic, roughness, occlusion;
};
static_assert(sizeof(SurfaceVertex) == 48);

// Kernels gather vertices and triangles with signed 32-bit offsets.
inline constexpr std::uint32_t max_scene_vertices = (1u << 27) - 1;
inline constexpr std::uint32_t max_scene_triangles = (1u << 29) - 1;

struct GeometryView {      // world space, shared by all frames of a scene
  const float* positions;  // xyz, stride 3
  const VertexAttributes* attributes;
  const Triangle* triangles;
  std::uint32_t vertex_count, triangle_count;  // at most max_scene_vertices, max_scene_triangles
  const SurfaceVertex* surfaces = nullptr;     // if set, instead of attributes; materials then have no textures
};

// World position (x,y,z,1) -> homogeneous window coordinates, viewport folded in: x_pixels * w, y_pixels * w, depth *
// w, w.
struct ViewTransform {
  float x[4], y[4], z[4], w[4];  // rows
  float eye[4];                  // w = 1: position of the eye; w = 0: direction towards it (orthographic)
  int width, height;             // pixels
};

// ------------------------------------------------------------------------------------------------------- textures

enum class TexelFormat : std::uint32_t {
  rgba8_unorm,
  rgba16_float,
  rgba8_squares,  // colours are the squares of what 8 bits hold (0 .. 1), alpha is what they hold
};
enum class WrapMode : std::uint32_t { repeat, mirrored_repeat, clamp_to_edge };
enum class FilterMode : std::uint32_t { nearest, linear };

inline constexpr int max_texture_size = 16384;  // along a side
inline constexpr int max_texture_levels = 15;
inline constexpr std::size_t max_texture_texels = std::size_t{1} << 28;  // with mips: offsets stay below 2^31 bytes

struct TextureView {
  const void* texels;  // mip 0 first, levels one after another, rows top to bottom
  TexelFormat format;
  int width, height, levels;  // level k is max(1, width >> k) x max(1, height >> k)
  WrapMode wrap_u, wrap_v;
  FilterMode magnify, minify, mip;
  bool mipmapped;  // false: level 0 only, minify within it
};

struct TextureSlotView {
  const TextureView* texture;  // null: the factor alone
  int uv_set;
  float transform[6];  // u' = t0 u + t1 v + t2,  v' = t3 u + t4 v + t5   (KHR_texture_transform)
};

enum class AlphaMode : std::uint32_t { opaque, mask, blend };

// A material bound to a vertex layout: all that is the same for a run of fragments.
struct MaterialView {
  float base_color[4];
  float metallic, roughness;
  float normal_scale, occlusion_strength;
  float emissive[3];  // strength folded in
  float alpha_cutoff;
  TextureSlotView base_color_texture, metallic_roughness_texture, normal_texture, occlusion_texture, emissive_texture;
  AlphaMode alpha_mode;
  bool double_sided, unlit, has_tangents, has_colors;
};

}  // namespace tessera
