// An open OpenImageIO reader over bytes in memory, its header already checked.
#pragma once
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "base/error.hpp"
#include "io/image_proxy.hpp"

namespace tessera {

struct ImageReader {
  std::unique_ptr<MemoryReader> bytes;  // outlives input
  std::unique_ptr<OIIO::ImageInput> input;
  std::string format;

  [[nodiscard]] const OIIO::ImageSpec& spec() const { return input->spec(); }
};

/// Throws Error(input). Alpha stays as the file has it.
ImageReader open_image(std::span<const std::byte> bytes, const std::string& name);

/// Error(input) with OpenImageIO's reason, as one line.
Error decode_error(const std::string& name, OIIO::ImageInput& input);

}  // namespace tessera
