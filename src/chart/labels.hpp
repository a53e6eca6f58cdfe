// Where the names of points go, so that none covers another, a point, or anything else that matters.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace tessera::chart {

struct Rect {
  double x0, y0, x1, y1;
  [[nodiscard]] bool overlaps(const Rect& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
  [[nodiscard]] bool contains(const Rect& other) const {
    return x0 <= other.x0 && y0 <= other.y0 && other.x1 <= x1 && other.y1 <= y1;
  }
};

struct Segment {
  double x0, y0, x1, y1;
};
bool crosses(const Segment& line, const Rect& rect);

struct LabelRequest {
  double x, y, radius;          // the point that it names
  std::vector<Rect> choices{};  // sizes (x1 - x0, y1 - y0) of its wordings, the preferred first; position is ignored
};

struct Label {
  bool placed = false;
  std::size_t choice = 0;
  Rect box{};
  bool leader = false;  // far enough from its point to need a line to it
  Segment line{};
};

struct LabelScene {
  Rect bounds{};
  std::vector<Rect> obstacles{};      // never covered; the points themselves are added
  std::vector<Segment> soft_lines{};  // covered only if the label would else be farther away
};

/// One label per request, in the order of the requests: earlier ones choose first. The same input gives the same
/// output. A label that finds no room in any wording is not placed.
std::vector<Label> place_labels(const LabelScene& scene, const std::vector<LabelRequest>& requests);

/// Upper estimate of the width of a text in pixels: fonts differ, and a label must not grow into its neighbour.
double text_width(const std::string& text, double font_size);

}  // namespace tessera::chart
