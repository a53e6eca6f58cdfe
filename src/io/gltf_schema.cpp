// glTF 2.0 (ISO/IEC 12113), chapter 5, and the extensions' own pages.
#include "io/gltf_schema.hpp"

namespace tessera {
namespace {

using enum GltfKind;
constexpr bool needed = true;
constexpr double whole = 9007199254740992.0;  // largest count that a JSON number holds exactly: 2^53

constexpr GltfRule rules[] = {
    {"scene", "name", string},
    {"scene", "nodes", index_list, "nodes"},

    {"node", "name", string},
    {"node", "mesh", index, "meshes"},
    {"node", "skin", index, "skins"},
    {"node", "camera", index, "cameras"},
    {"node", "children", index_list, "nodes"},
    {"node", "matrix", numbers, {}, false, -1e300, 1e300, 16},
    {"node", "translation", numbers, {}, false, -1e300, 1e300, 3},
    {"node", "rotation", numbers, {}, false, -1e300, 1e300, 4},
    {"node", "scale", numbers, {}, false, -1e300, 1e300, 3},
    {"node", "weights", numbers},
    {"node", "KHR_lights_punctual", extension, "light reference"},
    {"light reference", "light", index, "lights", needed},
    {"node", "EXT_mesh_gpu_instancing", extension, "instancing"},
    {"instancing", "attributes", index_map, "accessors", needed},

    {"mesh", "name", string},
    {"mesh", "primitives", object_list, "primitive", needed},
    {"mesh", "weights", numbers},
    {"primitive", "attributes", index_map, "accessors", needed},
    {"primitive", "indices", index, "accessors"},
    {"primitive", "material", index, "materials"},
    {"primitive", "mode", integer, {}, false, 0, 6},
    {"primitive", "targets", index_maps, "accessors"},
    {"primitive", "KHR_draco_mesh_compression", extension, "draco"},
    {"draco", "bufferView", index, "bufferViews", needed},
    {"draco", "attributes", integer_map, {}, needed, 0, 4294967295.0},

    {"accessor", "bufferView", index, "bufferViews"},
    {"accessor", "byteOffset", integer, {}, false, 0, whole},
    {"accessor", "componentType", integer, {}, needed, 5120, 5126},
    {"accessor", "normalized", boolean},
    {"accessor", "count", integer, {}, needed, 1, 4294967295.0},
    {"accessor", "type", string, {}, needed},
    {"accessor", "sparse", object, "sparse"},
    {"sparse", "count", integer, {}, needed, 1, 2147483647.0},
    {"sparse", "indices", object, "sparse indices", needed},
    {"sparse", "values", object, "sparse values", needed},
    {"sparse indices", "bufferView", index, "bufferViews", needed},
    {"sparse indices", "byteOffset", integer, {}, false, 0, 2147483647.0},
    {"sparse indices", "componentType", integer, {}, needed, 5121, 5125},
    {"sparse values", "bufferView", index, "bufferViews", needed},
    {"sparse values", "byteOffset", integer, {}, false, 0, 2147483647.0},

    {"bufferView", "buffer", index, "buffers", needed},
    {"bufferView", "byteOffset", integer, {}, false, 0, whole},
    {"bufferView", "byteLength", integer, {}, needed, 1, whole},
    {"bufferView", "byteStride", integer, {}, false, 4, 252},
    {"bufferView", "EXT_meshopt_compression", extension, "meshopt"},
    {"meshopt", "buffer", index, "buffers", needed},
    {"meshopt", "byteOffset", integer, {}, false, 0, whole},
    {"meshopt", "byteLength", integer, {}, needed, 1, whole},
    {"meshopt", "byteStride", integer, {}, needed, 1, 256},
    {"meshopt", "count", integer, {}, needed, 1, 4294967295.0},
    {"meshopt", "mode", string, {}, needed},
    {"meshopt", "filter", string},
    {"buffer", "byteLength", integer, {}, needed, 1, whole},
    {"buffer", "uri", string},

    {"material", "name", string},
    {"material", "pbrMetallicRoughness", object, "metallic-roughness"},
    {"material", "normalTexture", object, "texture reference"},
    {"material", "occlusionTexture", object, "texture reference"},
    {"material", "emissiveTexture", object, "texture reference"},
    {"material", "emissiveFactor", numbers, {}, false, -1e300, 1e300, 3},
    {"material", "alphaMode", string},
    {"material", "alphaCutoff", number},
    {"material", "doubleSided", boolean},
    {"material", "KHR_materials_unlit", extension, "unlit"},
    {"material", "KHR_materials_emissive_strength", extension, "emissive strength"},
    {"emissive strength", "emissiveStrength", number},
    {"metallic-roughness", "baseColorFactor", numbers, {}, false, -1e300, 1e300, 4},
    {"metallic-roughness", "baseColorTexture", object, "texture reference"},
    {"metallic-roughness", "metallicFactor", number},
    {"metallic-roughness", "roughnessFactor", number},
    {"metallic-roughness", "metallicRoughnessTexture", object, "texture reference"},
    {"texture reference", "index", index, "textures", needed},
    {"texture reference", "texCoord", integer, {}, false, 0, 1000},
    {"texture reference", "scale", number},
    {"texture reference", "strength", number},
    {"texture reference", "KHR_texture_transform", extension, "texture transform"},
    {"texture transform", "offset", numbers, {}, false, -1e300, 1e300, 2},
    {"texture transform", "rotation", number},
    {"texture transform", "scale", numbers, {}, false, -1e300, 1e300, 2},
    {"texture transform", "texCoord", integer, {}, false, 0, 1000},

    {"texture", "name", string},
    {"texture", "sampler", index, "samplers"},
    {"texture", "source", index, "images"},
    {"texture", "EXT_texture_webp", extension, "image reference"},
    {"image reference", "source", index, "images", needed},
    {"sampler", "magFilter", integer, {}, false, 9728, 9729},
    {"sampler", "minFilter", integer, {}, false, 9728, 9987},
    {"sampler", "wrapS", integer, {}, false, 10497, 33648},
    {"sampler", "wrapT", integer, {}, false, 10497, 33648},
    {"image", "name", string},
    {"image", "uri", string},
    {"image", "mimeType", string},
    {"image", "bufferView", index, "bufferViews"},

    {"skin", "name", string},
    {"skin", "inverseBindMatrices", index, "accessors"},
    {"skin", "joints", index_list, "nodes", needed},

    {"camera", "name", string},
    {"camera", "type", string, {}, needed},
    {"camera", "perspective", object, "perspective"},
    {"camera", "orthographic", object, "orthographic"},
    {"perspective", "aspectRatio", number},
    {"perspective", "yfov", number, {}, needed},
    {"perspective", "zfar", number},
    {"perspective", "znear", number, {}, needed},
    {"orthographic", "xmag", number, {}, needed},
    {"orthographic", "ymag", number, {}, needed},
    {"orthographic", "zfar", number, {}, needed},
    {"orthographic", "znear", number, {}, needed},

    {"light", "name", string},
    {"light", "type", string, {}, needed},
    {"light", "color", numbers, {}, false, -1e300, 1e300, 3},
    {"light", "intensity", number},
    {"light", "range", number},
    {"light", "spot", object, "spot"},
    {"spot", "innerConeAngle", number},
    {"spot", "outerConeAngle", number},
};

// Placeholders satisfy what tinygltf insists on.
constexpr GltfCollection collections[] = {
    {"scenes", "scene", R"({"nodes":[]})"},
    {"nodes", "node", "{}"},
    {"meshes", "mesh", R"({"primitives":[]})"},
    {"accessors", "accessor", R"({"componentType":5126,"count":1,"type":"SCALAR"})"},
    {"bufferViews", "bufferView", R"({"buffer":0,"byteLength":1})"},
    {"buffers", "buffer", "{}"},
    {"materials", "material", "{}"},
    {"textures", "texture", "{}"},
    {"samplers", "sampler", "{}"},
    {"images", "image", "{}"},
    {"skins", "skin", R"({"joints":[]})"},
    {"cameras", "camera", R"({"type":"perspective","perspective":{"yfov":1,"znear":1}})"},
    {"lights", "light", R"({"type":"point"})"},
};

}  // namespace

std::span<const GltfRule> gltf_rules() { return rules; }
std::span<const GltfCollection> gltf_collections() { return collections; }

}  // namespace tessera
