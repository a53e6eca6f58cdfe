// Primitives into the scene's flat arrays, in world space.
#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "io/gltf_build.hpp"
#include "io/gltf_placement.hpp"
#include "io/gltf_primitive.hpp"

namespace tessera {
namespace {

using glm::dvec3;
constexpr std::uint32_t unused_vertex = std::numeric_limits<std::uint32_t>::max();

dvec3 vector_at(const FloatArray& values, std::size_t i) {
  const float* v = &values.values[i * std::size_t(values.components)];
  return {double(v[0]), double(v[1]), double(v[2])};
}

// Unit vector into floats; false, and zeros, for one without a direction.
bool store_unit(const dvec3& v, float* out) {
  const double length = std::sqrt(glm::dot(v, v));
  const bool good = length > 0 && std::isfinite(length);
  for (int c = 0; c < 3; ++c) out[c] = good ? float(v[c] / length) : 0.0f;
  return good;
}

// Appends one primitive, placed.
class PrimitiveWriter {
 public:
  /// moved: scratch, all of it unused_vertex before and after, whatever its length.
  PrimitiveWriter(const GltfDocument& document, const GltfPrimitive& in, std::vector<std::uint32_t>& moved,
                  Scene& scene)
      : document_(document), in_(in), moved_(moved), scene_(scene) {}

  void place_by(const glm::dmat4& matrix) { fixed_ = Placement::of(matrix); }
  void place_by(const std::vector<glm::dmat4>* joints) { joints_ = joints; }

  void write(std::uint32_t binding) {
    const std::size_t first_triangle = scene_.triangles.size();
    const bool flat = in_.normals == nullptr;
    if (moved_.size() < in_.vertex_count) moved_.resize(in_.vertex_count, unused_vertex);
    for (std::size_t i = 0; i < in_.triangles.size(); i += 3) {
      Triangle triangle{{0, 0, 0}, binding};
      bool mirrored = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t source = in_.triangles[i + k];
        if (flat || moved_[source] == unused_vertex) {
          const std::uint32_t written = write_vertex(source);
          if (!flat) moved_[source] = written;
          triangle.vertex[k] = written;
        } else {
          triangle.vertex[k] = moved_[source];
        }
        if (k == 0) mirrored = joints_ != nullptr ? placement(source).mirrored : fixed_.mirrored;
      }
      if (mirrored) std::swap(triangle.vertex[1], triangle.vertex[2]);
      if (flat) write_flat_normal(triangle);
      scene_.triangles.push_back(triangle);
    }
    for (const std::uint32_t source : in_.triangles) moved_[source] = unused_vertex;
    if (!without_normal_.empty()) mend_normals(first_triangle);
  }

 private:
  [[nodiscard]] Placement placement(std::size_t source) const {
    return joints_ != nullptr ? skinned_placement(document_, in_, source, *joints_) : fixed_;
  }

  std::uint32_t write_vertex(std::size_t source) {
    const auto written = std::uint32_t(scene_.positions.size() / 3);
    const Placement skinned = joints_ != nullptr ? placement(source) : Placement{};
    const Placement& place = joints_ != nullptr ? skinned : fixed_;
    const dvec3 position(place.matrix * glm::dvec4(vector_at(*in_.positions, source), 1.0));
    for (int c = 0; c < 3; ++c) {
      const auto value = float(position[c]);
      if (!std::isfinite(value)) {
        throw document_.wrong(in_.part, "vertex {} lies beyond the range of floats in the world", source);
      }
      scene_.positions.push_back(value);
    }
    VertexAttributes attributes{};
    if (in_.normals && !store_unit(place.normal_matrix * vector_at(*in_.normals, source), attributes.normal)) {
      without_normal_.emplace(written, dvec3(0));
    }
    if (in_.tangents && store_unit(glm::dmat3(place.matrix) * vector_at(*in_.tangents, source), attributes.tangent)) {
      const bool left = in_.tangents->values[source * 4 + 3] < 0;
      attributes.tangent[3] = left != place.mirrored ? -1.0f : 1.0f;
    }
    for (int set = 0; set < 2; ++set) {
      if (!in_.uv[set]) continue;
      attributes.uv[set][0] = in_.uv[set]->values[source * 2];
      attributes.uv[set][1] = in_.uv[set]->values[source * 2 + 1];
    }
    for (float& c : attributes.color) c = 1;
    if (in_.colors) {
      const auto components = std::size_t(in_.colors->components);
      for (std::size_t c = 0; c < components; ++c) {
        attributes.color[c] = std::max(in_.colors->values[source * components + c], 0.0f);
      }
    }
    scene_.attributes.push_back(attributes);
    return written;
  }

  // Twice the area, times the unit normal.
  [[nodiscard]] dvec3 face_normal(const Triangle& triangle) const {
    dvec3 p[3];
    for (int k = 0; k < 3; ++k) {
      const float* v = &scene_.positions[std::size_t{triangle.vertex[k]} * 3];
      p[k] = {double(v[0]), double(v[1]), double(v[2])};
    }
    return glm::cross(p[1] - p[0], p[2] - p[0]);
  }

  // Triangles without an area draw nothing: any unit vector will do.
  static void store_normal(const dvec3& normal, float* out) {
    if (!store_unit(normal, out)) out[1] = 1;
  }

  void write_flat_normal(const Triangle& triangle) {
    const dvec3 normal = face_normal(triangle);
    for (const std::uint32_t v : triangle.vertex) store_normal(normal, scene_.attributes[v].normal);
  }

  // Normals of zero length, in the file or after a flattening scale: the area-weighted mean of the faces.
  void mend_normals(std::size_t first_triangle) {
    for (std::size_t t = first_triangle; t < scene_.triangles.size(); ++t) {
      const Triangle& triangle = scene_.triangles[t];
      for (const std::uint32_t v : triangle.vertex) {
        const auto found = without_normal_.find(v);
        if (found != without_normal_.end()) found->second += face_normal(triangle);
      }
    }
    for (const auto& [vertex, sum] : without_normal_) store_normal(sum, scene_.attributes[vertex].normal);
  }

  const GltfDocument& document_;
  const GltfPrimitive& in_;
  std::vector<std::uint32_t>& moved_;  // written vertex by source vertex
  Scene& scene_;
  Placement fixed_;
  const std::vector<glm::dmat4>* joints_ = nullptr;
  std::map<std::uint32_t, dvec3> without_normal_;
};

// A small file can ask for any number of copies of its meshes.
void check_room(const GltfDocument& document, const GltfPrimitive& primitive, std::size_t copies, const Scene& scene) {
  const std::size_t triangles = primitive.triangles.size() / 3;
  const double vertices = primitive.normals ? double(std::min(primitive.vertex_count, triangles * 3)) : triangles * 3.0;
  const double all_vertices = double(scene.attributes.size()) + vertices * double(copies);
  const double all_triangles = double(scene.triangles.size()) + double(triangles) * double(copies);
  const double bytes = all_vertices * (12 + sizeof(VertexAttributes)) + all_triangles * sizeof(Triangle);
  const double memory = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE));
  if (all_vertices > max_scene_vertices || all_triangles > max_scene_triangles) {
    throw document.wrong(primitive.part,
                         "the scene has {:.0f} vertices and {:.0f} triangles or more, expected at most {} and {}",
                         all_vertices, all_triangles, max_scene_vertices, max_scene_triangles);
  }
  if (bytes > memory) {
    throw document.wrong(primitive.part, "the scene has {:.0f} triangles or more, too many for this machine's memory",
                         all_triangles);
  }
}

}  // namespace

void build_meshes(GltfDocument& document, const std::vector<int>& order, const std::vector<glm::dmat4>& world,
                  MaterialBuilder& materials, Scene& scene) {
  PrimitiveReader reader(document);
  std::map<int, std::vector<glm::dmat4>> skins;
  std::vector<std::uint32_t> moved;
  for (const int node : order) {
    const tinygltf::Node& holder = document.model.nodes[std::size_t(node)];
    if (holder.mesh < 0) continue;
    const tinygltf::Mesh& mesh = document.model.meshes[std::size_t(holder.mesh)];
    const std::vector<double>& weights = holder.weights.empty() ? mesh.weights : holder.weights;
    const std::vector<glm::dmat4> instances = instance_matrices(document, node);
    for (int p = 0; p < int(mesh.primitives.size()); ++p) {
      const GltfPrimitive* base = reader.read(holder.mesh, p);
      if (base == nullptr || base->triangles.empty()) continue;
      const bool skinned = holder.skin >= 0 && !base->influences.empty();
      check_room(document, *base, skinned ? 1 : instances.size(), scene);
      GltfPrimitive morphed;
      const bool morphs = !weights.empty() && !mesh.primitives[std::size_t(p)].targets.empty();
      if (morphs) morphed = reader.morphed(*base, holder.mesh, p, weights);
      const GltfPrimitive& primitive = morphs ? morphed : *base;
      const int binding =
          materials.binding(primitive.material, primitive.tangents != nullptr, primitive.colors != nullptr);

      Part part;
      part.node = holder.name.empty() ? node_name(node) : holder.name;
      part.mesh = mesh.name.empty() ? fmt::format("meshes[{}]", holder.mesh) : mesh.name;
      part.binding = binding;
      part.first_triangle = std::uint32_t(scene.triangles.size());
      if (skinned) {
        const auto [joints, fresh] = skins.try_emplace(holder.skin);
        if (fresh) joints->second = joint_matrices(document, holder.skin, world);
        PrimitiveWriter writer(document, primitive, moved, scene);
        writer.place_by(&joints->second);
        writer.write(std::uint32_t(binding));
      } else {
        for (const glm::dmat4& instance : instances) {
          PrimitiveWriter writer(document, primitive, moved, scene);
          writer.place_by(world[std::size_t(node)] * instance);
          writer.write(std::uint32_t(binding));
        }
      }
      part.triangle_count = std::uint32_t(scene.triangles.size()) - part.first_triangle;
      scene.parts.push_back(std::move(part));
    }
  }
  reader.finish();
}

}  // namespace tessera
