#include "io/gltf_accessor.hpp"

#include <cstring>

namespace tessera {
namespace {

// Bytes of an array inside a buffer view, bounds checked.
struct StridedBytes {
  const std::byte* data = nullptr;
  std::size_t stride = 0;
};

int component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    default:
      return 4;
  }
}

// Columns of matrices start at multiples of four bytes (glTF 2.0, section 3.6.2.4).
struct ElementLayout {
  int rows = 1, columns = 1;
  std::size_t component = 4, column_stride = 4, size = 4;
};

ElementLayout layout_of(const tinygltf::Accessor& accessor) {
  ElementLayout layout;
  layout.component = std::size_t(component_size(accessor.componentType));
  switch (accessor.type) {
    case TINYGLTF_TYPE_VEC2:
      layout.rows = 2;
      break;
    case TINYGLTF_TYPE_VEC3:
      layout.rows = 3;
      break;
    case TINYGLTF_TYPE_VEC4:
      layout.rows = 4;
      break;
    case TINYGLTF_TYPE_MAT2:
      layout.rows = layout.columns = 2;
      break;
    case TINYGLTF_TYPE_MAT3:
      layout.rows = layout.columns = 3;
      break;
    case TINYGLTF_TYPE_MAT4:
      layout.rows = layout.columns = 4;
      break;
    default:
      break;
  }
  layout.column_stride = std::size_t(layout.rows) * layout.component;
  if (layout.columns > 1) layout.column_stride = (layout.column_stride + 3) / 4 * 4;
  layout.size = layout.columns == 1 ? layout.column_stride
                                    : layout.column_stride * std::size_t(layout.columns - 1) +
                                          std::size_t(layout.rows) * layout.component;
  return layout;
}

StridedBytes locate(GltfDocument& document, int view_index, std::size_t offset, std::size_t count, std::size_t size,
                    bool strided, const std::string& part) {
  const tinygltf::BufferView& view = document.model.bufferViews[std::size_t(view_index)];
  const std::span<const std::byte> bytes = buffer_view_bytes(document, view_index);
  std::size_t packed = size;
  std::size_t stride = strided && view.byteStride != 0 ? view.byteStride : packed;
  if (const auto* meshopt = extension_of(view.extensions, "EXT_meshopt_compression"); meshopt != nullptr && strided) {
    stride = std::size_t(number_in(*meshopt, "byteStride", double(packed)));
  }
  if (stride < size) throw document.wrong(part, "elements of {} bytes do not fit the stride of {}", size, stride);
  // offset + stride * (count - 1) + size <= length, without overflow.
  const bool fits = offset <= bytes.size() && size <= bytes.size() - offset &&
                    (count == 0 || (count - 1) <= (bytes.size() - offset - size) / stride);
  if (!fits) {
    throw document.wrong(part, "{} elements of {} bytes, stride {}, offset {} do not fit bufferViews[{}] of {} bytes",
                         count, size, stride, offset, view_index, bytes.size());
  }
  return {bytes.data() + offset, stride};
}

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

// glTF 2.0, section 3.6.2.2 (and KHR_mesh_quantization): f = c / 255, max(c / 127, -1), ...
float to_float(const std::byte* from, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const auto c = float(load<std::int8_t>(from));
      return normalized ? std::max(c / 127.0f, -1.0f) : c;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const auto c = float(load<std::uint8_t>(from));
      return normalized ? c / 255.0f : c;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const auto c = float(load<std::int16_t>(from));
      return normalized ? std::max(c / 32767.0f, -1.0f) : c;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const auto c = float(load<std::uint16_t>(from));
      return normalized ? c / 65535.0f : c;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
      const auto c = double(load<std::uint32_t>(from));
      return float(normalized ? c / 4294967295.0 : c);
    }
    default:
      return load<float>(from);
  }
}

std::uint32_t to_unsigned(const std::byte* from, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(from);
    default:
      return load<std::uint32_t>(from);
  }
}

// Reads every element through convert(bytes of a component), first the dense ones, then the sparse substitutes.
template <class T, class Convert>
void read_elements(GltfDocument& document, int index, std::vector<T>& out, const Convert& convert) {
  const tinygltf::Accessor& accessor = document.model.accessors[std::size_t(index)];
  const std::string part = accessor_name(index);
  const ElementLayout layout = layout_of(accessor);
  const std::size_t components = std::size_t(layout.rows) * std::size_t(layout.columns);
  const auto read_element = [&](const std::byte* from, T* to) {
    for (int c = 0; c < layout.columns; ++c)
      for (int r = 0; r < layout.rows; ++r) {
        *to++ = convert(from + std::size_t(c) * layout.column_stride + std::size_t(r) * layout.component);
      }
  };
  if (accessor.bufferView >= 0) {
    const StridedBytes dense =
        locate(document, accessor.bufferView, accessor.byteOffset, accessor.count, layout.size, true, part);
    out.resize(accessor.count * components);
    for (std::size_t i = 0; i < accessor.count; ++i) read_element(dense.data + i * dense.stride, &out[i * components]);
  } else {
    // Zeros, as many as the file claims without having to hold them.
    constexpr std::size_t most = std::size_t{1} << 27;
    if (accessor.count > most / components) {
      throw document.wrong(part, "has {} elements without data, expected at most {}", accessor.count,
                           most / components);
    }
    out.assign(accessor.count * components, T{});
  }
  if (!accessor.sparse.isSparse) return;

  const auto& sparse = accessor.sparse;
  const int index_type = sparse.indices.componentType;
  if (index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      index_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    throw document.wrong(part + ".sparse.indices.componentType", "is {}, expected 5121, 5123 or 5125", index_type);
  }
  const auto count = std::size_t(sparse.count);
  if (count > accessor.count) {
    throw document.wrong(part + ".sparse.count", "is {}, expected at most {}", count, accessor.count);
  }
  const StridedBytes indices = locate(document, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset),
                                      count, std::size_t(component_size(index_type)), false, part + ".sparse.indices");
  const StridedBytes values = locate(document, sparse.values.bufferView, std::size_t(sparse.values.byteOffset), count,
                                     layout.size, false, part + ".sparse.values");
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t target = to_unsigned(indices.data + i * indices.stride, index_type);
    if (target >= accessor.count) {
      throw document.wrong(part + ".sparse.indices", "holds {}, expected below {}", target, accessor.count);
    }
    read_element(values.data + i * values.stride, &out[target * components]);
  }
}

}  // namespace

std::string accessor_name(int accessor) { return fmt::format("accessors[{}]", accessor); }

FloatArray read_floats(GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model.accessors[std::size_t(index)];
  const ElementLayout layout = layout_of(accessor);
  FloatArray result;
  result.components = layout.rows * layout.columns;
  result.integers = accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT;
  result.normalized = accessor.normalized && result.integers;
  read_elements(document, index, result.values,
                [&](const std::byte* from) { return to_float(from, accessor.componentType, accessor.normalized); });
  return result;
}

IntegerArray read_integers(GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model.accessors[std::size_t(index)];
  const int type = accessor.componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    throw document.wrong(accessor_name(index) + ".componentType", "is {}, expected 5121, 5123 or 5125", type);
  }
  const ElementLayout layout = layout_of(accessor);
  IntegerArray result;
  result.components = layout.rows * layout.columns;
  read_elements(document, index, result.values, [&](const std::byte* from) { return to_unsigned(from, type); });
  return result;
}

}  // namespace tessera
