// What an image file claims about itself, read from its first bytes and checked before a decoder sees the file:
// decoders may abort or ask for absurd amounts of memory on hostile headers.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tessera {

inline constexpr int max_image_side = 32768;

/// OpenImageIO's name of the format ("png", "jpeg", "hdr", "openexr", "webp", "tiff"), from the content alone. Throws
/// Error(input) when it is none of these.
const char* image_format(std::span<const std::byte> bytes, const std::string& name);

/// Throws Error(input) unless dimensions, where the format states them at its head, are sane and the file is long
/// enough to hold such an image at the best ratio its compression can reach.
void check_image_header(std::span<const std::byte> bytes, const std::string& format, const std::string& name);

/// Throws Error(input) unless a decoded image of this shape is acceptable.
void check_image_size(std::int64_t width, std::int64_t height, std::int64_t bytes_per_pixel, std::uint64_t limit,
                      const std::string& name);

struct ExrHeader {
  enum class Type : std::uint32_t { u32 = 0, half = 1, f32 = 2 };
  struct Channel {
    std::string name;
    Type type;
  };
  std::int64_t width = 0, height = 0;
  bool deep = false, tiled = false;
  std::vector<Channel> channels;
  std::map<std::string, std::string> strings;  // attributes of type string
};

/// The header of an EXR file's first part, checked as above.
ExrHeader read_exr_header(std::span<const std::byte> bytes, const std::string& name);

}  // namespace tessera
