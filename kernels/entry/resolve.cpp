#include "kernels/raster/resolve.hpp"
#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {

void resolve(const ResolveArgs& args) {
  if (has_texture(*args.material))
    resolve_run<true>(args);
  else
    resolve_run<false>(args);
}

void resolve_alpha(const ResolveAlphaArgs& args) {
  if (args.material->base_color_texture.texture != nullptr)
    resolve_alpha_run<true>(args);
  else
    resolve_alpha_run<false>(args);
}

}  // namespace tessera::TESSERA_ISA
