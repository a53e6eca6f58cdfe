// tessera info: what a file holds and what of it Tessera supports.
#include <array>
#include <nlohmann/json.hpp>

#include "base/parallel.hpp"
#include "cli/commands.hpp"
#include "cli/text.hpp"
#include "io/gltf.hpp"

namespace tessera::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> light_type_names = {"directional", "point", "spot"};
constexpr std::array<const char*, 3> alpha_mode_names = {"opaque", "mask", "blend"};

struct Options {
  std::string scene;
  bool json = false;
};

Json textures_of(const Material& m) {
  Json names = Json::array();
  const auto add = [&](const TextureSlot& slot, const char* name) {
    if (slot.texture >= 0) names.push_back(name);
  };
  add(m.base_color_texture, "base color");
  add(m.metallic_roughness_texture, "metallic-roughness");
  add(m.normal_texture, "normal");
  add(m.occlusion_texture, "occlusion");
  add(m.emissive_texture, "emissive");
  return names;
}

Json describe(const std::string& path, const Scene& scene, const GltfReport& report) {
  Json j;
  j["file"] = path;
  j["generator"] = report.generator;
  j["version"] = report.version;
  j["copyright"] = report.copyright;
  j["scene"] = report.default_scene;
  j["nodes"] = report.nodes;
  j["meshes"] = report.meshes;
  j["primitives"] = report.primitives;
  j["skipped_primitives"] = report.skipped_primitives;
  j["triangles"] = scene.triangles.size();
  j["vertices"] = scene.positions.size() / 3;
  j["skins"] = report.skins;
  j["animations"] = report.animations;
  const Bounds bounds = bounds_of(scene);
  j["bounds"] = {{"min", bounds.min}, {"max", bounds.max}, {"center", bounds.center}, {"radius", bounds.radius}};
  j["materials"] = Json::array();
  for (const Material& m : scene.materials)
    j["materials"].push_back({{"name", m.name},
                              {"alpha_mode", alpha_mode_names.at(static_cast<std::size_t>(m.alpha_mode))},
                              {"double_sided", m.double_sided},
                              {"unlit", m.unlit},
                              {"textures", textures_of(m)}});
  j["textures"] = scene.textures.size();
  j["images"] = Json::array();
  for (const SourceImage& image : scene.images) {
    Json entry = {{"name", image.name}, {"used", image.width > 0}};
    if (image.width > 0) {
      entry["width"] = image.width;
      entry["height"] = image.height;
      entry["channels"] = image.channels;
    }
    j["images"].push_back(entry);
  }
  j["lights"] = Json::array();
  for (const Light& light : scene.lights)
    j["lights"].push_back({{"name", light.name},
                           {"type", light_type_names.at(static_cast<std::size_t>(light.type))},
                           {"intensity", light.intensity},
                           {"color", light.color}});
  j["cameras"] = Json::array();
  for (const Camera& camera : scene.cameras)
    j["cameras"].push_back({{"name", camera.name}, {"type", camera.orthographic ? "orthographic" : "perspective"}});
  j["variants"] = report.variants;
  j["extensions_used"] = report.extensions_used;
  j["extensions_required"] = report.extensions_required;
  j["extensions_unsupported"] = report.extensions_unsupported;
  j["warnings"] = report.warnings;
  return j;
}

std::string joined(const Json& list) {
  std::string text;
  for (const Json& entry : list) text += (text.empty() ? "" : ", ") + entry.get<std::string>();
  return text.empty() ? "none" : printable(text);
}

// A name as a list shows it; files often leave it out.
std::string named(const Json& entry) {
  const std::string name = printable(entry.at("name").get<std::string>());
  return name.empty() ? "(no name)" : name;
}

std::string for_a_person(const Json& j) {
  std::string text;
  const auto row = [&](std::string_view key, const std::string& value) {
    text += fmt::format("{:<14}{}\n", key, value);
  };
  const auto count = [&](const char* key) { return grouped(j.at(key).get<std::uint64_t>()); };
  const auto vector = [&](const char* key) {
    const Json& v = j.at("bounds").at(key);
    return fmt::format("{:.6g}, {:.6g}, {:.6g}", v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>());
  };
  row("file", printable(j.at("file").get<std::string>()));
  row("glTF", fmt::format("{}, generator: {}", printable(j.at("version").get<std::string>()),
                          printable(j.at("generator").get<std::string>())));
  if (!j.at("copyright").get<std::string>().empty()) row("copyright", printable(j.at("copyright").get<std::string>()));
  row("nodes", count("nodes"));
  row("meshes",
      fmt::format("{} with {} primitives{}", count("meshes"), count("primitives"),
                  j.at("skipped_primitives") == 0 ? "" : fmt::format(", {} skipped", count("skipped_primitives"))));
  row("triangles", count("triangles"));
  row("vertices", count("vertices"));
  if (j.at("skins") != 0 || j.at("animations") != 0)
    row("movement",
        fmt::format("{} skins, {} animations (the rest pose is shown)", count("skins"), count("animations")));
  row("bounds", fmt::format("{}  to  {}  (radius {:.6g})", vector("min"), vector("max"),
                            j.at("bounds").at("radius").get<double>()));
  row("materials", grouped(j.at("materials").size()));
  int index = 0;
  for (const Json& m : j.at("materials")) {
    std::string line = fmt::format("  {:>3}  {}  {}", index++, named(m), m.at("alpha_mode").get<std::string>());
    if (m.at("double_sided").get<bool>()) line += ", double-sided";
    if (m.at("unlit").get<bool>()) line += ", unlit";
    if (!m.at("textures").empty()) line += "; textures: " + joined(m.at("textures"));
    text += line + "\n";
  }
  row("textures", fmt::format("{} of {} images", count("textures"), j.at("images").size()));
  index = 0;
  for (const Json& image : j.at("images"))
    text += image.at("used").get<bool>() ? fmt::format("  {:>3}  {}  {} x {}, {} channels\n", index++, named(image),
                                                       image.at("width").get<int>(), image.at("height").get<int>(),
                                                       image.at("channels").get<int>())
                                         : fmt::format("  {:>3}  {}  not used\n", index++, named(image));
  row("lights", grouped(j.at("lights").size()));
  index = 0;
  for (const Json& light : j.at("lights"))
    text += fmt::format("  {:>3}  {}  {}, {:.6g} {}\n", index++, named(light), light.at("type").get<std::string>(),
                        light.at("intensity").get<double>(), light.at("type") == "directional" ? "lux" : "candela");
  row("cameras", grouped(j.at("cameras").size()));
  index = 0;
  for (const Json& camera : j.at("cameras"))
    text += fmt::format("  {:>3}  {}  {}\n", index++, named(camera), camera.at("type").get<std::string>());
  if (!j.at("variants").empty()) row("variants", joined(j.at("variants")) + " (the default materials are used)");
  row("extensions", "used: " + joined(j.at("extensions_used")));
  row("", "required: " + joined(j.at("extensions_required")));
  row("", "not supported: " + joined(j.at("extensions_unsupported")));
  for (const Json& warning : j.at("warnings")) row("warning", printable(warning.get<std::string>()));
  return text;
}

void run_info(const Options& options) {
  GltfReport report;
  Scene scene;
  run_with_threads(0, [&] { scene = load_gltf(options.scene, &report); });
  const Json json = describe(options.scene, scene, report);
  // File names and names in the file need not be UTF-8.
  print(options.json ? json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n" : for_a_person(json));
}

}  // namespace

void add_info(CLI::App& program) {
  CLI::App* command = program.add_subcommand("info", "Tells what a glTF file holds, and what of it is not supported");
  auto options = std::make_shared<Options>();
  command->add_option("scene", options->scene, "A .gltf or .glb file")->required();
  command->add_flag("--json", options->json, "Print JSON");
  command->footer("Example: tessera info scene.glb");
  command->callback([options] { run_info(*options); });
}

}  // namespace tessera::cli
