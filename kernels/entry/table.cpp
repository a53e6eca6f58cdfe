// The table of this instruction set: the one symbol that the rest of the program sees.
#include "kernels/entry/entries.hpp"
#include "kernels/terms.hpp"

#define TESSERA_TEXT2(x) #x
#define TESSERA_TEXT(x) TESSERA_TEXT2(x)

namespace tessera::TESSERA_ISA {

#if defined(__AVX512F__)
inline constexpr int table_lanes = 16;
#elif defined(__AVX2__)
inline constexpr int table_lanes = 8;
#else
inline constexpr int table_lanes = 4;
#endif

extern const Kernels kernels;
const Kernels kernels = {
    TESSERA_TEXT(TESSERA_ISA),
    table_lanes,
    evaluate,
    project_vertices,
    setup_triangles,
    sample_pattern,
    clear_visibility,
    rasterize_opaque,
    collect_triangle,
    commit_fragments,
    collect_visible,
    resolve,
    resolve_alpha,
    terms,
    shade,
    clamp_surfaces,
    background,
    cull_lights,
    store_pixels,
    dfg_table,
    equirect_to_cube,
    faces_to_cube,
    prefilter_cube,
    encode,
    downsample,
    pack_half,
    unpack_half,
};

}  // namespace tessera::TESSERA_ISA
