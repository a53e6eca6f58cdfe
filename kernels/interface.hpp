// The border between the kernels and everything else: plain views of memory, and one table of function pointers that
// each instruction set fills in. This is the only kernel header that src/, bench/ and tests/ include; its parts, by the
// stages of a frame, are in kernels/interface/.
//
// Conventions, once for all kernels
//   World: right-handed, +Y up. Cameras look along their -Z (glTF).
//   Pixels: x to the right, y DOWN, the centre of the top-left pixel is (0.5, 0.5).
//   Depth: reversed; larger is nearer, 0 is infinitely far (or the far plane of an orthographic camera).
//   Directions are unit vectors; v points from the surface to the eye, l from the surface to the light.
//   r = perceptual roughness, alpha = r * r.   Radiance and reflectance are linear Rec.709, 3 floats.
//   Cube faces in the order +X -X +Y -Y +Z -Z, s and t as OpenGL and Vulkan define them, row 0 at t = 0.
// Arrays named SoA hold one plane per component. Planes written by kernels are padded: their capacity is a multiple
// of max_lanes, they start on 64-byte boundaries, and kernels may write (never read meaningfully) past `count` up to
// that multiple. No kernel allocates, throws, or keeps state.
#pragma once
#include <cstddef>
#include <cstdint>

#include "kernels/interface/baking.hpp"
#include "kernels/interface/raster.hpp"
#include "kernels/interface/scene.hpp"
#include "kernels/interface/shading.hpp"

namespace tessera {

// Array forms of scalar functions: for set-up code outside the kernels, for tests and for charts.
enum class MathFunction : std::uint32_t {
  exp2,
  log2,
  exp,
  log,
  pow,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan2,
  cbrt,
  srgb_to_linear,
  linear_to_srgb,
  half_to_float,
  float_to_half,
};

// The catalogue's methods over arrays: kernels/terms.hpp.
template <class Number>
struct TermSpan;

struct Kernels {
  const char* isa;  // "sse42", "avx2", "avx512", "neon64"
  int lanes;

  // out[i] = f(a[i], b[i]); b is read by pow and atan2(a = y, b = x) only. Halves travel as the integers 0..65535 in
  // floats.
  void (*evaluate)(MathFunction f, const float* a, const float* b, float* out, std::size_t count);

  // entry/geometry.cpp
  void (*project_vertices)(const ViewTransform&, const float* positions, std::uint32_t count, ProjectedVertex* out);
  std::uint32_t (*setup_triangles)(const SetupTrianglesArgs&);  // how many were written

  // entry/coverage.cpp
  SamplePattern (*sample_pattern)(int samples);
  void (*clear_visibility)(const VisibilityTile&);
  void (*rasterize_opaque)(
      const RasterizeArgs&,
      RasterCounters*);  // nearest wins; equal depth: the lower triangle index; counters may be null
  // Fragments of one triangle that pass the depth test, without writing depth; room for tile_pixels (* samples if
  // split).
  std::uint32_t (*collect_triangle)(const VisibilityTile&, const SetupTriangle&, bool split_samples, Fragment* out);
  // Writes depth and id of such a triangle where keep[i] != 0 (alphaMode MASK).
  void (*commit_fragments)(const VisibilityTile&, const SetupTriangle&, const Fragment*, const std::uint8_t* keep,
                           std::uint32_t count);
  // The distinct (pixel, triangle) pairs of the finished tile, pixels ascending, triangles ascending in a pixel; room
  // for tile_pixels * samples.
  std::uint32_t (*collect_visible)(const VisibilityTile&, Fragment* out);

  // entry/resolve.cpp
  void (*resolve)(const ResolveArgs&);
  void (*resolve_alpha)(const ResolveAlphaArgs&);

  // entry/terms_*.cpp
  const TermSpan<float>* const* terms;  // lists, null-terminated

  // entry/shade.cpp
  void (*shade)(const ShadeArgs&);
  // Puts what shading reads of `count` fragments, rounded up to max_lanes, into GBufferView's ranges (a normal's
  // components into [-1, 1]); NaN becomes the lower end. Planes that are null are skipped.
  void (*clamp_surfaces)(const GBufferView&, std::uint32_t count);
  void (*background)(const BackgroundArgs&);
  // Indices of the lights whose range reaches the fragments' bounding box, ascending; how many. Any other light adds
  // exactly nothing to any of the fragments.
  std::uint32_t (*cull_lights)(const CullLightsArgs&);
  void (*store_pixels)(const StorePixelsArgs&);

  // entry/bake.cpp
  void (*dfg_table)(const DfgTableArgs&);
  void (*equirect_to_cube)(const EquirectToCubeArgs&);
  void (*faces_to_cube)(const FacesToCubeArgs&);
  void (*prefilter_cube)(const PrefilterCubeArgs&);

  // entry/image.cpp
  void (*encode)(const EncodeArgs&);
  void (*downsample)(const DownsampleArgs&);
  void (*pack_half)(const float* in, std::uint16_t* out, std::size_t count);  // round to nearest even
  void (*unpack_half)(const std::uint16_t* in, float* out, std::size_t count);
};

// The tables that this build holds, narrowest first, null-terminated. Calling a kernel the CPU lacks is undefined:
// choose through src/frame/dispatch.
extern const Kernels* const kernel_tables[];

}  // namespace tessera
