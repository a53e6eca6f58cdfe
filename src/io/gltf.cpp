#include "io/gltf.hpp"

#include <exception>
#include <new>

#include "base/error.hpp"
#include "io/gltf_build.hpp"

namespace tessera {

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
    if (report != nullptr) *report = std::move(document->report);
    return scene;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw input_error("{}: too large for this machine's memory", path);
  } catch (const std::exception& e) {
    throw input_error("{}: {}", path, e.what());
  }
}

}  // namespace tessera
