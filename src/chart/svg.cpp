#include "chart/svg.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "chart/markup.hpp"
#include "chart/style.hpp"

namespace tessera::chart {

std::string line(const char* cls, double x0, double y0, double x1, double y1) {
  return fmt::format(R"(<path class="{}" d="M{} {}L{} {}"/>)", cls, coordinate(x0), coordinate(y0), coordinate(x1),
                     coordinate(y1));
}

std::string text(const char* cls, double x, double y, const char* anchor, const std::string& words) {
  return fmt::format(R"(<text class="{}" x="{}" y="{}" text-anchor="{}">{}</text>)", cls, coordinate(x), coordinate(y),
                     anchor, escaped(words));
}

std::string rectangle(const char* cls, const Rect& rect) {
  return fmt::format(R"(<rect class="{}" x="{}" y="{}" width="{}" height="{}"/>)", cls, coordinate(rect.x0),
                     coordinate(rect.y0), coordinate(rect.x1 - rect.x0), coordinate(rect.y1 - rect.y0));
}

std::string upright_text(const char* cls, double x, double y, const std::string& words) {
  return fmt::format(R"~(<text class="{}" text-anchor="middle" transform="translate({} {}) rotate(-90)">{}</text>)~",
                     cls, coordinate(x), coordinate(y), escaped(words));
}

std::string path_of(const std::vector<Segment>& segments) {
  std::string d;
  for (const Segment& s : segments)
    d += fmt::format("{}{} {}L{} {}", d.empty() ? "M" : "L", coordinate(s.x0), coordinate(s.y0), coordinate(s.x1),
                     coordinate(s.y1));
  return d;
}

std::vector<Segment> staircase(std::vector<Place> points, double top, double right) {
  std::sort(points.begin(), points.end(), [](const Place& a, const Place& b) { return a.x < b.x; });
  std::vector<Segment> segments;
  if (points.empty()) return segments;
  double x = points.front().x, y = top;
  for (const Place& p : points) {
    if (p.x > x) segments.push_back({x, y, p.x, y});
    if (p.y != y) segments.push_back({p.x, y, p.x, p.y});
    x = p.x;
    y = p.y;
  }
  segments.push_back({x, y, right, y});
  return segments;
}

std::string standalone(const std::string& content, double width, double height, const Lettering& around) {
  constexpr double head = 70, line_height = 17;
  const double whole = head + height + 12 + line_height * static_cast<double>(around.captions.size());
  std::string out =
      fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}">)",
                  coordinate(width), coordinate(whole));
  out += std::string("<style>") + plot_css + "</style><rect class=\"paper\" width=\"100%\" height=\"100%\"/>";
  out += text("title", 20, 28, "start", around.title) + text("subtitle", 20, 50, "start", around.subtitle);
  out += fmt::format(R"~(<g transform="translate(0 {})">)~", coordinate(head)) + content + "</g>";
  double y = head + height + line_height - 5;
  for (const std::string& caption : around.captions) {
    out += text("caption", 20, y, "start", caption);
    y += line_height;
  }
  return out + "</svg>\n";
}

}  // namespace tessera::chart
