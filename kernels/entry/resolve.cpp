#include "kernels/raster/resolve.hpp"
#include "kernels/entry/entries.hpp"

namespace tessera::TESSERA_ISA {

void resolve(const ResolveArgs& args) {
  if (args.geometry.surfaces != nullptr)
    resolve_surface_run(args);
  else if (has_texture(*args.material))
    resolve_run<true>(args);
  else
    resolve_run<false>(args);
}

void resolve_alpha(const ResolveAlphaArgs& args) {
  if (args.geometry.surfaces != nullptr) {  // alpha is the material's alone
    const Float alpha = saturate(Float(args.material->base_color[3]));
    for (std::uint32_t i = 0; i < args.count; i += Float::lanes) store(args.alpha + i, alpha);
  } else if (args.material->base_color_texture.texture != nullptr)
    resolve_alpha_run<true>(args);
  else
    resolve_alpha_run<false>(args);
}

}  // namespace tessera::TESSERA_ISA
