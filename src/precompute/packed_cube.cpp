#include "precompute/packed_cube.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "precompute/sampling_texture.hpp"

namespace tessera {

PackedCube::PackedCube(const Cube& cube, const Kernels& kernels) : size_(cube.size()), levels_(cube.levels()) {
  const std::size_t count = cube_texel_count(size_, levels_);
  texels_.resize(2 * count + 2);  // a lookup of a level's last texel reads the one behind it
  constexpr std::size_t piece = 4096;
  parallel_for((count + piece - 1) / piece, [&](std::size_t k) {
    const std::size_t first = k * piece, most = std::min(piece, count - first);
    AlignedVector<float> rgba(4 * most);
    kernels.unpack_half(cube.texels().data() + 4 * first, rgba.data(), rgba.size());
    for (std::size_t i = 0; i < most; ++i) {
      const float* texel = &rgba[4 * i];
      const std::uint32_t word = encode_sampling_texel(SamplingFormat::rgb9_e5, {texel[0], texel[1], texel[2]})[0];
      texels_[2 * (first + i)] = static_cast<std::uint16_t>(word);
      texels_[2 * (first + i) + 1] = static_cast<std::uint16_t>(word >> 16);
    }
  });
}

}  // namespace tessera
