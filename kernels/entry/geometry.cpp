#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {
void project_vertices(const ViewTransform&, const float*, std::uint32_t, ProjectedVertex*) { __builtin_trap(); }
std::uint32_t setup_triangles(const SetupTrianglesArgs&) { __builtin_trap(); }
}  // namespace tessera::TESSERA_ISA
