#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {
SamplePattern sample_pattern(int) { __builtin_trap(); }
void clear_visibility(const VisibilityTile&) { __builtin_trap(); }
void rasterize_opaque(const RasterizeArgs&, RasterCounters*) { __builtin_trap(); }
std::uint32_t collect_triangle(const VisibilityTile&, const SetupTriangle&, bool, Fragment*) { __builtin_trap(); }
void commit_fragments(const VisibilityTile&, const SetupTriangle&, const Fragment*, const std::uint8_t*,
                      std::uint32_t) {
  __builtin_trap();
}
std::uint32_t collect_visible(const VisibilityTile&, Fragment*) { __builtin_trap(); }
}  // namespace tessera::TESSERA_ISA
