#include "chart/labels.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::chart {
namespace {

constexpr int directions = 16;
constexpr double distances[] = {4, 9, 16, 25, 37, 52, 70, 92, 118};  // from the point's rim to the label, pixels
constexpr double leader_from = 14;                                   // beyond this a label needs a line to its point
constexpr double line_penalty = 45;  // pixels that a label rather goes than lie on a soft line
constexpr double pi = 3.14159265358979;

double side(const Segment& s, double x, double y) { return (s.x1 - s.x0) * (y - s.y0) - (s.y1 - s.y0) * (x - s.x0); }

bool cross(const Segment& a, const Segment& b) {
  return side(a, b.x0, b.y0) * side(a, b.x1, b.y1) < 0 && side(b, a.x0, a.y0) * side(b, a.x1, a.y1) < 0;
}

struct Candidate {
  Rect box;
  Segment line;
  double distance, cost;
};

// The box whose nearest point to the marker lies `distance` beyond its rim in direction `angle`.
Candidate candidate(const LabelRequest& request, const Rect& size, double angle, double distance) {
  const double width = size.x1 - size.x0, height = size.y1 - size.y0;
  const double dx = std::cos(angle), dy = std::sin(angle);
  const double x = request.x + dx * (request.radius + distance), y = request.y + dy * (request.radius + distance);
  // Sideways labels are centred on the ray, those above and below hang from their middle, others from a corner.
  const double align_x = std::clamp(0.5 - 0.72 * dx, 0.0, 1.0), align_y = std::clamp(0.5 - 0.72 * dy, 0.0, 1.0);
  const Rect box{x - width * align_x, y - height * align_y, x + width * (1 - align_x), y + height * (1 - align_y)};
  const double start = request.radius + 1;
  // Right of the point reads best, then above.
  const double preference = 4 * (1 - dx) + 0.5 * (1 + dy);
  return {box, {request.x + dx * start, request.y + dy * start, x, y}, distance, distance + preference};
}

struct Placement {
  const LabelScene& scene;
  std::vector<Rect> taken;
  std::vector<Segment> leaders;

  [[nodiscard]] bool free(const Candidate& c, const LabelRequest& of) const {
    if (!scene.bounds.contains(c.box)) return false;
    for (const Rect& rect : taken) {
      if (c.box.overlaps(rect)) return false;
      // A leader has to leave the point itself, and its error bar.
      const bool own = rect.x0 <= of.x && of.x <= rect.x1 && rect.y0 <= of.y && of.y <= rect.y1;
      if (c.distance > leader_from && !own && crosses(c.line, rect)) return false;
    }
    return std::none_of(leaders.begin(), leaders.end(), [&](const Segment& s) {
      return crosses(s, c.box) || (c.distance > leader_from && cross(s, c.line));
    });
  }
};

}  // namespace

bool crosses(const Segment& s, const Rect& r) {
  if (std::max(s.x0, s.x1) <= r.x0 || std::min(s.x0, s.x1) >= r.x1 || std::max(s.y0, s.y1) <= r.y0 ||
      std::min(s.y0, s.y1) >= r.y1)
    return false;
  // The rectangle's corners lie on one side of the line: it passes by.
  const double corners[] = {side(s, r.x0, r.y0), side(s, r.x1, r.y0), side(s, r.x0, r.y1), side(s, r.x1, r.y1)};
  return *std::min_element(corners, corners + 4) < 0 && *std::max_element(corners, corners + 4) > 0;
}

std::vector<Label> place_labels(const LabelScene& scene, const std::vector<LabelRequest>& requests) {
  Placement placement{scene, scene.obstacles, {}};
  for (const LabelRequest& r : requests)
    placement.taken.push_back({r.x - r.radius, r.y - r.radius, r.x + r.radius, r.y + r.radius});
  std::vector<Label> labels(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    Label& label = labels[i];
    for (std::size_t choice = 0; choice < requests[i].choices.size() && !label.placed; ++choice) {
      double best = INFINITY;
      for (const double distance : distances)
        for (int k = 0; k < directions; ++k) {
          Candidate c = candidate(requests[i], requests[i].choices[choice], 2 * pi * k / directions, distance);
          for (const Segment& line : scene.soft_lines)
            if (crosses(line, c.box)) c.cost += line_penalty;
          if (c.cost >= best || !placement.free(c, requests[i])) continue;
          best = c.cost;
          label = {true, choice, c.box, c.distance > leader_from, c.line};
        }
    }
    if (!label.placed) continue;
    placement.taken.push_back(label.box);
    if (label.leader) placement.leaders.push_back(label.line);
  }
  return labels;
}

double text_width(const std::string& text, double font_size) {
  double ems = 0;  // of DejaVu Sans, the widest of the fonts that a page or a picture may fall back to
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;  // inside a UTF-8 sequence
    const std::string narrow = "iljI.,:;'|!()[]ft/ ", wide = "mwMW@%";
    ems += narrow.find(c) != std::string::npos ? 0.38 : wide.find(c) != std::string::npos ? 0.97 : 0.635;
  }
  return ems * font_size;
}

}  // namespace tessera::chart
