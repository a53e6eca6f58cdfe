// The environment BRDF (A, B), integral of the specular lobe = F0 A + F90 B, from a table: by where the table's nodes
// lie (axes), how it is read between them (filter), and how a node is stored (format).
//
// Why the warped axes. For small alpha, A and B change where n.v is about alpha, which is r^2: on any grid over (n.v,
// r), or over their roots, that is a corner which no number of nodes resolves. Along rays out of that corner they
// change little, so the axis is the ratio of root n.v to r:
//     u = s (1 + 2 r) / (s + 2 r),  s = sqrt(n.v),   and   v = sqrt(r)
// where each row spans [0,1] whatever its r. Close to u = 1 the nodes are far apart in n.v, and there A and B are
// nearly 1 - (1 - n.v)^5 and (1 - n.v)^5: what is stored is how far the surface is from that, the smooth remainder
//     loss = 1 - A - B   and   drop = (1 - n.v)^5 - B.
// The constant 2 and the root of r were found by trying; nodes lie on the ends of both axes.
#pragma once
#include "kernels/interface.hpp"
#include "kernels/math/approx.hpp"
#include "kernels/simd.hpp"

namespace tessera::TESSERA_ISA {
namespace {

/// Weights of F0 and of F90.
template <class F>
struct EnvironmentBRDF {
  F A, B;
};

// ------------------------------------------------------------------------------------------------------------- axes

template <class F>
struct DfgPosition {
  F x, y;  // in nodes: 0 to size - 1 along NoV and along roughness
};

/// Node i at (i + 1/2) / size in NoV and roughness, as a texture unit has it; holds A and B.
struct DfgLinearAxes {
  template <class F>
  TESSERA_INLINE static DfgPosition<F> position(F NoV, F r, F size) {
    return {mul_sub(NoV, size, F(0.5)), mul_sub(r, size, F(0.5))};
  }
  template <class F>
  TESSERA_INLINE static EnvironmentBRDF<F> value(F first, F second, F) {
    return {first, second};
  }
};

/// Node i at (i / (size - 1))^2; holds A and B.
struct DfgRootAxes {
  template <class F>
  TESSERA_INLINE static DfgPosition<F> position(F NoV, F r, F size) {
    const F last = size - F(1);
    return {sqrt(NoV) * last, sqrt(r) * last};
  }
  template <class F>
  TESSERA_INLINE static EnvironmentBRDF<F> value(F first, F second, F) {
    return {first, second};
  }
};

/// As derived above; holds loss and drop.
struct DfgWarpedAxes {
  template <class F>
  TESSERA_INLINE static DfgPosition<F> position(F NoV, F r, F size) {
    const F last = size - F(1), s = sqrt(NoV), spread = r + r;
    // 1e-30: 0/0 at n.v = r = 0
    return {(s * last) * (F(1) + spread) / max(s + spread, F(1e-30)), sqrt(r) * last};
  }
  template <class F>
  TESSERA_INLINE static EnvironmentBRDF<F> value(F loss, F drop, F NoV) {
    const F B = pow5(F(1) - NoV) - drop;
    return {F(1) - loss - B, B};
  }
};

// ----------------------------------------------------------------------------------------------------------- formats

template <class F>
struct DfgTexel {
  F first, second;
};

TESSERA_INLINE DfgTexel<Float> load_float_pair(const float* texels, Int index) {
  const IntPair pair = gather_pairs(texels, index << 3);
  return {from_bits(pair.low), from_bits(pair.high)};
}
TESSERA_INLINE DfgTexel<double> load_float_pair(const float* texels, std::int64_t index) {
  return {gather(texels, 2 * index), gather(texels, 2 * index + 1)};
}
TESSERA_INLINE Int load_word(const float* texels, Int index) { return bits(gather(texels, index)); }
TESSERA_INLINE std::int64_t load_word(const float* texels, std::int64_t index) {
  return bits(texels[index]);  // sign extended; users mask it
}
TESSERA_INLINE Float half_of(Int bits16, Float) { return half_to_float(bits16); }
TESSERA_INLINE double half_of(std::int64_t bits16, double) {
  return static_cast<double>(half_to_float(static_cast<std::int32_t>(bits16)));
}

/// Two floats.
struct DfgFloatFormat {
  template <class F>
  TESSERA_INLINE static DfgTexel<F> load(const float* texels, IntOf<F> index) {
    return load_float_pair(texels, index);
  }
  template <class F>
  TESSERA_INLINE static F decode(F x) {
    return x;
  }
};

/// Two halves in one word, the first in its low bits.
struct DfgHalfFormat {
  template <class F>
  TESSERA_INLINE static DfgTexel<F> load(const float* texels, IntOf<F> index) {
    using I = IntOf<F>;
    const I word = load_word(texels, index);
    return {half_of(word & I(0xffff), F()), half_of(shift_right_logical(word, 16) & I(0xffff), F())};
  }
  template <class F>
  TESSERA_INLINE static F decode(F x) {
    return x;
  }
};

/// Two numbers from -1/64 to 1 in 16 bits each, in one word: as DfgView's, counted from 0.
struct DfgUnormFormat {
  template <class F>
  TESSERA_INLINE static DfgTexel<F> load(const float* texels, IntOf<F> index) {
    using I = IntOf<F>;
    const I word = load_word(texels, index);
    return {to_float(word & I(0xffff)), to_float(shift_right_logical(word, 16) & I(0xffff))};
  }
  // Filters are linear and their weights sum to 1: once, behind them.
  template <class F>
  TESSERA_INLINE static F decode(F x) {
    return mul_add(x, F(dfg_step), F(-1.0 / 64));
  }
};

// ----------------------------------------------------------------------------------------------------------- filters

struct DfgNearest {
  template <class Format, class F>
  TESSERA_INLINE static DfgTexel<F> filter(const float* texels, int size, F x, F y) {
    using I = IntOf<F>;
    const I i = truncate_to_int(x + F(0.5)), j = truncate_to_int(y + F(0.5));
    return Format::template load<F>(texels, j * I(size) + i);
  }
};

struct DfgBilinear {
  template <class Format, class F>
  TESSERA_INLINE static DfgTexel<F> filter(const float* texels, int size, F x, F y) {
    using I = IntOf<F>;
    const F before_last = F(size - 2);
    const I i = truncate_to_int(min(x, before_last)), j = truncate_to_int(min(y, before_last));
    const F wx = x - to_float(i), wy = y - to_float(j);
    const I index = j * I(size) + i;
    const DfgTexel<F> a = Format::template load<F>(texels, index), b = Format::template load<F>(texels, index + I(1));
    const DfgTexel<F> c = Format::template load<F>(texels, index + I(size)),
                      d = Format::template load<F>(texels, index + I(size + 1));
    const auto blend = [&](F p, F q, F s, F t) {
      const F upper = mul_add(wx, q - p, p), lower = mul_add(wx, t - s, s);
      return mul_add(wy, lower - upper, upper);
    };
    const F first = blend(a.first, b.first, c.first, d.first);
    const F second = blend(a.second, b.second, c.second, d.second);
    return {first, second};
  }
};

/// Weights of four nodes at 0, 1, 2, 3 for the cubic through them (Lagrange).
template <class F>
struct CubicWeights {
  F w[4];
};
template <class F>
TESSERA_INLINE CubicWeights<F> lagrange_weights(F t) {
  const F t1 = t - F(1), t2 = t - F(2), t3 = t - F(3);
  const F outer = t1 * t2 * F(1.0 / 6), inner = t * t3 * F(0.5);
  return {{-outer * t3, inner * t2, -inner * t1, outer * t}};
}

/// The cubic through the four nearest nodes along each axis: 16 in all. Size at least 4.
struct DfgCubic {
  template <class Format, class F>
  TESSERA_INLINE static DfgTexel<F> filter(const float* texels, int size, F x, F y) {
    using I = IntOf<F>;
    const F highest = F(size - 4);
    const I i = truncate_to_int(clamp(x - F(1), F(0), highest)), j = truncate_to_int(clamp(y - F(1), F(0), highest));
    const CubicWeights<F> wx = lagrange_weights(x - to_float(i)), wy = lagrange_weights(y - to_float(j));
    I index = j * I(size) + i;
    DfgTexel<F> sum = {F(0), F(0)};
    for (int row = 0; row < 4; ++row) {
      DfgTexel<F> line = {F(0), F(0)};
      for (int column = 0; column < 4; ++column) {
        const DfgTexel<F> texel = Format::template load<F>(texels, index + I(column));
        line = {mul_add(wx.w[column], texel.first, line.first), mul_add(wx.w[column], texel.second, line.second)};
      }
      sum = {mul_add(wy.w[row], line.first, sum.first), mul_add(wy.w[row], line.second, sum.second)};
      index = index + I(size);
    }
    return sum;
  }
};

/// NoV and r (perceptual) in [0,1], clamped; size x size nodes, row j = roughness, at least 2 (4 for cubic) and at most
/// 4096. From a table that holds numbers, A and B are finite, and at least 0 whatever the filter overshoots.
template <class Axes, class Filter, class Format, class F>
TESSERA_INLINE EnvironmentBRDF<F> look_up_dfg(const float* texels, int size, F NoV, F r) {
  const F c = saturate(NoV);
  const DfgPosition<F> p = Axes::position(c, saturate(r), F(size));
  const F last = F(size - 1);
  const DfgTexel<F> texel =
      Filter::template filter<Format>(texels, size, clamp(p.x, F(0), last), clamp(p.y, F(0), last));
  const EnvironmentBRDF<F> ab = Axes::value(Format::decode(texel.first), Format::decode(texel.second), c);
  return {max(ab.A, F(0)), max(ab.B, F(0))};
}

}  // namespace
}  // namespace tessera::TESSERA_ISA
