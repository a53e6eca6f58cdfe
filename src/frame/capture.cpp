#include "frame/capture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.hpp"
#include "base/parallel.hpp"

namespace tessera {
namespace {

struct AovKind {
  const char* name;
  std::vector<const char*> components;  // empty: one channel of the layer's own name
  bool integer;
  int first_plane;  // of the G-buffer; -1: computed
  float empty;
};

const std::vector<AovKind>& aov_kinds() {
  static const std::vector<AovKind> kinds = {
      {"id", {}, true, -1, 0},
      {"part", {}, true, -1, 0},
      {"material", {}, true, -1, 0},
      {"depth", {"Z"}, false, -1, INFINITY},
      {"position", {"X", "Y", "Z"}, false, 0, 0},
      {"normal", {"X", "Y", "Z"}, false, 3, 0},
      {"albedo", {"R", "G", "B"}, false, 6, 0},
      {"metallic", {}, false, 9, 0},
      {"roughness", {}, false, 10, 0},
      {"occlusion", {}, false, 11, 0},
      {"emissive", {"R", "G", "B"}, false, 12, 0},
      {"alpha", {}, false, 15, 0},
      {"coverage", {}, false, -1, 0},
  };
  return kinds;
}

const AovKind& kind_of(const std::string& name) {
  for (const AovKind& kind : aov_kinds())
    if (name == kind.name) return kind;
  std::string known;
  for (const std::string& n : aov_names()) known += (known.empty() ? "" : ", ") + n;
  throw usage_error("unknown AOV '{}': expected some of {}, gbuffer", name, known);
}

std::uint32_t part_of(const Scene& scene, std::uint32_t triangle) {
  const auto after = std::upper_bound(scene.parts.begin(), scene.parts.end(), triangle,
                                      [](std::uint32_t t, const Part& part) { return t < part.first_triangle; });
  return static_cast<std::uint32_t>(after - scene.parts.begin());  // already + 1
}

// Distance along the view axis of a perspective view; of an orthographic one, along its depth axis from the eye's
// plane.
float view_depth(const ViewTransform& view, const float (&p)[3]) {
  if (view.eye[3] != 0) return view.w[0] * p[0] + view.w[1] * p[1] + view.w[2] * p[2] + view.w[3];
  // depth = (far - d) / (far - near): the row's length is 1 / (far - near), its constant part gives far.
  const float* z = view.z;
  const float scale = std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
  const float depth = z[0] * p[0] + z[1] * p[1] + z[2] * p[2] + z[3];
  return (1 - depth) / scale;
}

}  // namespace

const std::vector<std::string>& aov_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const AovKind& kind : aov_kinds()) all.emplace_back(kind.name);
    return all;
  }();
  return names;
}

std::vector<AovLayer> make_aov_layers(const std::vector<std::string>& names, int width, int height) {
  std::vector<AovLayer> layers;
  const std::size_t pixels = std::size_t(width) * height;
  for (const std::string& name : names) {
    const AovKind& kind = kind_of(name);
    if (std::any_of(layers.begin(), layers.end(), [&](const AovLayer& l) { return l.name == name; })) continue;
    AovLayer layer;
    layer.name = name;
    if (kind.components.empty()) layer.channels.push_back(name);
    for (const char* component : kind.components) layer.channels.push_back(name + "." + component);
    if (kind.integer)
      layer.u32.assign(pixels, 0);
    else
      layer.f32.assign(layer.channels.size(), AlignedVector<float>(pixels, kind.empty));
    layers.push_back(std::move(layer));
  }
  return layers;
}

void capture_aovs(std::vector<AovLayer>& layers, const TileFragments& tile, const TileRect& rect, int picture_width,
                  const Scene& scene, const ViewTransform& view, int samples) {
  GBufferView gbuffer = tile.gbuffer();
  const std::size_t count = tile.fragments.size();
  for (std::size_t i = 0; i < count;) {
    const std::uint16_t pixel = tile.fragments[i].pixel;
    std::size_t best = i, end = i;
    std::uint32_t covered = 0;
    for (; end < count && tile.fragments[end].pixel == pixel; ++end) {
      covered |= tile.fragments[end].samples;
      if (std::popcount(tile.fragments[end].samples) > std::popcount(tile.fragments[best].samples)) best = end;
    }
    i = end;
    const std::uint32_t slot = tile.slot(best);
    const std::uint32_t triangle = tile.fragments[best].triangle;
    const std::size_t at =
        std::size_t(rect.y + tile_pixel_y(pixel)) * picture_width + std::size_t(rect.x + tile_pixel_x(pixel));
    for (AovLayer& layer : layers) {
      const AovKind& kind = kind_of(layer.name);
      if (layer.name == "id") {
        layer.u32[at] = triangle + 1;
      } else if (layer.name == "part") {
        layer.u32[at] = part_of(scene, triangle);
      } else if (layer.name == "material") {
        layer.u32[at] = scene.bindings[scene.triangles[triangle].binding].material + 1;
      } else if (layer.name == "depth") {
        layer.f32[0][at] =
            view_depth(view, {gbuffer.position[0][slot], gbuffer.position[1][slot], gbuffer.position[2][slot]});
      } else if (layer.name == "coverage") {
        layer.f32[0][at] = static_cast<float>(std::popcount(covered)) / static_cast<float>(samples);
      } else {
        for (std::size_t k = 0; k < layer.f32.size(); ++k)
          layer.f32[k][at] = gbuffer_pointer(gbuffer, kind.first_plane + static_cast<int>(k))[slot];
      }
    }
  }
}

GBufferCapture::GBufferCapture(int width, int height, int samples)
    : width_(width), height_(height), samples_(samples), tiles_x_((width + tile_size - 1) / tile_size) {
  pieces_.resize(std::size_t(tiles_x_) * ((height + tile_size - 1) / tile_size));
}

void GBufferCapture::add(const TileFragments& tile, const TileRect& rect) {
  Piece& piece = pieces_[std::size_t(rect.y / tile_size) * tiles_x_ + rect.x / tile_size];
  piece.rect = rect;
  piece.fragments.assign(tile.fragments.begin(), tile.fragments.end());
  const std::size_t count = tile.fragments.size();
  piece.planes.resize(count * gbuffer_planes);
  GBufferView view = tile.gbuffer();
  for (int k = 0; k < gbuffer_planes; ++k) {
    const float* plane = gbuffer_pointer(view, k);
    for (std::size_t i = 0; i < count; ++i) piece.planes[k * count + i] = plane[tile.slot(i)];
  }
}

void GBufferCapture::finish(GBufferImage& out) {
  out.width = width_;
  out.height = height_;
  out.samples = samples_;
  out.counts.assign(std::size_t(width_) * height_, 0);
  const auto pixel_of = [&](const Piece& piece, const Fragment& f) {
    return std::size_t(piece.rect.y + tile_pixel_y(f.pixel)) * width_ +
           std::size_t(piece.rect.x + tile_pixel_x(f.pixel));
  };
  for (const Piece& piece : pieces_)
    for (const Fragment& f : piece.fragments) ++out.counts[pixel_of(piece, f)];
  std::vector<std::size_t> next(out.counts.size() + 1, 0);
  for (std::size_t i = 0; i < out.counts.size(); ++i) next[i + 1] = next[i] + out.counts[i];
  out.triangle.resize(next.back());
  out.coverage.resize(next.back());
  for (AlignedVector<float>& plane : out.planes) plane.resize(next.back());
  for (Piece& piece : pieces_) {
    const std::size_t count = piece.fragments.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = next[pixel_of(piece, piece.fragments[i])]++;
      out.triangle[at] = piece.fragments[i].triangle;
      out.coverage[at] = piece.fragments[i].samples;
      for (int k = 0; k < gbuffer_planes; ++k) out.planes[k][at] = piece.planes[k * count + i];
    }
    piece = Piece{};
  }
}

void load_tile(const GBufferImage& gbuffer, const std::vector<std::size_t>& first, const TileRect& rect,
               TileFragments& out) {
  out.clear();
  std::uint32_t total = 0;
  for (int y = 0; y < rect.height; ++y)
    for (int x = 0; x < rect.width; ++x) total += gbuffer.counts[std::size_t(rect.y + y) * gbuffer.width + rect.x + x];
  out.reserve_planes(total);
  GBufferView view = out.gbuffer();
  for (int y = 0; y < rect.height; ++y) {
    const std::size_t row = std::size_t(rect.y + y) * gbuffer.width + rect.x;
    std::size_t at = first[row];
    for (int x = 0; x < rect.width; ++x)
      for (std::uint32_t n = gbuffer.counts[row + x]; n != 0; --n, ++at) {
        const auto slot = static_cast<std::uint32_t>(out.slots.size());
        out.slots.push_back(slot);
        out.fragments.push_back({gbuffer.triangle[at], static_cast<std::uint16_t>(tile_pixel(x, y)),
                                 static_cast<std::uint16_t>(gbuffer.coverage[at])});
        for (int k = 0; k < gbuffer_planes; ++k) gbuffer_pointer(view, k)[slot] = gbuffer.planes[k][at];
      }
  }
}

}  // namespace tessera
