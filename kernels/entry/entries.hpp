// What the entry files of one instruction set define, collected by table.cpp. Everything else in a kernel translation
// unit lives in an anonymous namespace.
#pragma once
#include "kernels/interface.hpp"

namespace tessera::TESSERA_ISA {

void evaluate(MathFunction f, const float* a, const float* b, float* out, std::size_t count);  // math.cpp

void project_vertices(const ViewTransform&, const float* positions, std::uint32_t count,
                      ProjectedVertex* out);  // geometry.cpp
std::uint32_t setup_triangles(const SetupTrianglesArgs&);

SamplePattern sample_pattern(int samples);  // coverage.cpp
void clear_visibility(const VisibilityTile&);
void rasterize_opaque(const RasterizeArgs&, RasterCounters*);
std::uint32_t collect_triangle(const VisibilityTile&, const SetupTriangle&, bool split_samples, Fragment* out);
void commit_fragments(const VisibilityTile&, const SetupTriangle&, const Fragment*, const std::uint8_t* keep,
                      std::uint32_t count);
std::uint32_t collect_visible(const VisibilityTile&, Fragment* out);

void resolve(const ResolveArgs&);  // resolve.cpp
void resolve_alpha(const ResolveAlphaArgs&);

extern const TermSpan<float>* const terms[];  // terms.cpp

void shade(const ShadeArgs&);  // shade.cpp
void clamp_surfaces(const GBufferView&, std::uint32_t count);
void background(const BackgroundArgs&);
std::uint32_t cull_lights(const CullLightsArgs&);
void store_pixels(const StorePixelsArgs&);

void dfg_table(const DfgTableArgs&);  // bake.cpp
void equirect_to_cube(const EquirectToCubeArgs&);
void faces_to_cube(const FacesToCubeArgs&);
void prefilter_cube(const PrefilterCubeArgs&);

void encode(const EncodeArgs&);  // image.cpp
void downsample(const DownsampleArgs&);
void pack_half(const float* in, std::uint16_t* out, std::size_t count);
void unpack_half(const std::uint16_t* in, float* out, std::size_t count);

}  // namespace tessera::TESSERA_ISA
