#include "precompute/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace tessera {
namespace {

constexpr float largest_half = 65504;

std::size_t bytes_per_channel(PixelType type) { return type == PixelType::u8 ? 1 : type == PixelType::f32 ? 4 : 2; }

std::size_t texels_of(int width, int height, int levels) {
  std::size_t count = 0;
  for (int k = 0; k < levels; ++k) count += std::size_t(std::max(1, width >> k)) * std::max(1, height >> k);
  return count;
}

int full_levels(int width, int height) {
  int levels = 1;
  for (int size = std::max(width, height); size > 1; size >>= 1) ++levels;
  return levels;
}

void check(const SourceImage& image) {
  if (image.width < 1 || image.height < 1)
    throw input_error("image '{}': {} x {} pixels; expected at least 1 x 1", image.name, image.width, image.height);
  if (image.width > max_texture_size || image.height > max_texture_size)
    throw input_error("image '{}': {} x {} pixels; at most {} along a side are supported", image.name, image.width,
                      image.height, max_texture_size);
  if (texels_of(image.width, image.height, full_levels(image.width, image.height)) > max_texture_texels)
    throw input_error("image '{}': {} x {} pixels; at most {} texels with all mip levels are supported", image.name,
                      image.width, image.height, max_texture_texels);
  if (image.channels < 1 || image.channels > 4)
    throw input_error("image '{}': {} channels; expected 1 to 4", image.name, image.channels);
  const std::size_t expected = std::size_t(image.width) * image.height * image.channels * bytes_per_channel(image.type);
  if (image.pixels.size() != expected)
    throw input_error("image '{}': {} bytes of pixels; expected {}", image.name, image.pixels.size(), expected);
}

// Rows of any source, as linear RGBA. 16-bit samples may be unaligned.
class RowReader {
 public:
  struct Scratch {
    AlignedVector<float> wide;
    std::vector<std::uint16_t> narrow;
  };

  RowReader(const SourceImage& image, Encoding encoding, const Kernels& kernels)
      : image_(image), kernels_(kernels), count_(std::size_t(image.width) * image.channels) {
    srgb_ = encoding == Encoding::srgb && (image.type == PixelType::u8 || image.type == PixelType::u16);
    for (int i = 0; i < 256; ++i) linear_[i] = decoded_[i] = float(i) / 255.0f;
    if (srgb_) kernels.evaluate(MathFunction::srgb_to_linear, linear_.data(), nullptr, decoded_.data(), 256);
  }

  // Clamped to what a half holds.
  void read(int y, Scratch& scratch, float* rgba) const {
    AlignedVector<float>& wide = scratch.wide;
    wide.resize(count_);
    const std::byte* row = image_.pixels.data() + std::size_t(y) * count_ * bytes_per_channel(image_.type);
    switch (image_.type) {
      case PixelType::u8:
        for (std::size_t i = 0; i < count_; ++i) wide[i] = decoded_[std::to_integer<unsigned>(row[i])];
        if (srgb_) restore_alpha(wide, [&](std::size_t i) { return linear_[std::to_integer<unsigned>(row[i])]; });
        break;
      case PixelType::u16:
        load16(row, scratch.narrow);
        for (std::size_t i = 0; i < count_; ++i) wide[i] = float(scratch.narrow[i]) / 65535.0f;
        if (srgb_) {
          kernels_.evaluate(MathFunction::srgb_to_linear, wide.data(), nullptr, wide.data(), count_);
          restore_alpha(wide, [&](std::size_t i) { return float(scratch.narrow[i]) / 65535.0f; });
        }
        break;
      case PixelType::half:
        load16(row, scratch.narrow);
        kernels_.unpack_half(scratch.narrow.data(), wide.data(), count_);
        break;
      case PixelType::f32:
        std::memcpy(wide.data(), row, count_ * sizeof(float));
        break;
    }
    for (float& x : wide) x = x > 0 ? std::min(x, largest_half) : 0.0f;  // NaN fails the comparison
    spread(wide, rgba);
  }

 private:
  void load16(const std::byte* row, std::vector<std::uint16_t>& narrow) const {
    narrow.resize(count_);
    std::memcpy(narrow.data(), row, count_ * 2);
  }

  template <class Linear>
  void restore_alpha(AlignedVector<float>& wide, const Linear& linear) const {
    if (image_.channels % 2 != 0) return;
    for (std::size_t i = image_.channels - 1; i < count_; i += image_.channels) wide[i] = linear(i);
  }

  void spread(const AlignedVector<float>& wide, float* rgba) const {
    const int channels = image_.channels;
    for (int x = 0; x < image_.width; ++x) {
      const float* in = wide.data() + std::size_t(x) * channels;
      float* out = rgba + std::size_t(x) * 4;
      out[0] = in[0];
      out[1] = channels >= 3 ? in[1] : in[0];
      out[2] = channels >= 3 ? in[2] : in[0];
      out[3] = channels == 2 ? in[1] : channels == 4 ? in[3] : 1.0f;
    }
  }

  const SourceImage& image_;
  const Kernels& kernels_;
  std::size_t count_;  // numbers in a row
  bool srgb_;
  std::array<float, 256> linear_, decoded_;
};

void pack(std::span<const float> rgba, TexelFormat format, std::byte* out, const Kernels& kernels) {
  if (format == TexelFormat::rgba16_float) {
    kernels.pack_half(rgba.data(), reinterpret_cast<std::uint16_t*>(out), rgba.size());
    return;
  }
  for (std::size_t i = 0; i < rgba.size(); ++i) {
    const float value = std::min(rgba[i], 1.0f);
    const bool square = format == TexelFormat::rgba8_squares && i % 4 != 3;
    out[i] = static_cast<std::byte>(static_cast<int>((square ? std::sqrt(value) : value) * 255.0f + 0.5f));
  }
}

std::size_t bytes_of(TexelFormat format) { return format == TexelFormat::rgba16_float ? 8 : 4; }

// Levels are made a band of rows at a time: an even number, so that the next level's rows are within one band. Floats
// of a whole level 0, four times what is kept of it, are never needed together.
constexpr int band_rows = 32;

int halved(int size) { return std::max(1, size / 2); }

// One level: rows(y, count) gives rows y to y + count as floats; they are packed to `out` and halved to `smaller`. If
// two rows do not always make one (odd heights), the level has a single band.
template <class Rows>
void make_level(int width, int height, TexelFormat format, std::byte* out, ScratchVector<float>* smaller,
                const Kernels& kernels, const Rows& rows) {
  const bool pairs = height % 2 == 0;
  if (smaller != nullptr) smaller->resize(std::size_t{4} * std::size_t(halved(width)) * std::size_t(halved(height)));
  const int band = pairs || smaller == nullptr ? band_rows : height;
  const std::size_t row_texels = std::size_t(width);
  parallel_for(std::size_t((height + band - 1) / band), [&](std::size_t k) {
    const int y = int(k) * band, count = std::min(band, height - y);
    rows(y, count, [&](const float* rgba) {
      pack({rgba, 4 * row_texels * std::size_t(count)}, format, out + std::size_t(y) * row_texels * bytes_of(format),
           kernels);
      if (smaller == nullptr) return;
      float* const next = smaller->data() + std::size_t{4} * std::size_t(halved(width)) * std::size_t(y / 2);
      kernels.downsample({rgba, width, count, next});
    });
  });
}

TexelFormat format_of(const SourceImage& image, Encoding encoding, ColorTexels colors) {
  const bool integers = image.type == PixelType::u8 || image.type == PixelType::u16;
  if (integers && encoding == Encoding::srgb && colors == ColorTexels::bytes) return TexelFormat::rgba8_squares;
  return image.type == PixelType::u8 && encoding == Encoding::linear ? TexelFormat::rgba8_unorm
                                                                     : TexelFormat::rgba16_float;
}

}  // namespace

TextureData build_texture(const SourceImage& image, Encoding encoding, bool mipmapped, const Kernels& kernels,
                          ColorTexels colors) {
  check(image);
  TextureData data;
  data.format = format_of(image, encoding, colors);
  data.width = image.width;
  data.height = image.height;
  data.levels = mipmapped ? full_levels(image.width, image.height) : 1;
  data.texels.resize(texels_of(data.width, data.height, data.levels) * bytes_of(data.format));

  const RowReader reader(image, encoding, kernels);
  std::byte* out = data.texels.data();
  int width = image.width, height = image.height;
  ScratchVector<float> level, smaller;
  for (int k = 0; k < data.levels; ++k) {
    ScratchVector<float>* const next = k + 1 < data.levels ? &smaller : nullptr;
    const std::size_t row_floats = std::size_t{4} * std::size_t(width);
    if (k == 0)
      make_level(width, height, data.format, out, next, kernels, [&](int y, int count, const auto& take) {
        RowReader::Scratch scratch;
        ScratchVector<float> rows(row_floats * std::size_t(count));
        for (int i = 0; i < count; ++i) reader.read(y + i, scratch, rows.data() + row_floats * std::size_t(i));
        take(rows.data());
      });
    else
      make_level(width, height, data.format, out, next, kernels,
                 [&](int y, int, const auto& take) { take(level.data() + row_floats * std::size_t(y)); });
    out += std::size_t(width) * std::size_t(height) * bytes_of(data.format);
    level.swap(smaller);
    width = halved(width);
    height = halved(height);
  }
  return data;
}

void TextureSet::build(const Scene& scene, std::span<const Use> uses, const Kernels& kernels) {
  struct Job {
    int image;
    Encoding encoding;
    bool mipmapped;
    TextureData* out;
  };
  std::map<std::pair<int, Encoding>, bool> wanted;  // image -> with mips
  for (const Use& use : uses) {
    if (use.texture < 0 || std::size_t(use.texture) >= scene.textures.size()) continue;
    const Texture& texture = scene.textures[use.texture];
    if (texture.image < 0 || std::size_t(texture.image) >= scene.images.size()) continue;
    wanted[{texture.image, use.encoding}] |= texture.sampler.mipmapped;
  }
  std::vector<Job> jobs;
  for (const auto& [key, mipmapped] : wanted) {
    TextureData& data = images_[key];
    if (data.levels == 0 || (mipmapped && data.levels < full_levels(data.width, data.height)))
      jobs.push_back({key.first, key.second, mipmapped, &data});
  }
  parallel_for(jobs.size(), [&](std::size_t i) {
    const Job& job = jobs[i];
    *job.out = build_texture(scene.images[job.image], job.encoding, job.mipmapped, kernels, colors_);
  });
  for (const Use& use : uses) {
    if (use.texture < 0 || std::size_t(use.texture) >= scene.textures.size()) continue;
    const Texture& texture = scene.textures[use.texture];
    const auto data = images_.find({texture.image, use.encoding});
    if (data == images_.end()) continue;
    const Sampler& s = texture.sampler;
    const TextureData& d = data->second;
    textures_[{use.texture, use.encoding}] = {d.texels.data(), d.format,  d.width,  d.height, d.levels,   s.wrap_u,
                                              s.wrap_v,        s.magnify, s.minify, s.mip,    s.mipmapped};
  }
}

const TextureView* TextureSet::find(Use use) const {
  const auto found = textures_.find({use.texture, use.encoding});
  return found == textures_.end() ? nullptr : &found->second;
}

std::size_t TextureSet::bytes() const {
  std::size_t total = 0;
  for (const auto& [key, data] : images_) total += data.texels.size();
  return total;
}

}  // namespace tessera
