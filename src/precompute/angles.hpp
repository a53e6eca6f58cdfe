// Sines, cosines and the like for what is baked: by the kernels' own functions, the same on every machine.
#pragma once
#include <vector>

#include "kernels/interface.hpp"

namespace tessera {

/// f of each number, as floats have it.
inline std::vector<double> evaluate(MathFunction f, const std::vector<float>& x, const Kernels& kernels) {
  std::vector<float> out(x.size());
  kernels.evaluate(f, x.data(), x.data(), out.data(), x.size());
  return {out.begin(), out.end()};
}

/// A rotation about +Y by an angle in radians, counter-clockwise seen from above: takes +X to cosine X - sine Z.
struct Turn {
  float cosine = 1, sine = 0;
};

inline Turn turn_by(float angle, const Kernels& kernels) {
  return {float(evaluate(MathFunction::cos, {angle}, kernels)[0]),
          float(evaluate(MathFunction::sin, {angle}, kernels)[0])};
}

}  // namespace tessera
