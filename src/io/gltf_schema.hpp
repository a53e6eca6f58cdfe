// The part of glTF's schema that Tessera reads, as a table: which keys an object may have, of what kind, and what they
// refer to. gltf_check.cpp walks it.
#pragma once
#include <span>
#include <string_view>

namespace tessera {

enum class GltfKind {
  boolean,
  string,
  integer,
  number,
  numbers,      // an array; length 0: any
  index,        // into a collection
  index_list,   // array of distinct indices
  index_map,    // object whose values are indices
  index_maps,   // array of such objects
  integer_map,  // object whose values are integers
  object,       // of a type
  object_list,  // array of objects of a type
  extension,    // extensions.KEY, an object of a type
};

struct GltfRule {
  std::string_view type, key;
  GltfKind kind;
  std::string_view target = {};  // collection, or type of object
  bool required = false;
  double low = -1e300, high = 1e300;  // integer, number
  std::size_t length = 0;             // numbers
};

std::span<const GltfRule> gltf_rules();

struct GltfCollection {
  std::string_view name, type;
  std::string_view placeholder;  // JSON that stands for an element nobody reaches
};
std::span<const GltfCollection> gltf_collections();

}  // namespace tessera
