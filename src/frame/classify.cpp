#include "frame/classify.hpp"

namespace tessera {

std::uint32_t classify(const MaterialView& m, std::uint32_t frame_features) {
  if (m.unlit) return feature_unlit;  // every fragment shows its colour as it is
  std::uint32_t features = frame_features & (feature_lights | feature_environment);
  if (m.emissive[0] > 0 || m.emissive[1] > 0 || m.emissive[2] > 0) features |= feature_emissive;
  return features;
}

std::uint32_t classify(const GBufferView& gbuffer, std::uint32_t count, std::uint32_t frame_features) {
  std::uint32_t features = frame_features & (feature_lights | feature_environment);
  bool emissive = false, unlit = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    emissive |= gbuffer.emissive[0][i] > 0 || gbuffer.emissive[1][i] > 0 || gbuffer.emissive[2][i] > 0;
    unlit |= gbuffer.unlit[i] != 0;
  }
  if (emissive) features |= feature_emissive;
  if (unlit) features |= feature_unlit;
  return features;
}

}  // namespace tessera
