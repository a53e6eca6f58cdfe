// The G-buffer as EXR layers: flat where a pixel holds one fragment at most, deep where it takes more.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "frame/gbuffer.hpp"
#include "frame/view.hpp"
#include "io/image_file.hpp"
#include "scene/light.hpp"

namespace tessera {

/// A G-buffer with what its writer knew about the picture. Files of other programs need only have the required layers.
struct GBufferFile {
  GBufferImage image;
  std::optional<View> view;
  std::vector<Light> lights;
};

/// Text attributes that let `shade` repeat the render: the view, the lights, the number of samples.
std::map<std::string, std::string> gbuffer_attributes(const GBufferImage& image, const View& view,
                                                      const std::vector<Light>& lights);

/// Planes of a flat G-buffer spread over the whole picture, as channels to write. `storage` owns them.
struct FlatPlanes {
  std::vector<AlignedVector<float>> f32;
  std::vector<std::vector<std::uint32_t>> u32;
};
std::vector<ExrChannel> flat_gbuffer_channels(const GBufferImage& image, FlatPlanes& storage);

/// Writes a deep EXR. Throws Error(output).
void write_deep_gbuffer(const std::string& path, const GBufferImage& image,
                        const std::map<std::string, std::string>& attributes);

/// Reads either kind. Throws Error(input) that names a missing layer, or a value outside its range.
GBufferFile read_gbuffer(const std::string& path);

}  // namespace tessera
