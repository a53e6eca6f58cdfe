#include <exception>

#include "base/parallel.hpp"
#include "io/gltf_build.hpp"
#include "io/image_file.hpp"

namespace tessera {
namespace {

SourceImage decode(const GltfImage& image, std::span<const std::byte> embedded, const std::string& part,
                   const GltfDocument& document) {
  const std::string name = image.name.empty() ? part : image.name;
  SourceImage result;
  if (image.buffer_view >= 0) {
    result = decode_image(embedded, document.file + ": " + part);
  } else if (is_data_uri(image.uri)) {
    result = decode_image(read_uri(image.uri, document.file, part), document.file + ": " + part);
  } else {
    const std::vector<std::byte> bytes = read_uri(image.uri, document.file, part);
    result = decode_image(bytes, document.file + ": " + part + ": " + uri_path(image.uri, document.file, part));
  }
  result.name = name;
  return result;
}

}  // namespace

void MaterialBuilder::decode_images() {
  std::vector<bool> used(document_.images.size());
  for (const Texture& texture : scene_.textures) used[std::size_t(texture.image)] = true;
  scene_.images.resize(document_.images.size());

  // Buffers load on one thread; decoding takes the time.
  std::vector<std::size_t> wanted;
  std::vector<std::span<const std::byte>> embedded(document_.images.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    const GltfImage& image = document_.images[i];
    scene_.images[i].name = image.name;
    if (!used[i]) continue;
    if (image.buffer_view >= 0) {
      embedded[i] = buffer_view_bytes(document_, image.buffer_view);
    } else if (image.uri.empty()) {
      throw document_.wrong(fmt::format("images[{}]", i), "has neither a URI nor a buffer view");
    }
    wanted.push_back(i);
  }
  // Of several broken images the first one is reported, whichever thread finds out first.
  std::vector<std::exception_ptr> failures(wanted.size());
  parallel_for(wanted.size(), [&](std::size_t k) {
    const std::size_t i = wanted[k];
    try {
      scene_.images[i] = decode(document_.images[i], embedded[i], fmt::format("images[{}]", i), document_);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace tessera
