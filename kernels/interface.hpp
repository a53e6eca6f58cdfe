// The border between the kernels and everything else: plain views of memory, and one table of function pointers that
// each instruction set fills in. This is the only kernel header that src/, bench/ and tests/ include.
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

// Surface attributes of shaded fragments, SoA. Everything the shading kernels need, so a G-buffer from a file can be
// shaded.
struct GBufferView {
  float* position[3];  // world
  float* normal[3];    // unit shading normal, on the eye's side of the surface for double-sided materials
  float* base_color[3];
  float* metallic;
  float* roughness;    // perceptual, 0..1, not clamped
  float* occlusion;    // 1 = open
  float* emissive[3];  // radiance
  float* alpha;        // coverage by alphaMode: 1 for opaque and mask
  float* unlit;        // 1: colour is base_color, not lit; 0 otherwise
  float* depth;        // reversed depth at the shaded point
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

// -------------------------------------------------------------------------------------------------------- lighting

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
  rgba16_float,  // four halves
  rgb9_e5,       // one 32-bit word: nine bits a channel from the lowest on, five bits of a common exponent
};

// A cubemap with mips. Every face of every level has a border of one texel, so that a bilinear footprint never leaves
// it: (n + 2) x (n + 2) texels, the border holding the neighbouring faces' texels (corners: the mean of the other three
// taps).
struct CubeView {
  const std::uint16_t* texels;  // level 0 first; in a level faces; in a face rows
  int size;                     // texels along a face of level 0, without the border; a power of two
  int levels;
  CubeFormat format = CubeFormat::rgba16_float;  // of EnvironmentView::specular alone; all others are halves
};
inline constexpr std::size_t cube_level_offset(int size, int level) {  // in texels, from level 0
  std::size_t offset = 0;
  for (int k = 0; k < level; ++k) offset += std::size_t{6} * ((size >> k) + 2) * ((size >> k) + 2);
  return offset;
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
// err a thousand times less between the nodes.
struct DfgView {
  const float* texels;
  int size;
  bool warped = false;
};

enum ShadeFeature : std::uint32_t {  // what a set of fragments calls for; the smallest kernel that covers it is run
  feature_lights = 1,
  feature_environment = 2,
  feature_emissive = 4,
  feature_unlit = 8,
  feature_all = 15,
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
  float* radiance[3];  // out, SoA; not multiplied by alpha
  // Where the next fragments will be read from memory: that many floats ahead in every plane lies what is fetched
  // meanwhile. 0: the planes are in the cache already, as a tile's are.
  std::uint32_t fetch_ahead;
  EnvironmentShading environment_shading = {};
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

struct StorePixelsArgs {     // opaque radiance -> pixels of a film
  const float* radiance[3];  // in blocks of 4 x 4 as in a tile, but width / 4 blocks in a row
  int width, height;         // width: a multiple of 4
  float* rgba;               // of the first pixel; alpha becomes 1
  std::size_t row_stride;    // in floats
};

struct BackgroundArgs {           // radiance of the environment along pixel rays
  float corner[3], dx[3], dy[3];  // direction(x, y) = corner + x dx + y dy, pixel coordinates; need not be unit
  CubeView cube;
  float lod;           // blur
  const float *x, *y;  // pixel coordinates of each ray
  std::uint32_t count;
  float* radiance[3];
};

// ----------------------------------------------------------------------------------------------------- tables, images

struct DfgTableArgs {
  float* out;  // the whole table: DfgView::texels
  int size;
  int row_begin, row_end;
};

struct EquirectView {   // radiance; column u = 0.5 + atan2(z, x) / 2pi, row v = acos(y) / pi from the top
  const float* texels;  // RGB, stride 3, finite and non-negative; width * height < 2^29
  int width, height;
};

struct CubeRows {  // rows of one face that a kernel fills, without the border
  int face, size;
  int row_begin, row_end;
  float* out;                         // RGBA, size * size of the whole face
  int column_begin = 0, columns = 0;  // a power of two of them; 0: all
};

struct EquirectToCubeArgs {
  EquirectView source;
  float rotation[2];  // cos, sin: the environment is turned about +Y, counter-clockwise seen from above
  int samples;        // per texel, along each side: a box filter over samples^2 bilinear lookups
  CubeRows rows;
};

struct CubeFacesView {  // radiance on six faces of any size, in the order and orientation of a CubeView
  const float* texels;  // RGB, stride 3, finite and non-negative; 6 * size * size < 2^29
  int size;
};

struct FacesToCubeArgs {
  CubeFacesView source;
  float rotation[2];  // cos, sin: as EquirectToCubeArgs::rotation
  int samples;        // per texel, along each side
  CubeRows rows;
};

// Points of a lobe about the +z axis: the same for all texels of a level.
struct LobeSamples {
  const float *x, *y, *z;  // unit directions
  const float* weight;     // sums to 1
  const float* lod;        // level of the radiance cube to read
  int count;
};

// Small bright sources, summed one by one: points of a lobe would hit or miss them.
struct PointSources {
  const float *x, *y, *z;           // unit directions
  const float *red, *green, *blue;  // radiance times solid angle
  int count;
  float alpha2, scale;  // the lobe: scale c / (alpha2 + (1 - alpha2) (1 - c) / 2)^2 at cosine c from its axis
  const float* solid_angle = nullptr;  // of each source, if they are all there is: the sum is then a weighted mean over
                                       // them, and `scale` does not matter
};

struct PrefilterCubeArgs {
  CubeView radiance;  // bordered mips of plain radiance
  LobeSamples lobe;   // none: points alone
  CubeRows rows;
  PointSources points;
};

enum class ToneCurve : std::uint32_t { none, reinhard, aces, khronos_neutral };

struct EncodeArgs {   // film -> what a display shows
  const float* rgba;  // linear, premultiplied
  std::size_t count;  // pixels
  float exposure;     // factor, applied before the curve
  ToneCurve curve;
  std::uint8_t* out;  // sRGB-encoded RGBA, straight alpha (PNG's convention)
};

struct DownsampleArgs {  // one mip level from the one above it, box filter in linear light
  const float* in;       // RGBA
  int width, height;
  float* out;  // max(1, width/2) x max(1, height/2)
};

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

// ------------------------------------------------------------------------------------------------------------ table

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
