#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cstring>

#include "io/gltf_compression.hpp"

namespace tessera {
namespace {

template <class T>
float scaled(const void* from, bool normalized) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  if (!normalized || !std::numeric_limits<T>::is_integer) return float(value);
  return std::max(float(value) / float(std::numeric_limits<T>::max()), -1.0f);
}

float component(const std::uint8_t* from, draco::DataType type, bool normalized) {
  switch (type) {
    case draco::DT_INT8:
      return scaled<std::int8_t>(from, normalized);
    case draco::DT_UINT8:
      return scaled<std::uint8_t>(from, normalized);
    case draco::DT_INT16:
      return scaled<std::int16_t>(from, normalized);
    case draco::DT_UINT16:
      return scaled<std::uint16_t>(from, normalized);
    case draco::DT_INT32:
      return scaled<std::int32_t>(from, normalized);
    case draco::DT_UINT32:
      return scaled<std::uint32_t>(from, normalized);
    default:
      return scaled<float>(from, normalized);
  }
}

DracoPrimitive::Attribute convert(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                                  GltfDocument& document, const std::string& part) {
  const draco::DataType type = attribute.data_type();
  if (type == draco::DT_INVALID || type == draco::DT_INT64 || type == draco::DT_UINT64 || type == draco::DT_FLOAT64 ||
      type == draco::DT_BOOL) {
    throw document.wrong(part, "has a component type that glTF does not have");
  }
  DracoPrimitive::Attribute out;
  out.components = attribute.num_components();
  const auto components = std::size_t(out.components);
  const auto size = std::size_t(draco::DataTypeLength(type));
  out.values.resize(mesh.num_points() * components);
  for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
    const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(p));
    if (value.value() >= attribute.size()) throw document.wrong(part, "the compressed data are damaged");
    const std::uint8_t* from = attribute.GetAddress(value);
    for (std::size_t c = 0; c < components; ++c) {
      out.values[p * components + c] = component(from + c * size, type, attribute.normalized());
    }
  }
  return out;
}

}  // namespace

DracoPrimitive decode_draco(GltfDocument& document, const tinygltf::Value& extension, const std::string& primitive) {
  const std::string part = primitive + ".extensions.KHR_draco_mesh_compression";
  const auto bytes = buffer_view_bytes(document, extension.Get("bufferView").GetNumberAsInt());
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) throw document.wrong(part, "cannot be decoded: {}", decoded.status().error_msg_string());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

  DracoPrimitive out;
  out.vertex_count = mesh->num_points();
  out.indices.reserve(std::size_t(mesh->num_faces()) * 3);
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
    for (const draco::PointIndex& p : mesh->face(draco::FaceIndex(f))) {
      if (p.value() >= mesh->num_points()) throw document.wrong(part, "the compressed data are damaged");
      out.indices.push_back(p.value());
    }
  }
  const tinygltf::Value& attributes = extension.Get("attributes");
  for (const std::string& name : attributes.Keys()) {
    const auto id = std::uint32_t(attributes.Get(name).GetNumberAsDouble());
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id);
    const std::string place = fmt::format("{}.attributes.{}", part, name);
    if (attribute == nullptr) throw document.wrong(place, "no attribute has the id {}", id);
    out.attributes[name] = convert(*mesh, *attribute, document, place);
  }
  return out;
}

}  // namespace tessera
