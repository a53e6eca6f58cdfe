// Array forms of the scalar functions.
#include "kernels/entry/entries.hpp"
#include "kernels/math/color.hpp"

namespace tessera::TESSERA_ISA {
namespace {

// The last, partial vector is padded with zeros, so that every element goes through the same instructions.
template <class Function>
TESSERA_INLINE void apply(Function function, const float* a, const float* b, float* out, std::size_t count) {
  constexpr std::size_t lanes = Float::lanes;
  // A NaN's sign and payload depend on the machine that made it: one NaN for all.
  const auto evaluate_vector = [&](const float* x, const float* y) {
    const Float value = function(load<Float>(x), load<Float>(y));
    return select(is_nan(value), Float(__builtin_nanf("")), value);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) store(out + i, evaluate_vector(a + i, b + i));
  if (i == count) return;
  float a_rest[lanes] = {}, b_rest[lanes] = {};
  for (std::size_t k = 0; i + k < count; ++k) {
    a_rest[k] = a[i + k];
    b_rest[k] = b[i + k];
  }
  store_masked(out + i, evaluate_vector(a_rest, b_rest), first_lanes(static_cast<int>(count - i)));
}

}  // namespace

void evaluate(MathFunction f, const float* a, const float* b, float* out, std::size_t count) {
  const bool binary = f == MathFunction::pow || f == MathFunction::atan2;
  const float* second = binary ? b : a;  // the others never read b, which may be null
  switch (f) {
#define TESSERA_UNARY(name) \
  case MathFunction::name:  \
    return apply([](Float x, Float) { return name(x); }, a, second, out, count)
#define TESSERA_BINARY(name) \
  case MathFunction::name:   \
    return apply([](Float x, Float y) { return name(x, y); }, a, second, out, count)
    TESSERA_UNARY(exp2);
    TESSERA_UNARY(log2);
    TESSERA_UNARY(exp);
    TESSERA_UNARY(log);
    TESSERA_BINARY(pow);
    TESSERA_UNARY(sin);
    TESSERA_UNARY(cos);
    TESSERA_UNARY(tan);
    TESSERA_UNARY(asin);
    TESSERA_UNARY(acos);
    TESSERA_BINARY(atan2);
    TESSERA_UNARY(cbrt);
    TESSERA_UNARY(srgb_to_linear);
    TESSERA_UNARY(linear_to_srgb);
#undef TESSERA_UNARY
#undef TESSERA_BINARY
    case MathFunction::half_to_float:
      return apply(
          [](Float x, Float) {
            const Float half = clamp(x, Float(0), Float(65535));
            return half_to_float(truncate_to_int(half));
          },
          a, second, out, count);
    case MathFunction::float_to_half:
      return apply([](Float x, Float) { return to_float(float_to_half(x)); }, a, second, out, count);
  }
}

}  // namespace tessera::TESSERA_ISA
