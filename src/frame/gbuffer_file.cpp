#include "frame/gbuffer_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace tessera {
namespace {

using Json = nlohmann::json;

constexpr const char* triangle_channel = "triangle";
constexpr const char* coverage_channel = "coverage_mask";

template <std::size_t N>
Json array_of(const float (&values)[N]) {
  Json out = Json::array();
  for (const float v : values) out.push_back(static_cast<double>(v));  // exact, and printed so that it reads back exact
  return out;
}

template <std::size_t N>
void read_array(const Json& json, const char* key, float (&out)[N]) {
  const Json& values = json.at(key);
  if (!values.is_array() || values.size() != N)
    throw std::runtime_error(fmt::format("'{}' is not an array of {} numbers", key, N));
  for (std::size_t i = 0; i < N; ++i) out[i] = static_cast<float>(values[i].get<double>());
}

Json to_json(const View& view) {
  const ViewTransform& t = view.transform;
  return {{"x", array_of(t.x)},
          {"y", array_of(t.y)},
          {"z", array_of(t.z)},
          {"w", array_of(t.w)},
          {"eye", array_of(t.eye)},
          {"ray_corner", array_of(view.ray_corner)},
          {"ray_dx", array_of(view.ray_dx)},
          {"ray_dy", array_of(view.ray_dy)}};
}

View view_from_json(const Json& json, int width, int height) {
  View view{};
  ViewTransform& t = view.transform;
  read_array(json, "x", t.x);
  read_array(json, "y", t.y);
  read_array(json, "z", t.z);
  read_array(json, "w", t.w);
  read_array(json, "eye", t.eye);
  read_array(json, "ray_corner", view.ray_corner);
  read_array(json, "ray_dx", view.ray_dx);
  read_array(json, "ray_dy", view.ray_dy);
  t.width = width;
  t.height = height;
  return view;
}

constexpr const char* light_types[] = {"directional", "point", "spot"};

Json to_json(const Light& l) {
  return {{"name", l.name},
          {"type", light_types[static_cast<int>(l.type)]},
          {"position", array_of(l.position)},
          {"direction", array_of(l.direction)},
          {"color", array_of(l.color)},
          {"intensity", l.intensity},
          {"range", l.range},
          {"inner_cone_angle", l.inner_cone_angle},
          {"outer_cone_angle", l.outer_cone_angle}};
}

Light light_from_json(const Json& json) {
  Light l;
  l.name = json.at("name").get<std::string>();
  const auto type = json.at("type").get<std::string>();
  for (int k = 0; k < 3; ++k)
    if (type == light_types[k]) l.type = static_cast<LightType>(k);
  read_array(json, "position", l.position);
  read_array(json, "direction", l.direction);
  read_array(json, "color", l.color);
  l.intensity = json.at("intensity").get<float>();
  l.range = json.at("range").get<float>();
  l.inner_cone_angle = json.at("inner_cone_angle").get<float>();
  l.outer_cone_angle = json.at("outer_cone_angle").get<float>();
  return l;
}

// A pixel of a flat file without a coverage layer is empty where the normal has no length.
void keep_covered_pixels(GBufferImage& image, std::size_t pixels, bool has_coverage) {
  image.counts.assign(pixels, 0);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const bool seen = has_coverage ? image.coverage[i] != 0
                                   : image.planes[3][i] != 0 || image.planes[4][i] != 0 || image.planes[5][i] != 0;
    if (!seen) continue;
    image.counts[i] = 1;
    image.triangle[kept] = image.triangle[i];
    image.coverage[kept] = image.coverage[i];
    for (AlignedVector<float>& plane : image.planes) plane[kept] = plane[i];
    ++kept;
  }
  image.triangle.resize(kept);
  image.coverage.resize(kept);
  for (AlignedVector<float>& plane : image.planes) plane.resize(kept);
}

}  // namespace

std::map<std::string, std::string> gbuffer_attributes(const GBufferImage& image, const View& view,
                                                      const std::vector<Light>& lights) {
  Json list = Json::array();
  for (const Light& light : lights) list.push_back(to_json(light));
  return {{"tessera:view", to_json(view).dump()},
          {"tessera:lights", list.dump()},
          {"tessera:samples", std::to_string(image.samples)}};
}

std::vector<ExrChannel> flat_gbuffer_channels(const GBufferImage& image, FlatPlanes& storage) {
  const std::size_t pixels = image.counts.size();
  storage.f32.assign(gbuffer_planes, AlignedVector<float>(pixels, 0.0f));
  storage.u32.assign(2, std::vector<std::uint32_t>(pixels, 0));
  std::size_t at = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (image.counts[i] == 0) continue;
    for (int k = 0; k < gbuffer_planes; ++k) storage.f32[k][i] = image.planes[k][at];
    storage.u32[0][i] = image.triangle[at];
    storage.u32[1][i] = image.coverage[at];
    ++at;
  }
  std::vector<ExrChannel> channels;
  channels.reserve(gbuffer_planes + 2);
  for (int k = 0; k < gbuffer_planes; ++k)
    channels.push_back({gbuffer_plane_names[k].name, storage.f32[k].data(), nullptr, 1});
  channels.push_back({triangle_channel, nullptr, storage.u32[0].data(), 1});
  channels.push_back({coverage_channel, nullptr, storage.u32[1].data(), 1});
  return channels;
}

void write_deep_gbuffer(const std::string& path, const GBufferImage& image,
                        const std::map<std::string, std::string>& attributes) {
  std::vector<ExrChannel> channels;
  channels.reserve(gbuffer_planes + 2);
  for (int k = 0; k < gbuffer_planes; ++k)
    channels.push_back({gbuffer_plane_names[k].name, image.planes[k].data(), nullptr, 1});
  channels.push_back({triangle_channel, nullptr, image.triangle.data(), 1});
  channels.push_back({coverage_channel, nullptr, image.coverage.data(), 1});
  write_deep_exr(path, image.width, image.height, image.counts, channels, attributes);
}

GBufferFile read_gbuffer(const std::string& path) {
  ExrLayers layers = read_exr_layers(path);
  GBufferFile file;
  GBufferImage& image = file.image;
  image.width = layers.width;
  image.height = layers.height;
  if (image.width > max_frame_size || image.height > max_frame_size)
    throw input_error("{}: {}x{} pixels: expected at most {}x{}", path, image.width, image.height, max_frame_size,
                      max_frame_size);
  std::size_t total = 0;
  for (const std::uint32_t n : layers.counts) total += n;
  for (int k = 0; k < gbuffer_planes; ++k) {
    const GBufferPlane& plane = gbuffer_plane_names[k];
    const auto found = layers.f32.find(plane.name);
    if (found != layers.f32.end())
      image.planes[k] = std::move(found->second);
    else if (plane.required)
      throw input_error("{}: no layer '{}': not a G-buffer ('tessera render --aov gbuffer' writes one)", path,
                        plane.name);
    else
      image.planes[k].assign(total, plane.absent);
  }
  const auto samples = layers.attributes.find("tessera:samples");
  if (samples != layers.attributes.end()) {
    const std::string& text = samples->second;
    if (text != "1" && text != "2" && text != "4" && text != "8" && text != "16")
      throw input_error("{}: attribute tessera:samples is '{}': expected 1, 2, 4, 8 or 16", path, text);
    image.samples = std::stoi(text);
  }
  const auto triangle = layers.u32.find(triangle_channel), coverage = layers.u32.find(coverage_channel);
  image.triangle = triangle != layers.u32.end() ? std::move(triangle->second) : std::vector<std::uint32_t>(total, 0);
  const std::uint32_t whole = (1u << image.samples) - 1;
  const bool has_coverage = coverage != layers.u32.end();
  image.coverage = has_coverage ? std::move(coverage->second) : std::vector<std::uint32_t>(total, whole);
  for (const std::uint32_t mask : image.coverage)
    if (mask > whole)
      throw input_error("{}: layer '{}' holds {}: expected at most {} with {} samples", path, coverage_channel, mask,
                        whole, image.samples);
  for (float& a : image.planes[15]) a = a >= 0 ? (a <= 1 ? a : 1) : 0;  // alpha weighs: NaN gives nothing
  if (layers.deep)
    image.counts = std::move(layers.counts);
  else
    keep_covered_pixels(image, total, has_coverage);
  try {
    if (const auto view = layers.attributes.find("tessera:view"); view != layers.attributes.end())
      file.view = view_from_json(Json::parse(view->second), image.width, image.height);
    if (const auto lights = layers.attributes.find("tessera:lights"); lights != layers.attributes.end())
      for (const Json& light : Json::parse(lights->second)) file.lights.push_back(light_from_json(light));
  } catch (const std::exception& e) {
    throw input_error("{}: broken tessera attribute: {}", path, e.what());
  }
  return file;
}

}  // namespace tessera
