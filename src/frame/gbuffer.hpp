// The G-buffer as a picture: every shaded fragment of a frame, in the order in which a pixel composites them.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/interface.hpp"

namespace tessera {

struct GBufferPlane {
  const char* name;  // channel of an EXR
  float absent;      // what it is where a file lacks the channel
  bool required;     // a file must have it
};

/// The planes in the order of GBufferView's members.
inline constexpr std::array<GBufferPlane, gbuffer_planes> gbuffer_plane_names = {{
    {"position.X", 0, true},
    {"position.Y", 0, true},
    {"position.Z", 0, true},
    {"normal.X", 0, true},
    {"normal.Y", 0, true},
    {"normal.Z", 0, true},
    {"albedo.R", 0, true},
    {"albedo.G", 0, true},
    {"albedo.B", 0, true},
    {"metallic", 0, false},
    {"roughness", 1, false},
    {"occlusion", 1, false},
    {"emissive.R", 0, false},
    {"emissive.G", 0, false},
    {"emissive.B", 0, false},
    {"alpha", 1, false},
    {"unlit", 0, false},
    {"reversed_depth", 0, false},
}};

/// Pointer number k of a view, in the same order.
float*& gbuffer_pointer(GBufferView& view, int k);

struct GBufferImage {
  int width = 0, height = 0, samples = 1;
  std::vector<std::uint32_t> counts;  // fragments of each pixel, raster order
  std::vector<std::uint32_t> triangle;
  std::vector<std::uint32_t> coverage;  // bit s: covers sample s
  std::array<AlignedVector<float>, gbuffer_planes> planes;

  [[nodiscard]] std::size_t fragment_count() const { return triangle.size(); }
  /// Whether a picture with one value per pixel can hold it: at most one fragment a pixel, and that covers it whole.
  [[nodiscard]] bool is_flat() const;
};

}  // namespace tessera
