// A frame, its G-buffer on disk, and the picture shaded from that: for tests that want the same bits.
#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "frame/frame.hpp"
#include "frame/gbuffer_file.hpp"

namespace tessera {

/// Writes the frame's G-buffer to `path` as `tessera render` does, reads it, shades it, and expects the frame's own
/// bits.
inline void expect_same_bits_from_gbuffer(const Frame& rendered, const View& view, const std::vector<Light>& lights,
                                          const Environment* environment, const RenderSettings& settings,
                                          const Kernels& kernels, const std::string& path) {
  const auto attributes = gbuffer_attributes(rendered.gbuffer, view, lights);
  if (rendered.gbuffer.is_flat()) {
    FlatPlanes storage;
    write_exr(path, settings.width, settings.height, flat_gbuffer_channels(rendered.gbuffer, storage), attributes);
  } else {
    write_deep_gbuffer(path, rendered.gbuffer, attributes);
  }
  const GBufferFile file = read_gbuffer(path);
  ASSERT_TRUE(file.view.has_value());
  EXPECT_EQ(file.image.fragment_count(), rendered.gbuffer.fragment_count());
  Frame shaded;
  shade_gbuffer(file.image, *file.view, file.lights, environment, settings, kernels, shaded);
  ASSERT_EQ(shaded.rgba.pixels.size(), rendered.rgba.pixels.size());
  EXPECT_EQ(
      std::memcmp(shaded.rgba.pixels.data(), rendered.rgba.pixels.data(), shaded.rgba.pixels.size() * sizeof(float)),
      0);
}

}  // namespace tessera
