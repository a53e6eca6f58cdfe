// What shading tests shade: G-buffers, lights and environments made from formulas, with the same environment as plain
// double functions for the reference.
#pragma once
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"
#include "reference/shade.hpp"

namespace tessera::test {

/// Planes of a G-buffer, and the radiance that a kernel makes of them.
class GBuffer {
 public:
  explicit GBuffer(std::size_t count);
  [[nodiscard]] GBufferView view() { return view_; }
  [[nodiscard]] std::uint32_t count() const { return std::uint32_t(count_); }
  [[nodiscard]] float* const* radiance() const { return radiance_; }
  [[nodiscard]] reference::ShadeSurface surface(std::size_t i) const;
  void set(std::size_t i, const reference::ShadeSurface& surface);
  /// The planes as one list, for filling with arbitrary bits.
  [[nodiscard]] std::vector<float*> planes();

 private:
  std::size_t count_;
  AlignedVector<float> values_;
  GBufferView view_;
  float* radiance_[3];
};

/// A cube, SH coefficients and a DFG table in the kernels' layout.
class Environment {
 public:
  /// radiance(direction, level) is smooth enough to be continued past a face's edge for the border.
  Environment(int size, int levels, const std::function<reference::Vec3(const reference::Vec3&, int)>& radiance,
              const double (&sh)[9][3]);
  /// The same radiance everywhere.
  static Environment constant(double radiance);
  [[nodiscard]] EnvironmentView view() const;
  [[nodiscard]] DfgView dfg() const;
  /// The same texels, coefficients and table, looked up in double. Refers to this object.
  [[nodiscard]] reference::ShadeEnvironment reference() const;

 private:
  int size_, levels_;
  std::vector<std::uint16_t> texels_;
  float sh_[9][3];
};

/// A point somewhere near the origin with a unit normal that mostly faces `eye`.
reference::ShadeSurface random_surface(std::mt19937& random, const reference::Vec3& eye);

/// One of every type and falloff, with and without range.
std::vector<LightView> all_kinds_of_lights();
reference::ShadeLight to_reference(const LightView& light);

/// ShadeArgs for everything given; features = all.
ShadeArgs shade_args(GBuffer& gbuffer, const reference::Vec3& eye, const std::vector<LightView>& lights,
                     const Environment* environment);

}  // namespace tessera::test
