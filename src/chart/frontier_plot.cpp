#include "chart/frontier_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "chart/axis.hpp"
#include "chart/markup.hpp"

namespace tessera::chart {
namespace {

constexpr double width = 960, left = 84, right = width - 16, top = 10, bottom = 470, font = 13, radius = 6.5;
constexpr double floor_band = 30;  // pixels at the bottom, for what is exact
constexpr double height = bottom + 72;
constexpr double most_words = 300;  // pixels of a name

struct Frame {
  LogAxis cost, error;
  double axis_bottom;  // of the error axis; below it lies the floor, if there is one
  double exact_below;

  [[nodiscard]] double y(double value) const { return value < exact_below ? bottom - floor_band / 2 : error.at(value); }
};

Frame frame_of(const FrontierPlot& plot) {
  std::vector<double> costs, errors;
  bool floor = false;
  for (const FrontierPoint& p : plot.points) {
    costs.push_back(p.cost);
    if (p.error < plot.exact_below)
      floor = true;
    else
      errors.push_back(p.error);
  }
  if (plot.limit >= plot.exact_below) errors.push_back(plot.limit);
  if (errors.empty()) errors = {plot.exact_below, 1};
  const double axis_bottom = floor ? bottom - floor_band : bottom;
  return {axis_over(costs, 0.3, 0.08, left, right), axis_over(errors, 1, 0.08, axis_bottom, top), axis_bottom,
          plot.exact_below};
}

std::string draw_axes(const FrontierPlot& plot, const Frame& f) {
  std::string out = rectangle("panel", {left, top, right, bottom});
  for (const Tick& tick : f.error.ticks()) {
    const double y = f.error.at(tick.value);
    out += line(tick.major ? "grid" : "grid minor", left, y, right, y);
    if (tick.major) out += text("tick", left - 6, y + font * 0.35, "end", tick.label);
  }
  for (const Tick& tick : f.cost.ticks()) {
    const double x = f.cost.at(tick.value);
    out += line(tick.major ? "grid" : "grid minor", x, top, x, bottom);
    if (tick.major) out += text("tick", x, bottom + font * 1.4, "middle", tick.label);
  }
  if (f.axis_bottom < bottom) {
    out += line("floor", left, f.axis_bottom, right, f.axis_bottom);
    out += text("tick", left - 6, bottom - floor_band / 2 + font * 0.35, "end", "exact");
  }
  out += text("axis", (left + right) / 2, bottom + font * 2.8, "middle", plot.cost_name);
  return out + upright_text("axis", font * 1.3, (top + bottom) / 2, plot.error_name);
}

// The line of the limit with its name, and what lies beyond it.
std::string draw_limit(const FrontierPlot& plot, const Frame& f, std::vector<Rect>& obstacles) {
  if (!(plot.limit > 0)) return {};
  const double y = f.y(plot.limit), room = text_width(plot.limit_name, font);
  const Rect name{right - 8 - room, y - font * 1.5, right - 8, y - 2};
  obstacles.push_back(name);
  return rectangle("beyond", {left, top, right, y}) + line("limit", left, y, right, y) +
         text("limit-name", name.x1, y - font * 0.45, "end", plot.limit_name);
}

std::string draw_point(const FrontierPoint& p, const Frame& f) {
  const std::string x = coordinate(f.cost.at(p.cost)), y = coordinate(f.y(p.error));
  std::string out =
      fmt::format(R"(<g class="point {}"><title>{}: cost {}, error {}</title>)", p.frontier ? "frontier" : "dominated",
                  escaped(p.name), amount(p.cost), amount(p.error));
  if (p.chosen)
    out += fmt::format(R"(<circle class="chosen-ring" cx="{}" cy="{}" r="{}"/>)", x, y, coordinate(radius + 3.5));
  return out + fmt::format(R"(<circle class="dot" cx="{}" cy="{}" r="{}"/></g>)", x, y,
                           coordinate(p.frontier || p.chosen ? radius : radius - 1.5));
}

std::string draw_names(const FrontierPlot& plot, const Frame& f, const std::vector<Segment>& lines,
                       std::vector<Rect> obstacles) {
  // The choice finds its place first, then what is notable, then the frontier.
  std::vector<const FrontierPoint*> order;
  const auto rank = [](const FrontierPoint& p) { return p.chosen ? 0 : p.notable ? 1 : 2; };
  for (const FrontierPoint& p : plot.points) {
    if (p.chosen || p.frontier || p.notable)
      order.push_back(&p);
    else
      obstacles.push_back(
          {f.cost.at(p.cost) - radius, f.y(p.error) - radius, f.cost.at(p.cost) + radius, f.y(p.error) + radius});
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](const FrontierPoint* a, const FrontierPoint* b) { return rank(*a) < rank(*b); });
  std::vector<LabelRequest> requests;
  const auto size_of = [](const std::string& words) { return Rect{0, 0, text_width(words, font), font * 1.15}; };
  for (const FrontierPoint* p : order) {
    LabelRequest request{f.cost.at(p->cost), f.y(p->error), radius + (p->chosen ? 5 : 1), {}};
    // Long names of many points would cover the plot.
    const bool in_words = p->chosen || p->notable || text_width(p->name, font) < most_words;
    if (in_words) request.choices.push_back(size_of(p->name));
    request.choices.push_back(size_of(p->mark));
    requests.push_back(std::move(request));
  }
  const std::vector<Label> labels =
      place_labels({{left + 3, top + 3, right - 3, bottom - 2}, std::move(obstacles), lines}, requests);
  std::string out;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Label& label = labels[i];
    if (!label.placed) continue;
    if (label.leader) out += fmt::format(R"(<path class="leader" d="{}"/>)", path_of({label.line}));
    // Boxes are estimated wider than most fonts are: the end that faces the point stays where it is.
    const bool after = label.box.x0 >= requests[i].x, before = label.box.x1 <= requests[i].x;
    const double x = after ? label.box.x0 : before ? label.box.x1 : (label.box.x0 + label.box.x1) / 2;
    out += text(order[i]->chosen     ? "label chosen"
                : order[i]->frontier ? "label frontier"
                                     : "label dominated",
                x, label.box.y1 - font * 0.3,
                after    ? "start"
                : before ? "end"
                         : "middle",
                label.choice + 1 < requests[i].choices.size() ? order[i]->name : order[i]->mark);
  }
  return out;
}

std::string draw_legend() {
  const std::pair<const char*, const char*> entries[] = {
      {R"(<g class="point frontier"><circle class="dot" cx="8" cy="-4" r="5"/></g>)", "on the Pareto frontier"},
      {R"(<g class="point dominated"><circle class="dot" cx="8" cy="-4" r="4"/></g>)", "dominated"},
      {R"(<g class="point frontier"><circle class="dot" cx="8" cy="-4" r="4"/>)"
       R"(<circle class="chosen-ring" cx="8" cy="-4" r="7.5"/></g>)",
       "chosen: the cheapest within the limit"}};
  std::string out = R"(<g class="legend">)";
  double x = left;
  for (const auto& [mark, words] : entries) {
    out += fmt::format(R"~(<g transform="translate({} {})">{}<text x="22">{}</text></g>)~", coordinate(x),
                       coordinate(height - 10), mark, words);
    x += 24 + text_width(words, font) + 14;
  }
  return out + "</g>";
}

}  // namespace

std::string draw(const FrontierPlot& plot, const Lettering& around) {
  const Frame f = frame_of(plot);
  std::vector<Place> steps;
  for (const FrontierPoint& p : plot.points)
    if (p.frontier) steps.push_back({f.cost.at(p.cost), f.y(p.error)});
  const std::vector<Segment> stairs = staircase(steps, top, right);
  std::string out = draw_axes(plot, f);
  std::vector<Rect> obstacles;
  out += draw_limit(plot, f, obstacles);
  std::vector<Segment> lines = stairs;
  if (plot.limit > 0) lines.push_back({left, f.y(plot.limit), right, f.y(plot.limit)});
  if (!stairs.empty()) out += fmt::format(R"(<path class="stairs" d="{}"/>)", path_of(stairs));
  out += draw_names(plot, f, lines, obstacles);
  // Dominated ones first, so that the frontier lies on top.
  for (const bool frontier : {false, true})
    for (const FrontierPoint& p : plot.points)
      if ((p.frontier || p.chosen) == frontier) out += draw_point(p, f);
  return standalone(out + draw_legend(), width, height, around);
}

}  // namespace tessera::chart
