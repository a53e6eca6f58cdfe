#include "io/gltf_primitive.hpp"

#include <algorithm>
#include <cmath>

#include "io/gltf_compression.hpp"

namespace tessera {
namespace {

const char* mode_name(int mode) {
  static constexpr const char* names[] = {"POINTS", "LINES", "LINE_LOOP", "LINE_STRIP"};
  return mode >= 0 && mode < 4 ? names[mode] : "unknown";
}

bool draws_triangles(int mode) { return mode < 0 || mode >= TINYGLTF_MODE_TRIANGLES; }

// glTF 2.0, section 3.7.2.1: the triangles of lists, strips and fans.
std::vector<std::uint32_t> triangles_of(std::vector<std::uint32_t> indices, int mode, GltfDocument& document,
                                        const std::string& part) {
  if (mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) {
    if (indices.size() % 3 != 0) {
      document.warn(fmt::format("{}: {} indices make no whole number of triangles", part, indices.size()));
      indices.resize(indices.size() / 3 * 3);
    }
    return indices;
  }
  std::vector<std::uint32_t> out;
  if (indices.size() < 3) return out;
  out.reserve((indices.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      out.insert(out.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
    } else {
      out.insert(out.end(), {indices[i + 1], indices[i + 2], indices[0]});
    }
  }
  return out;
}

// How many components each attribute may have.
bool allowed_components(std::string_view name, int components) {
  if (name.starts_with("TEXCOORD_")) return components == 2;
  if (name.starts_with("COLOR_")) return components == 3 || components == 4;
  if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") || name == "TANGENT") return components == 4;
  return components == 3;
}

SharedFloats own(DracoPrimitive::Attribute&& attribute, bool normalized) {
  auto result = std::make_shared<FloatArray>();
  result->components = attribute.components;
  result->normalized = normalized;
  result->values = std::move(attribute.values);
  return result;
}

SharedFloats added(const GltfDocument& document, const SharedFloats& base, const FloatArray& delta, double weight,
                   const std::string& part) {
  if (delta.count() != base->count() || delta.components > base->components) {
    throw document.wrong(part, "has {} x {} values for {} x {}", delta.count(), delta.components, base->count(),
                         base->components);
  }
  auto result = std::make_shared<FloatArray>(*base);
  const auto stride = std::size_t(base->components);
  const auto components = std::size_t(delta.components);
  for (std::size_t i = 0; i < delta.count(); ++i)
    for (std::size_t c = 0; c < components; ++c) {
      float& value = result->values[i * stride + c];
      const double offset = weight * double(delta.values[i * components + c]);
      value = float(double(value) + offset);
      if (!std::isfinite(value)) throw document.wrong(part, "vertex {} is not finite", i);
    }
  return result;
}

}  // namespace

SharedFloats PrimitiveReader::floats(int accessor) {
  SharedFloats& known = accessors_[accessor];
  if (!known) known = std::make_shared<const FloatArray>(read_floats(document_, accessor));
  return known;
}

SharedFloats PrimitiveReader::checked(SharedFloats values, const std::string& name, const std::string& part) {
  if (!allowed_components(name, values->components)) {
    throw document_.wrong(part, "has {} components, not what {} has", values->components, name);
  }
  const auto broken =
      std::find_if(values->values.begin(), values->values.end(), [](float v) { return !std::isfinite(v); });
  if (broken == values->values.end()) return values;
  // Frames can be found without these, and texture coordinates place no geometry; exporters do write NaN there.
  const auto vertex = std::size_t(broken - values->values.begin()) / std::size_t(values->components);
  if (name != "NORMAL" && name != "TANGENT" && !name.starts_with("TEXCOORD_")) {
    throw document_.wrong(part, "{} of vertex {} is {}, expected finite numbers", name, vertex, *broken);
  }
  document_.warn(fmt::format("{}: {} of vertex {} is {}: such values count as zero", part, name, vertex, *broken));
  auto mended = std::make_shared<FloatArray>(*values);
  const auto components = std::size_t(mended->components);
  for (std::size_t i = 0; i < mended->values.size(); i += components) {
    float* element = &mended->values[i];
    if (!std::all_of(element, element + components, [](float v) { return std::isfinite(v); })) {
      std::fill_n(element, components, 0.0f);
    }
  }
  return mended;
}

SharedFloats PrimitiveReader::attribute(const tinygltf::Primitive& in, const std::string& name, std::size_t count,
                                        const std::string& part) {
  const auto found = in.attributes.find(name);
  if (found == in.attributes.end()) return nullptr;
  const std::string accessor = accessor_name(found->second);
  if (document_.model.accessors[std::size_t(found->second)].componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    throw document_.wrong(accessor + ".componentType", "is 5125, which {} cannot have", name);
  }
  SharedFloats& values = attributes_[{name, found->second}];
  if (!values) values = checked(floats(found->second), name, accessor);
  if (count != 0 && values->count() != count) {
    throw document_.wrong(part + ".attributes." + name, "{} has {} elements, POSITION has {}", accessor,
                          values->count(), count);
  }
  return values;
}

std::unique_ptr<GltfPrimitive> PrimitiveReader::make(int mesh, int index) {
  const tinygltf::Primitive& in = document_.model.meshes[std::size_t(mesh)].primitives[std::size_t(index)];
  auto out = std::make_unique<GltfPrimitive>();
  out->part = fmt::format("meshes[{}].primitives[{}]", mesh, index);
  out->material = in.material;

  DracoPrimitive draco;
  const auto* compressed = extension_of(in.extensions, "KHR_draco_mesh_compression");
  if (compressed != nullptr) draco = decode_draco(document_, *compressed, out->part);
  const auto get = [&](const std::string& name, std::size_t count) -> SharedFloats {
    const auto found = draco.attributes.find(name);
    if (found == draco.attributes.end()) return attribute(in, name, count, out->part);
    return checked(own(std::move(found->second), true), name, out->part + ".attributes." + name);
  };

  out->positions = get("POSITION", 0);
  if (!out->positions) {
    document_.warn(out->part + " has no POSITION: left out");
    return nullptr;
  }
  const std::size_t count = out->vertex_count = out->positions->count();
  out->normals = get("NORMAL", count);
  // Tangents without normals must be ignored (glTF 2.0, section 3.7.2.1).
  if (out->normals) out->tangents = get("TANGENT", count);
  out->uv[0] = get("TEXCOORD_0", count);
  out->uv[1] = get("TEXCOORD_1", count);
  out->colors = get("COLOR_0", count);
  if (out->colors && out->colors->integers && !out->colors->normalized) {
    throw document_.wrong(out->part + ".attributes.COLOR_0", "has integers that are not normalized");
  }
  for (int set = 0;; ++set) {
    const SharedFloats joints = get(fmt::format("JOINTS_{}", set), count);
    const SharedFloats weights = get(fmt::format("WEIGHTS_{}", set), count);
    if (!joints || !weights) break;
    out->influences.emplace_back(joints, weights);
  }

  std::vector<std::uint32_t> indices;
  if (compressed != nullptr) {
    indices = std::move(draco.indices);
  } else if (in.indices >= 0) {
    IntegerArray read = read_integers(document_, in.indices);
    if (read.components != 1) throw document_.wrong(accessor_name(in.indices) + ".type", "expected SCALAR for indices");
    indices = std::move(read.values);
  } else {
    indices.resize(count);
    for (std::size_t i = 0; i < count; ++i) indices[i] = std::uint32_t(i);
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= count) {
      throw document_.wrong(out->part + ".indices", "index {} (number {}) is out of range: there are {} vertices",
                            indices[i], i, count);
    }
  }
  out->triangles =
      compressed != nullptr ? std::move(indices) : triangles_of(std::move(indices), in.mode, document_, out->part);
  return out;
}

const GltfPrimitive* PrimitiveReader::read(int mesh, int index) {
  const auto [place, fresh] = known_.try_emplace({mesh, index});
  if (fresh) {
    const tinygltf::Primitive& in = document_.model.meshes[std::size_t(mesh)].primitives[std::size_t(index)];
    ++document_.report.primitives;
    if (draws_triangles(in.mode)) {
      place->second = make(mesh, index);
    } else {
      ++document_.report.skipped_primitives;
      ++skipped_[in.mode];
    }
  }
  return place->second.get();
}

GltfPrimitive PrimitiveReader::morphed(const GltfPrimitive& base, int mesh, int index,
                                       const std::vector<double>& weights) {
  const tinygltf::Primitive& in = document_.model.meshes[std::size_t(mesh)].primitives[std::size_t(index)];
  GltfPrimitive out = base;
  for (std::size_t t = 0; t < in.targets.size() && t < weights.size(); ++t) {
    if (weights[t] == 0) continue;
    for (const auto& [name, accessor] : in.targets[t]) {
      SharedFloats* target = name == "POSITION"     ? &out.positions
                             : name == "NORMAL"     ? &out.normals
                             : name == "TANGENT"    ? &out.tangents
                             : name == "TEXCOORD_0" ? &out.uv[0]
                             : name == "TEXCOORD_1" ? &out.uv[1]
                             : name == "COLOR_0"    ? &out.colors
                                                    : nullptr;
      if (target == nullptr || !*target) continue;
      *target = added(document_, *target, *floats(accessor), weights[t],
                      fmt::format("{}.targets[{}].{}", base.part, t, name));
    }
  }
  return out;
}

void PrimitiveReader::finish() {
  std::string list;
  int total = 0;
  for (const auto& [mode, count] : skipped_) {
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, mode_name(mode));
    total += count;
  }
  if (total > 0) {
    document_.warn(fmt::format("{} primitive{} left out, which {} no triangles: {}", total, total == 1 ? "" : "s",
                               total == 1 ? "makes" : "make", list));
  }
}

}  // namespace tessera
