#include "io/gltf_check.hpp"

#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "base/error.hpp"
#include "io/gltf_schema.hpp"

namespace tessera {
namespace {

using nlohmann::json;

std::string shown(const json& value) {
  if (value.is_object() || value.is_array()) return value.type_name();
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

class Checker {
 public:
  Checker(const json& document, const std::string& file) : document_(document), file_(file) {
    for (const GltfRule& rule : gltf_rules()) rules_[rule.type].push_back(&rule);
    for (const GltfCollection& collection : gltf_collections()) open(collection);
    find_parents();
  }

  CheckedGltf run() {
    choose_scene();
    while (!pending_.empty()) {
      const Pending item = pending_.back();
      pending_.pop_back();
      Collection& collection = collections_.at(item.collection);
      const std::string path = fmt::format("{}[{}]", collection.path, item.index);
      (*collection.out)[item.index] = check_object(collection.type, (*collection.in)[item.index], path);
    }
    CheckedGltf result;
    for (auto& [name, collection] : collections_) {
      if (collection.size == 0) continue;
      if (name == "lights") {
        result.json["extensions"]["KHR_lights_punctual"]["lights"] = std::move(*collection.out);
      } else {
        result.json[std::string(name)] = std::move(*collection.out);
      }
    }
    result.roots = std::move(roots_);
    result.parent = std::move(parent_);
    result.scene_name = std::move(scene_name_);
    return result;
  }

 private:
  struct Collection {
    std::string_view name, type;
    std::string path;
    const json* in = nullptr;
    std::unique_ptr<json> out;
    std::size_t size = 0;
    std::vector<bool> reached;
  };
  struct Pending {
    std::string_view collection;
    std::size_t index;
  };

  template <class... Args>
  [[nodiscard]] Error wrong(const std::string& path, fmt::format_string<Args...> format, Args&&... args) const {
    return input_error("{}: {}: {}", file_, path, fmt::format(format, std::forward<Args>(args)...));
  }

  void open(const GltfCollection& description) {
    Collection collection;
    collection.path = description.name == "lights" ? "extensions.KHR_lights_punctual.lights" : description.name;
    collection.name = description.name;
    collection.type = description.type;
    const json* in = nullptr;
    if (description.name == "lights") {
      const json::json_pointer pointer("/extensions/KHR_lights_punctual/lights");
      if (document_.contains(pointer)) in = &document_.at(pointer);
    } else if (document_.contains(description.name)) {
      in = &document_.at(std::string(description.name));
    }
    if (in != nullptr && !in->is_array()) throw wrong(collection.path, "is {}, expected an array", shown(*in));
    collection.in = in;
    collection.size = in != nullptr ? in->size() : 0;
    collection.reached.resize(collection.size);
    collection.out = std::make_unique<json>(json::array());
    const json placeholder = json::parse(description.placeholder);
    for (std::size_t i = 0; i < collection.size; ++i) collection.out->push_back(placeholder);
    collections_.emplace(description.name, std::move(collection));
  }

  // Over all nodes, because joints may hang under nodes that no scene lists. What is broken is complained about only if
  // it is reached.
  void find_parents() {
    const Collection& nodes = collections_.at("nodes");
    parent_.assign(nodes.size, -1);
    for (std::size_t i = 0; i < nodes.size; ++i) {
      const json& node = (*nodes.in)[i];
      if (!node.is_object() || !node.contains("children") || !node["children"].is_array()) continue;
      for (const json& child : node["children"]) {
        if (!child.is_number_unsigned()) continue;
        const auto index = child.get<std::uint64_t>();
        if (index >= nodes.size) continue;
        if (parent_[index] >= 0) second_parent_.emplace(index, int(i));
        if (parent_[index] < 0) parent_[index] = int(i);
      }
    }
  }

  // A node on a loop, or with two parents, has no place in the world.
  void check_node_place(std::size_t index) {
    const auto second = second_parent_.find(index);
    if (second != second_parent_.end()) {
      throw wrong(fmt::format("nodes[{}]", index), "is a child of nodes[{}] and of nodes[{}]", parent_[index],
                  second->second);
    }
    // Upwards to a node whose own way up is known to end.
    std::vector<std::size_t> way;
    for (int at = int(index); at >= 0 && !rooted_[std::size_t(at)]; at = parent_[std::size_t(at)]) {
      if (on_way_[std::size_t(at)]) throw wrong(fmt::format("nodes[{}]", at), "is among its own descendants");
      on_way_[std::size_t(at)] = true;
      way.push_back(std::size_t(at));
    }
    for (const std::size_t at : way) rooted_[at] = true;
  }

  void choose_scene() {
    rooted_.resize(parent_.size());
    on_way_.resize(parent_.size());
    Collection& scenes = collections_.at("scenes");
    std::size_t chosen = 0;
    if (document_.contains("scene")) chosen = check_index(document_["scene"], "scenes", "scene");
    if (scenes.size == 0) {
      for (std::size_t i = 0; i < parent_.size(); ++i) {
        if (parent_[i] >= 0) continue;
        roots_.push_back(int(i));
        reach("nodes", i);
      }
      if (roots_.empty() && !parent_.empty()) throw wrong("nodes", "every node is the child of another one");
      return;
    }
    reach("scenes", chosen);
    const json scene = check_object("scene", (*scenes.in)[chosen], fmt::format("scenes[{}]", chosen));
    scene_name_ = scene.value("name", "");
    for (const json& root : scene.value("nodes", json::array())) {
      const auto index = root.get<std::size_t>();
      if (parent_[index] >= 0) {
        throw wrong(fmt::format("scenes[{}].nodes", chosen), "nodes[{}] is no root, it is a child of nodes[{}]", index,
                    parent_[index]);
      }
      roots_.push_back(int(index));
    }
  }

  void reach(std::string_view name, std::size_t index) {
    Collection& collection = collections_.at(name);
    const bool is_node = name == "nodes";
    if (is_node && !collection.reached[index]) check_node_place(index);
    // A node needs its ancestors, to be placed.
    for (int at = int(index); at >= 0 && !collection.reached[std::size_t(at)];
         at = is_node ? parent_[std::size_t(at)] : -1) {
      collection.reached[std::size_t(at)] = true;
      pending_.push_back({collection.name, std::size_t(at)});
    }
  }

  double check_number(const json& value, const std::string& path) const {
    if (!value.is_number()) throw wrong(path, "is {}, expected a number", shown(value));
    const double number = value.get<double>();
    if (!std::isfinite(number)) throw wrong(path, "is not finite");
    return number;
  }

  std::int64_t check_integer(const json& value, const GltfRule& rule, const std::string& path) const {
    const double number = value.is_number() ? value.get<double>() : NAN;
    if (!(number == std::floor(number)) || std::isinf(number)) {
      throw wrong(path, "is {}, expected an integer", shown(value));
    }
    if (number < rule.low || number > rule.high) {
      throw wrong(path, "is {}, expected {} to {}", shown(value), std::int64_t(rule.low), std::int64_t(rule.high));
    }
    return std::int64_t(number);
  }

  std::size_t check_index(const json& value, std::string_view collection, const std::string& path) {
    const Collection& target = collections_.at(collection);
    const double number = value.is_number() ? value.get<double>() : NAN;
    if (!(number == std::floor(number))) throw wrong(path, "is {}, expected an index", shown(value));
    if (number < 0 || number >= double(target.size)) {
      throw wrong(path, "index {} is out of range: there are {} {}", shown(value), target.size, target.path);
    }
    reach(collection, std::size_t(number));
    return std::size_t(number);
  }

  json check_index_map(const json& value, const GltfRule& rule, const std::string& path) {
    if (!value.is_object()) throw wrong(path, "is {}, expected an object", shown(value));
    json out = json::object();
    for (const auto& [key, index] : value.items()) {
      const std::string place = fmt::format("{}.{}", path, key);
      if (rule.kind == GltfKind::integer_map) {
        out[key] = check_integer(index, rule, place);
      } else {
        out[key] = check_index(index, rule.target, place);
      }
    }
    return out;
  }

  const json& check_array(const json& value, const std::string& path) const {
    if (!value.is_array()) throw wrong(path, "is {}, expected an array", shown(value));
    return value;
  }

  json check_value(const GltfRule& rule, const json& value, const std::string& path) {
    json out;
    switch (rule.kind) {
      case GltfKind::boolean:
        if (!value.is_boolean()) throw wrong(path, "is {}, expected true or false", shown(value));
        return value;
      case GltfKind::string:
        if (!value.is_string()) throw wrong(path, "is {}, expected a string", shown(value));
        return value;
      case GltfKind::integer:
        return check_integer(value, rule, path);
      case GltfKind::number:
        return check_number(value, path);
      case GltfKind::numbers:
        if (check_array(value, path).size() != rule.length && rule.length != 0) {
          throw wrong(path, "has {} numbers, expected {}", value.size(), rule.length);
        }
        out = json::array();
        for (std::size_t i = 0; i < value.size(); ++i) {
          out.push_back(check_number(value[i], fmt::format("{}[{}]", path, i)));
        }
        return out;
      case GltfKind::index:
        return check_index(value, rule.target, path);
      case GltfKind::index_list: {
        out = json::array();
        std::set<std::size_t> seen;
        for (std::size_t i = 0; i < check_array(value, path).size(); ++i) {
          const std::string place = fmt::format("{}[{}]", path, i);
          const std::size_t index = check_index(value[i], rule.target, place);
          if (!seen.insert(index).second) throw wrong(place, "repeats {}", index);
          out.push_back(index);
        }
        return out;
      }
      case GltfKind::index_map:
      case GltfKind::integer_map:
        return check_index_map(value, rule, path);
      case GltfKind::index_maps:
        out = json::array();
        for (std::size_t i = 0; i < check_array(value, path).size(); ++i) {
          out.push_back(check_index_map(value[i], rule, fmt::format("{}[{}]", path, i)));
        }
        return out;
      case GltfKind::object:
      case GltfKind::extension:
        return check_object(rule.target, value, path);
      case GltfKind::object_list:
        out = json::array();
        for (std::size_t i = 0; i < check_array(value, path).size(); ++i) {
          out.push_back(check_object(rule.target, value[i], fmt::format("{}[{}]", path, i)));
        }
        return out;
    }
    return out;
  }

  json check_object(std::string_view type, const json& value, const std::string& path) {
    if (!value.is_object()) throw wrong(path, "is {}, expected an object", shown(value));
    json out = json::object();
    const auto extensions = value.find("extensions");
    if (extensions != value.end() && !extensions->is_object()) {
      throw wrong(path + ".extensions", "is {}, expected an object", shown(*extensions));
    }
    for (const GltfRule* rule : rules_[type]) {
      const std::string key(rule->key);
      const bool extension = rule->kind == GltfKind::extension;
      if (extension && extensions == value.end()) continue;
      const json& holder = extension ? *extensions : value;
      const auto found = holder.find(key);
      if (found == holder.end()) {
        if (rule->required) throw wrong(path, "has no '{}'", key);
        continue;
      }
      json& place = extension ? out["extensions"][key] : out[key];
      place = check_value(*rule, *found, fmt::format("{}{}{}", path, extension ? ".extensions." : ".", key));
    }
    return out;
  }

  const json& document_;
  const std::string& file_;
  std::unordered_map<std::string_view, std::vector<const GltfRule*>> rules_;
  std::map<std::string_view, Collection> collections_;
  std::vector<Pending> pending_;
  std::vector<int> parent_, roots_;
  std::unordered_map<std::size_t, int> second_parent_;
  std::vector<bool> rooted_, on_way_;
  std::string scene_name_;
};

}  // namespace

CheckedGltf check_gltf(const nlohmann::json& document, const std::string& file) {
  return Checker(document, file).run();
}

}  // namespace tessera
