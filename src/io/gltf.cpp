#include "io/gltf.hpp"

#include <exception>
#include <new>

#include "base/error.hpp"
#include "io/gltf_build.hpp"

namespace tessera {
namespace {

// Names in a message come from the file, and may hold anything.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return text;
}

}  // namespace

Scene load_gltf(const std::string& path, GltfReport* report) {
  try {
    const std::unique_ptr<GltfDocument> document = parse_gltf(path);
    const std::vector<glm::dmat4> world = world_matrices(*document);
    const std::vector<int> order = scene_order(*document);
    Scene scene;
    MaterialBuilder materials(*document, scene);
    build_meshes(*document, order, world, materials, scene);
    build_lights(*document, order, world, scene);
    build_cameras(*document, order, world, scene);
    materials.decode_images();
    for (std::string& warning : document->report.warnings) warning = one_line(warning);
    if (report != nullptr) *report = std::move(document->report);
    return scene;
  } catch (const Error& e) {
    throw Error(e.status(), one_line(e.what()));
  } catch (const std::bad_alloc&) {
    throw input_error("{}: too large for this machine's memory", path);
  } catch (const std::exception& e) {
    throw input_error("{}: {}", path, one_line(e.what()));
  }
}

}  // namespace tessera
