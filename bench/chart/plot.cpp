#include "bench/chart/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pareto.hpp"
#include "bench/chart/plot_frame.hpp"
#include "chart/markup.hpp"
#include "chart/style.hpp"
#include "chart/svg.hpp"

namespace tessera::chart {
namespace {

// A point that has a cost on this instruction set, and where it stands.
struct Marker {
  const Point* point;
  std::size_t number;  // in the table, from 1
  Cost cost;
  double x, y, low, high, arithmetic_y;
  bool frontier;
};

std::vector<Marker> markers_of(const Plot& plot, const std::string& isa, const PlotFrame& f) {
  const std::vector<bool> frontier = on_frontier(plot, isa);
  std::vector<Marker> markers;
  for (std::size_t i = 0; i < plot.points.size(); ++i) {
    const Point& point = plot.points[i];
    const auto cost = point.cost.find(isa);
    if (cost == point.cost.end() || !(cost->second.ns > 0)) continue;
    const Cost& c = cost->second;
    const auto x_of = [&](double ns) { return ns > 0 ? f.cost.at(ns) : f.cost.at(c.ns); };
    markers.push_back({&point, i + 1, c, x_of(c.ns), f.method.at(measured(point.method, plot.measure)), x_of(c.low),
                       x_of(c.high), f.arithmetic.at(measured(point.arithmetic, plot.measure)), frontier[i]});
  }
  return markers;
}

std::vector<Segment> staircase_of(const std::vector<Marker>& markers, const PlotFrame& f) {
  std::vector<Place> steps;
  for (const Marker& m : markers)
    if (m.frontier && std::isfinite(m.y)) steps.push_back({m.x, m.y});
  return staircase(steps, f.method.top, f.right);
}

// An arrow towards cheap and accurate, in the corner that holds the least.
std::string draw_arrow(const PlotFrame& f, const std::vector<Marker>& markers, const std::vector<Segment>& stairs,
                       std::vector<Rect>& obstacles) {
  const double width = 44 + text_width("better", f.font), height = 32, inset = 8;
  const double left = f.left + inset, right = f.right - inset - width, top = f.method.top + inset;
  const double bottom = (f.method.floor ? f.method.axis.from : f.method.bottom) - inset - height;
  Rect best{};
  double least = 1e9;
  for (const auto& [x, y] : {std::pair{left, bottom}, {left, top}, {right, top}, {right, bottom}}) {
    const Rect box{x, y, x + width, y + height};
    double load = 0;
    for (const Marker& m : markers) load += box.overlaps({m.x - 12, m.y - 12, m.x + 12, m.y + 12}) ? 3 : 0;
    for (const Segment& s : stairs) load += crosses(s, box) ? 1 : 0;
    if (load >= least) continue;
    least = load;
    best = box;
  }
  obstacles.push_back(best);
  return fmt::format(
      R"~(<g class="better" transform="translate({} {})"><path d="M32 6L10 25M10 25l1.5-10M10 25l10.5-1"/>)~"
      R"(<text x="38" y="20">better</text></g>)",
      coordinate(best.x0), coordinate(best.y0));
}

std::string describe(const Marker& m, const PlotContext& context) {
  return fmt::format("{}: {} ns, method error {}, arithmetic error {}{}", m.point->title, amount(m.cost.ns),
                     amount(measured(m.point->method, context.plot.measure)),
                     amount(measured(m.point->arithmetic, context.plot.measure)),
                     m.frontier ? ", on the Pareto frontier" : "");
}

std::string draw_points(const PlotContext& context, const PlotFrame& f, const std::vector<Marker>& markers) {
  std::string out;
  // Dominated ones first, so that the frontier lies on top.
  for (const bool frontier : {false, true})
    for (const Marker& m : markers) {
      if (m.frontier != frontier || !std::isfinite(m.y)) continue;
      const std::string x = coordinate(m.x), y = coordinate(m.y);
      out += fmt::format(R"(<g class="point {}" data-point="{}" tabindex="0" role="img" aria-label="{}">)",
                         frontier ? "frontier" : "dominated", escaped(m.point->id), escaped(describe(m, context)));
      if (m.high > m.low)
        out += fmt::format(R"(<path class="spread" d="M{0} {2}H{1}M{0} {3}v8M{1} {3}v8"/>)", coordinate(m.low),
                           coordinate(m.high), y, coordinate(m.y - 4));
      out += fmt::format(
          R"(<circle class="hit" cx="{0}" cy="{1}" r="{2}"/><circle class="dot" cx="{0}" cy="{1}" r="{3}"/>)", x, y,
          coordinate(f.marker * 2), coordinate(f.marker));
      if (std::isfinite(m.arithmetic_y)) {
        const double s = f.marker * 0.75;
        out += fmt::format(R"(<rect class="arithmetic" x="{}" y="{}" width="{}" height="{}"/>)", coordinate(m.x - s),
                           coordinate(m.arithmetic_y - s), coordinate(2 * s), coordinate(2 * s));
      }
      out += "</g>";
    }
  return out;
}

std::string draw_labels(const PlotFrame& f, const std::vector<Marker>& markers, const std::vector<Segment>& stairs,
                        std::vector<Rect> obstacles, Layout layout) {
  LabelScene scene{{f.left + 3, f.method.top + 3, f.right - 3, f.method.bottom - 2}, std::move(obstacles), stairs};
  std::vector<const Marker*> order;
  for (const bool frontier : {true, false})
    for (const Marker& m : markers)
      if (m.frontier == frontier && std::isfinite(m.y)) order.push_back(&m);
  std::vector<LabelRequest> requests;
  const double height = f.font * 1.15;
  for (const Marker* m : order) {
    if (m->high - m->low > 2 * f.marker) scene.obstacles.push_back({m->low, m->y - 4, m->high, m->y + 4});
    LabelRequest request{m->x, m->y, f.marker + 1, {}};
    if (layout == Layout::wide) request.choices.push_back({0, 0, text_width(m->point->title, f.font), height});
    request.choices.push_back({0, 0, text_width(std::to_string(m->number), f.font), height});
    requests.push_back(std::move(request));
  }
  const std::vector<Label> labels = place_labels(scene, requests);
  std::string out;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Label& label = labels[i];
    if (!label.placed) continue;
    if (label.leader) out += fmt::format(R"(<path class="leader" d="{}"/>)", path_of({label.line}));
    const bool title = layout == Layout::wide && label.choice == 0;
    // Boxes are estimated wider than most fonts are: the end that faces the point stays where it is.
    const bool right = label.box.x0 >= order[i]->x, left = label.box.x1 <= order[i]->x;
    out += fmt::format(R"(<text class="label {}" data-label="{}" x="{}" y="{}" text-anchor="{}">{}</text>)",
                       order[i]->frontier ? "frontier" : "dominated", escaped(order[i]->point->id),
                       coordinate(right  ? label.box.x0
                                  : left ? label.box.x1
                                         : (label.box.x0 + label.box.x1) / 2),
                       coordinate(label.box.y1 - f.font * 0.3),
                       right  ? "start"
                       : left ? "end"
                              : "middle",
                       title ? escaped(order[i]->point->title) : std::to_string(order[i]->number));
  }
  return out;
}

// The other run: hollow, each tied to its method's place in this run.
std::string draw_other(const PlotContext& context, const PlotFrame& f, const std::vector<Marker>& markers) {
  std::string out;
  if (context.other == nullptr) return out;
  for (const Marker& other : markers_of(*context.other, context.isa, f)) {
    if (!std::isfinite(other.y)) continue;
    for (const Marker& m : markers)
      if (m.point->id == other.point->id && std::isfinite(m.y))
        out += fmt::format(R"(<path class="moved" d="M{} {}L{} {}"/>)", coordinate(other.x), coordinate(other.y),
                           coordinate(m.x), coordinate(m.y));
    out += fmt::format(R"(<circle class="other" data-point="{}" cx="{}" cy="{}" r="{}"/>)", escaped(other.point->id),
                       coordinate(other.x), coordinate(other.y), coordinate(f.marker));
  }
  return out;
}

std::string draw_legend(const PlotContext& context, const PlotFrame& f, Layout layout) {
  const bool narrow = layout == Layout::narrow;
  struct Entry {
    const char* mark;
    std::string words;
  };
  std::vector<Entry> entries = {
      {R"(<g class="point frontier"><circle class="dot" cx="8" cy="-4" r="5"/></g>)",
       narrow ? "on the frontier" : "on the Pareto frontier"},
      {R"(<g class="point dominated"><circle class="dot" cx="8" cy="-4" r="5"/></g>)", "dominated"},
      {R"(<path class="spread" d="M0 -4H16M0 -8v8M16 -8v8"/>)",
       narrow ? "repetitions" : "lowest to highest repetition"},
      {R"(<rect class="arithmetic" x="4" y="-8" width="8" height="8"/>)", "arithmetic error"}};
  if (context.other != nullptr)
    entries.push_back({R"(<circle class="other" cx="8" cy="-4" r="5"/>)", context.other_name});
  std::string out = R"(<g class="legend">)";
  double x = f.left, y = f.legend_y;
  if (narrow) x = 10;
  for (const Entry& entry : entries) {
    const double width = 24 + text_width(entry.words, f.font) + 10;
    if (x + width > f.width && x > f.left) {
      x = narrow ? 10 : f.left;
      y += f.font * 1.5;
    }
    out += fmt::format(R"~(<g transform="translate({} {})">{}<text x="22">{}</text></g>)~", coordinate(x),
                       coordinate(y), entry.mark, escaped(entry.words));
    x += width;
  }
  return out + "</g>";
}

}  // namespace

std::vector<bool> on_frontier(const Plot& plot, const std::string& isa) {
  std::vector<Tradeoff> points;
  for (const Point& point : plot.points) {
    const auto cost = point.cost.find(isa);
    const double error = measured(point.method, plot.measure);
    // Below the floor all are equally exact.
    points.push_back({cost == point.cost.end() ? NAN : cost->second.ns, error <= exact_below ? 0 : error});
  }
  std::vector<bool> on(plot.points.size());
  for (const std::size_t i : pareto_frontier(points)) on[i] = std::isfinite(points[i].error);
  return on;
}

Drawing draw_plot(const PlotContext& context, Layout layout) {
  const PlotFrame f = frame_of(context, layout);
  const std::vector<Marker> markers = markers_of(context.plot, context.isa, f);
  const std::vector<Segment> stairs = staircase_of(markers, f);
  std::string out = draw_axes(context, f, layout);
  if (!stairs.empty()) {
    out += fmt::format(R"(<path class="beaten" d="{}V{}Z"/>)", path_of(stairs), coordinate(f.method.top));
    out += fmt::format(R"(<path class="stairs" d="{}"/>)", path_of(stairs));
  }
  std::vector<Rect> obstacles;
  out += draw_arrow(f, markers, stairs, obstacles);
  out += draw_other(context, f, markers);
  out += draw_labels(f, markers, stairs, obstacles, layout);
  out += draw_points(context, f, markers);
  out += draw_legend(context, f, layout);
  return {out, f.width, f.height};
}

std::string caption_of(const Machine& m, const std::string& isa) {
  std::string text = m.cpu;
  if (m.clock_ghz > 0) text += fmt::format(" at {:.2f} GHz", m.clock_ghz);
  if (!isa.empty()) text += ", " + isa;
  return text + " · " + m.compiler + " · commit " + m.commit + " · " + m.date + (m.quick ? " · quick run" : "");
}

std::string flags_of(const Machine& machine, const std::string& isa) {
  // "common flags; sse42: its flags; avx2: its flags"
  const std::string all = machine.flags + ";", key = "; " + isa + ": ";
  std::string flags = all.substr(0, all.find(';'));
  const std::size_t at = all.find(key);
  if (at != std::string::npos)
    flags.append(1, ' ').append(all, at + key.size(), all.find(';', at + 1) - at - key.size());
  return flags;
}

std::string standalone_plot(const PlotContext& context, const std::string& family_title) {
  const Drawing drawing = draw_plot(context, Layout::wide);
  constexpr double head = 70, foot = 46;
  const double height = head + drawing.height + foot;
  const auto line = [](const char* cls, double y, const std::string& words) {
    return fmt::format(R"(<text class="{}" x="20" y="{}">{}</text>)", cls, coordinate(y), escaped(words));
  };
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}">)",
                     coordinate(drawing.width), coordinate(height)) +
         "<style>" + plot_css + "</style><rect class=\"paper\" width=\"100%\" height=\"100%\"/>" +
         line("title", 28, family_title + ": " + context.plot.title) +
         line("subtitle", 50, context.plot.domain + " · against " + context.plot.truth) +
         fmt::format(R"~(<g transform="translate(0 {})">)~", coordinate(head)) + drawing.content + "</g>" +
         line("caption", height - 30, caption_of(context.machine, context.isa)) +
         line("caption", height - 13, flags_of(context.machine, context.isa)) + "</svg>\n";
}

}  // namespace tessera::chart
