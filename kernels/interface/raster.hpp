// From triangles to the G-buffer: geometry before tiles, and visibility and attributes inside one.
// A part of kernels/interface.hpp, which has the conventions; include that.
#pragma once
#include <cstddef>
#include <cstdint>

#include "kernels/interface/scene.hpp"

namespace tessera {

// ------------------------------------------------------------------------------------------- geometry: before tiles

enum ProjectedFlags : std::uint32_t {
  outside_left = 1,
  outside_right = 2,
  outside_top = 4,
  outside_bottom = 8,
  outside_near = 16,
  outside_far = 32,
  needs_clip = 64,   // nearer than the near plane, or beyond the guard band: x, y, depth are not valid
  not_finite = 128,  // a coordinate is infinite or NaN: the vertex's triangles are dropped
};

struct ProjectedVertex {
  std::int32_t x, y;  // window coordinates in 1/256 pixel, rounded to nearest
  float depth;
  std::uint32_t flags;
};

// Ready for coverage. Vertices ordered so that the area is positive (back faces that are kept have been turned round).
struct SetupTriangle {              // 48 bytes
  std::int32_t x[3], y[3];          // 1/256 pixel, within +-2^23
  float depth, depth_dx, depth_dy;  // depth plane: value at vertex 0, change per pixel
  float depth_min, depth_max;       // range over the triangle; evaluated depth is clamped to it
  std::uint32_t triangle;           // index into GeometryView::triangles
};
static_assert(sizeof(SetupTriangle) == 48);

struct GeometryCounters {
  // empty: no area, no sample within the bounding box, or few there and none covered
  std::uint64_t in, outside, back_face, empty, clipped, kept;
};

// The tiles, by column and row, in which a set-up triangle's bounding box has samples.
struct TouchedBox {
  std::uint16_t first_column, last_column, first_row, last_row;  // all included
};

struct SetupTrianglesArgs {
  GeometryView geometry;
  ViewTransform view;
  const ProjectedVertex* vertices;   // of every vertex
  const std::uint8_t* double_sided;  // per binding: 1 keeps back faces
  int samples;                       // the sample pattern that decides what is empty
  std::uint32_t first, count;        // range of triangles
  SetupTriangle* out;                // room for max_setup_per_triangle * count
  GeometryCounters* counters;        // added to
  TouchedBox* touched = nullptr;     // of each triangle that is written, if wanted
};
inline constexpr int max_setup_per_triangle =
    8;  // a triangle clipped by near plane and guard band is a fan of at most this many

// ------------------------------------------------------------------------------------------------- inside one tile

// Positions of sample s of a pixel, in 1/256 pixel from its top-left corner: the standard Direct3D/Vulkan patterns for
// 1, 2, 4, 8 and 16 samples. Defined in one place: Kernels::sample_pattern.
struct SamplePattern {
  int count;
  std::int32_t x[max_samples], y[max_samples];
};

// Which triangle each sample of a tile sees. Sample planes one after another: index = s * tile_pixels +
// tile_pixel(x, y).
struct VisibilityTile {
  int x, y;           // pixel coordinates of its top-left corner, multiples of tile_size
  int width, height;  // visible part, at most tile_size
  int samples;
  float* depth;             // cleared to 0
  std::uint32_t* triangle;  // cleared to no_triangle
};
inline constexpr std::uint32_t no_triangle = 0xffffffffu;

// A triangle's part of one pixel: the unit that is resolved and shaded, once.
struct Fragment {  // 8 bytes
  std::uint32_t triangle;
  std::uint16_t pixel;    // tile_pixel(x, y)
  std::uint16_t samples;  // bit s: covers sample s
};
static_assert(sizeof(Fragment) == 8);

struct RasterizeArgs {
  VisibilityTile tile;
  const SetupTriangle* triangles;
  const std::uint32_t* list;  // indices into triangles, in submission order
  std::uint32_t count;
  const GeometryView* fetch_ahead = nullptr;  // whose vertices to ask for, as resolve() reads them next
};

struct RasterCounters {
  std::uint64_t samples_tested, samples_passed;
};

inline constexpr double max_coordinate = 1e12;  // metres; distances cubed stay finite
inline constexpr double max_radiance = 1e30;    // a sum of 1e8 of these is still finite

// Surface attributes of shaded fragments, SoA. Everything the shading kernels need, so a G-buffer from a file can be
// shaded, too. Shading reads tables by these values: all of them, up to the next multiple of max_lanes, have to be in
// the ranges given here. Resolving leaves them so; Kernels::clamp_surfaces makes any others so.
struct GBufferView {
  float* position[3];    // world, within +-max_coordinate
  float* normal[3];      // unit shading normal, on the eye's side of the surface for double-sided materials
  float* base_color[3];  // 0 .. 1
  float* metallic;       // 0 .. 1
  float* roughness;      // perceptual, 0 .. 1
  float* occlusion;      // 0 .. 1 = open
  float* emissive[3];    // radiance, 0 .. max_radiance
  float* alpha;          // coverage by alphaMode: 1 for opaque and mask
  float* unlit;          // 1: colour is base_color, not lit; 0 otherwise
  float* depth;          // reversed depth at the shaded point
  // Resolving skips emissive, alpha, unlit and depth where they are null; shading needs the first and third if features
  // say so, and neither of the others.
};
inline constexpr int gbuffer_planes = 18;

struct ResolveArgs {
  GeometryView geometry;
  ViewTransform view;
  const MaterialView* material;  // of every fragment of the run
  SamplePattern pattern;         // the shaded point is the mean of the covered sample positions
  int tile_x, tile_y;
  const Fragment* fragments;
  std::uint32_t count;
  GBufferView out;  // planes already offset to the run's first fragment (which is a multiple of max_lanes)
};

struct ResolveAlphaArgs {  // the same fetch, alpha alone: for alphaMode MASK
  GeometryView geometry;
  ViewTransform view;
  const MaterialView* material;
  SamplePattern pattern;
  int tile_x, tile_y;
  const Fragment* fragments;
  std::uint32_t count;
  float* alpha;  // out
};

}  // namespace tessera
