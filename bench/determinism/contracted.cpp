#include "bench/determinism/contracted.hpp"

#include <cstring>
#include <stdexcept>

// What entry/*.cpp define, in the namespaces of the contracted builds.
#define TESSERA_CONTRACTED(isa)                                                                                     \
  namespace tessera::isa##_contracted {                                                                             \
    void project_vertices(const ViewTransform&, const float* positions, std::uint32_t count, ProjectedVertex* out); \
    std::uint32_t setup_triangles(const SetupTrianglesArgs&);                                                       \
    void rasterize_opaque(const RasterizeArgs&, RasterCounters*);                                                   \
    std::uint32_t collect_triangle(const VisibilityTile&, const SetupTriangle&, bool split_samples, Fragment* out); \
    std::uint32_t collect_visible(const VisibilityTile&, Fragment* out);                                            \
    void resolve(const ResolveArgs&);                                                                               \
    void resolve_alpha(const ResolveAlphaArgs&);                                                                    \
    void shade(const ShadeArgs&);                                                                                   \
    void background(const BackgroundArgs&);                                                                         \
    std::uint32_t cull_lights(const CullLightsArgs&);                                                               \
    void store_pixels(const StorePixelsArgs&);                                                                      \
    inline void put_into(Kernels& kernels) {                                                                        \
      kernels.project_vertices = project_vertices;                                                                  \
      kernels.setup_triangles = setup_triangles;                                                                    \
      kernels.rasterize_opaque = rasterize_opaque;                                                                  \
      kernels.collect_triangle = collect_triangle;                                                                  \
      kernels.collect_visible = collect_visible;                                                                    \
      kernels.resolve = resolve;                                                                                    \
      kernels.resolve_alpha = resolve_alpha;                                                                        \
      kernels.shade = shade;                                                                                        \
      kernels.background = background;                                                                              \
      kernels.cull_lights = cull_lights;                                                                            \
      kernels.store_pixels = store_pixels;                                                                          \
    }                                                                                                               \
  }

#if defined(__x86_64__)
TESSERA_CONTRACTED(avx2)
TESSERA_CONTRACTED(avx512)
#else
TESSERA_CONTRACTED(neon64)
#endif

namespace tessera::determinism {
namespace {

struct Build {
  const char* isa;
  void (*put_into)(Kernels&);
};
#if defined(__x86_64__)
constexpr Build builds[] = {{"avx2", avx2_contracted::put_into}, {"avx512", avx512_contracted::put_into}};
#else
constexpr Build builds[] = {{"neon64", neon64_contracted::put_into}};
#endif

const Build* build_of(const Kernels& kernels) {
  for (const Build& build : builds)
    if (std::strcmp(build.isa, kernels.isa) == 0) return &build;
  return nullptr;
}

}  // namespace

bool can_contract(const Kernels& kernels) { return build_of(kernels) != nullptr; }

Kernels contracted(const Kernels& kernels) {
  const Build* build = build_of(kernels);
  if (build == nullptr) throw std::invalid_argument(kernels.isa);
  Kernels other = kernels;
  build->put_into(other);
  return other;
}

}  // namespace tessera::determinism
