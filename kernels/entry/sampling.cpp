// Sampling by format, layout and filter: one function for each combination.
#include "kernels/sampling.hpp"

#include "kernels/light/environment.hpp"
#include "kernels/texture/variants.hpp"

#define TESSERA_TEXT2(x) #x
#define TESSERA_TEXT(x) TESSERA_TEXT2(x)

namespace tessera::TESSERA_ISA {
namespace {

// A place on a texture of any size: the face, and coordinates from 0 to 1.
struct Place {
  Int face;
  Float s, t;
};

template <bool cube>
TESSERA_INLINE Place place_of(const Float (&in)[4]) {
  if constexpr (cube) {
    const CubePoint<Float> p = cube_point_of_any(Vec3<Float>{in[0], in[1], in[2]});
    return {p.face, saturate(mul_add(p.s, Float(0.5), Float(0.5))), saturate(mul_add(p.t, Float(0.5), Float(0.5)))};
  } else {
    return {Int(0), saturate(in[0] - floor(in[0])), saturate(in[1] - floor(in[1]))};  // NaN: 0
  }
}

template <SamplingFormat format, SamplingLayout layout, bool linear, bool cube>
TESSERA_INLINE Rgb sample_level_at(const SamplingView& view, const Place& place, Int level) {
  constexpr SamplingEdge edge = cube ? SamplingEdge::clamp : SamplingEdge::repeat;
  const Float n = from_bits(bits(Float(view.size)) - (level << 23));  // size >> level, exactly
  const Int ni = truncate_to_int(n), size(view.size);
  // Texels of the finer levels: the sum of their squares is 4/3 (size^2 - n^2),
  // six times that for a cube. Powers of 4 differ by multiples of 3, which the
  // inverse of 3 modulo 2^32 divides.
  const Int squares = (size - ni) * (size + ni);
  const Int finer = cube ? squares << 3 : (squares * Int(0xaaaaaaabu)) << 2;
  const Int start = finer + place.face * (ni * ni);
  if constexpr (linear) {
    return bilinear_sample<format, layout, edge>(view.texels, place.s, place.t, n, ni, start);
  } else {
    return nearest_sample<format, layout>(view.texels, place.s, place.t, n, ni, start);
  }
}

template <SamplingFormat format, SamplingLayout layout, SamplingFilter filter, bool cube>
TESSERA_INLINE Rgb sample_at(const SamplingView& view, const Float (&in)[4]) {
  const Place place = place_of<cube>(in);
  if constexpr (filter != SamplingFilter::trilinear) {
    return sample_level_at<format, layout, filter == SamplingFilter::bilinear, cube>(view, place, Int(0));
  } else {
    const Float lod = clamp(in[cube ? 3 : 2], Float(0), Float(view.levels - 1));
    const Int fine = truncate_to_int(lod), coarse = min(fine + Int(1), Int(view.levels - 1));
    const Float blend = lod - to_float(fine);
    const Rgb a = sample_level_at<format, layout, true, cube>(view, place, fine);
    const Rgb b = sample_level_at<format, layout, true, cube>(view, place, coarse);
    Rgb out;
    for (int k = 0; k < 3; ++k) out.channel[k] = mul_add(blend, b.channel[k] - a.channel[k], a.channel[k]);
    return out;
  }
}

template <SamplingFilter filter, bool cube>
inline constexpr int sampling_inputs = (cube ? 3 : 2) + (filter == SamplingFilter::trilinear ? 1 : 0);

// One copy of the code per combination.
template <SamplingFormat format, SamplingLayout layout, SamplingFilter filter, bool cube>
[[gnu::noinline]] void sample_vectors(const SamplingArgs& args, std::size_t vectors) {
  const SamplingArgs a = args;
  Float in[4] = {Float(0), Float(0), Float(0), Float(0)};
  for (std::size_t i = 0; i < vectors * static_cast<std::size_t>(Float::lanes); i += Float::lanes) {
    for (int k = 0; k < sampling_inputs<filter, cube>; ++k) in[k] = load<Float>(a.in[k] + i);
    const Rgb rgb = sample_at<format, layout, filter, cube>(a.texture, in);
    for (int k = 0; k < 3; ++k) store(a.out[k] + i, rgb.channel[k]);
  }
}

template <SamplingFormat format, SamplingLayout layout, SamplingFilter filter, bool cube>
void run_sampling(const SamplingArgs& args) {
  constexpr auto lanes = static_cast<std::size_t>(Float::lanes);
  const std::size_t vectors = args.count / lanes, done = vectors * lanes;
  sample_vectors<format, layout, filter, cube>(args, vectors);
  if (done == args.count) return;
  float in[4][lanes], out[3][lanes];
  SamplingArgs rest = args;
  for (int k = 0; k < sampling_inputs<filter, cube>; ++k) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
      in[k][lane] = args.in[k][done + lane < args.count ? done + lane : done];
    rest.in[k] = in[k];
  }
  for (int k = 0; k < 3; ++k) rest.out[k] = out[k];
  sample_vectors<format, layout, filter, cube>(rest, 1);
  for (int k = 0; k < 3; ++k)
    for (std::size_t lane = 0; done + lane < args.count; ++lane) args.out[k][done + lane] = out[k][lane];
}

template <SamplingFormat f, SamplingLayout l, SamplingFilter filter, bool cube>
constexpr SamplingKernel kernel() {
  return {f, l, filter, cube, run_sampling<f, l, filter, cube>};
}

#define TESSERA_FILTERS(f, l, cube)                                                   \
  kernel<SamplingFormat::f, SamplingLayout::l, SamplingFilter::nearest, cube>(),      \
      kernel<SamplingFormat::f, SamplingLayout::l, SamplingFilter::bilinear, cube>(), \
      kernel<SamplingFormat::f, SamplingLayout::l, SamplingFilter::trilinear, cube>()
#define TESSERA_LAYOUTS(f)                                                                                   \
  TESSERA_FILTERS(f, linear, false), TESSERA_FILTERS(f, tiled_4, false), TESSERA_FILTERS(f, tiled_8, false), \
      TESSERA_FILTERS(f, morton, false), TESSERA_FILTERS(f, linear, true), TESSERA_FILTERS(f, morton, true)

// Cubes by rows and by Morton order alone: what tiles do is seen on 2D textures.
constexpr SamplingKernel list[] = {TESSERA_LAYOUTS(rgba32_float), TESSERA_LAYOUTS(rgba16_float),
                                   TESSERA_LAYOUTS(rgb9_e5), TESSERA_LAYOUTS(r11_g11_b10)};

}  // namespace

extern const SamplingKernels sampling;
const SamplingKernels sampling = {TESSERA_TEXT(TESSERA_ISA), list, static_cast<int>(sizeof list / sizeof *list)};

}  // namespace tessera::TESSERA_ISA
