// From film to display, mip levels, and half floats in arrays.
#include "kernels/entry/entries.hpp"
#include "kernels/math/color.hpp"
#include "kernels/tonemap/curve.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// 0..1 -> 0..255, halves up; NaN and negative values -> 0.
TESSERA_INLINE Int to_byte(Float x) { return truncate_to_int(mul_add(saturate(x), Float(255), Float(0.5))); }

// to_byte(linear_to_srgb(x)), or its neighbour where x is within 2e-4 of a byte of the middle between two: for eight
// bits a logarithm and a power in single precision are enough.
TESSERA_INLINE Int srgb_byte(Float x) {
  // IEC 61966-2-1:1999, clause 5.2.
  const Float c = clamp(x, Float(0.0031308), Float(1));
  const Float exponent = log2_positive(c) * Float(1.0 / 2.4);
  const Int whole = round_to_int(exponent);
  const Float power = from_bits(bits(exp2_fraction(exponent - to_float(whole))) + (whole << 23));
  const Float curved = mul_sub(power, Float(1.055), Float(0.055));
  return to_byte(select(x > Float(0.0031308), curved, x * Float(12.92)));
}

// One pixel per lane, linear premultiplied RGBA -> the four bytes of a pixel, red lowest.
template <ToneCurve curve>
TESSERA_INLINE Int encode_pixels(Vec3<Float> premultiplied, Float alpha, Float exposure) {
  // The curve is for the colour itself: 1e18 keeps its square finite, NaN and negative values become 0.
  const auto straight = [&](Float channel) {
    return select(alpha > Float(0), clamp((channel / alpha) * exposure, Float(0), Float(1e18)), Float(0));
  };
  Vec3<Float> c{straight(premultiplied.x), straight(premultiplied.y), straight(premultiplied.z)};
  if constexpr (curve == ToneCurve::reinhard) c = tone_reinhard(c);
  if constexpr (curve == ToneCurve::aces) c = tone_aces(c);
  if constexpr (curve == ToneCurve::khronos_neutral) c = tone_khronos_neutral(c);
  return srgb_byte(c.x) | (srgb_byte(c.y) << 8) | (srgb_byte(c.z) << 16) | (to_byte(alpha) << 24);
}

template <ToneCurve curve>
void encode_as(const EncodeArgs& args) {
  constexpr std::size_t lanes = Float::lanes;
  const auto encode_vector = [&](const float* rgba) {
    Float channel[4];
    load_quads(rgba, channel);
    return encode_pixels<curve>({channel[0], channel[1], channel[2]}, channel[3], Float(args.exposure));
  };
  // Red, green and blue of `count` pixels; each pixel's fourth byte is the next one's first.
  const auto store_rgb = [&](Int pixels, std::size_t count, std::uint8_t* out) {
    std::uint32_t words[lanes];
    __builtin_memcpy(words, &pixels, sizeof words);
    for (std::size_t k = 0; k + 1 < count; ++k) __builtin_memcpy(out + 3 * k, &words[k], 4);
    __builtin_memcpy(out + 3 * (count - 1), &words[count - 1], 3);
  };
  float rest[4 * lanes] = {};  // of the last vector, if there is too little for one
  for (std::size_t i = 0; i < args.count; i += lanes) {
    const std::size_t left = args.count - i, count = left < lanes ? left : lanes;
    const float* rgba = args.rgba + 4 * i;
    if (count < lanes) {
      for (std::size_t k = 0; k < 4 * count; ++k) rest[k] = rgba[k];
      rgba = rest;
    }
    const Int pixels = encode_vector(rgba);
    if (args.channels == 3)
      store_rgb(pixels, count, args.out + 3 * i);
    else
      __builtin_memcpy(args.out + 4 * i, &pixels, 4 * count);
  }
}

// How many inputs an output covers along an axis of this size. Halving an odd size 2n + 1 to n, an output spans
// 2 + 1/n inputs: three, of which the outer two in part.
TESSERA_INLINE int tap_count(int size) { return size == 1 ? 1 : size % 2 == 0 ? 2 : 3; }

// The share of input 2i + tap in output i. Guthe and Heckbert 2005, "Non-Power-of-Two Mipmapping".
template <class F>
TESSERA_INLINE F tap_weight(int size, int tap, F i) {
  if (size == 1) return F(1);
  if (size % 2 == 0) return F(0.5);
  const F whole = F(size), half = F(size / 2);
  return (tap == 0 ? half - i : tap == 1 ? half : i + F(1)) / whole;
}

// One row of outputs. Lanes run over the floats of the row, so that the four channels need no shuffling.
TESSERA_INLINE void downsample_row(const DownsampleArgs& args, int j, int width, float* out) {
  const int x_taps = tap_count(args.width), y_taps = tap_count(args.height);
  const std::size_t row_floats = std::size_t{4} * args.width;
  const float* rows = args.in + 2 * j * row_floats;
  for (int f = 0; f < 4 * width; f += Float::lanes) {
    // Lanes beyond the end repeat the last texel and are not stored.
    const Int here = min(Int(f) + lane_index(), Int(4 * width - 1));
    const Int i = here >> 2, index = (i << 3) + (here & Int(3));
    Float sum(0);
    for (int v = 0; v < y_taps; ++v) {
      const float* row = rows + v * row_floats;
      Float along(0);
      for (int u = 0; u < x_taps; ++u)
        along = mul_add(gather(row + 4 * u, index), tap_weight(args.width, u, to_float(i)), along);
      sum = mul_add(along, tap_weight(args.height, v, Float(j)), sum);
    }
    if (f + Float::lanes <= 4 * width)
      store(out + f, sum);
    else
      store_masked(out + f, sum, first_lanes(4 * width - f));
  }
}

}  // namespace

void encode(const EncodeArgs& args) {
  switch (args.curve) {
    case ToneCurve::none:
      return encode_as<ToneCurve::none>(args);
    case ToneCurve::reinhard:
      return encode_as<ToneCurve::reinhard>(args);
    case ToneCurve::aces:
      return encode_as<ToneCurve::aces>(args);
    case ToneCurve::khronos_neutral:
      return encode_as<ToneCurve::khronos_neutral>(args);
  }
}

// All four channels alike: colours are not weighted by alpha (glTF's base colours are straight, and so are their mips
// in every sampler that people compare with).
void downsample(const DownsampleArgs& args) {
  const int width = args.width > 1 ? args.width / 2 : 1, height = args.height > 1 ? args.height / 2 : 1;
  for (int j = 0; j < height; ++j) downsample_row(args, j, width, args.out + std::size_t{4} * width * j);
}

void pack_half(const float* in, std::uint16_t* out, std::size_t count) {
  constexpr std::size_t lanes = Float::lanes;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) store_half(out + i, load<Float>(in + i));
  if (i == count) return;
  float rest[lanes] = {};
  std::uint16_t packed[lanes];
  for (std::size_t k = 0; i + k < count; ++k) rest[k] = in[i + k];
  store_half(packed, load<Float>(rest));
  for (std::size_t k = 0; i + k < count; ++k) out[i + k] = packed[k];
}

void unpack_half(const std::uint16_t* in, float* out, std::size_t count) {
  constexpr std::size_t lanes = Float::lanes;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) store(out + i, load_half(in + i));
  if (i == count) return;
  std::uint16_t rest[lanes] = {};
  for (std::size_t k = 0; i + k < count; ++k) rest[k] = in[i + k];
  store_masked(out + i, load_half(rest), first_lanes(static_cast<int>(count - i)));
}

}  // namespace tessera::TESSERA_ISA
