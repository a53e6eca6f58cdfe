#include "frame/knob_search.hpp"

#include <algorithm>
#include <limits>

#include "base/pareto.hpp"

namespace tessera {
namespace {

constexpr double equally_cheap = 1.02;
constexpr double surely_cheaper = 1.05;  // the few frames of the first measurement tell no less apart

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Adds a choice unless it is there, and returns its index.
std::size_t add(std::vector<KnobPoint>& points, const KnobChoice& choice) {
  const auto found =
      std::find_if(points.begin(), points.end(), [&](const KnobPoint& point) { return point.choice == choice; });
  if (found != points.end()) return static_cast<std::size_t>(found - points.begin());
  points.push_back({choice, {}, 0, false});
  return points.size() - 1;
}

// Errors of the points from first_new on, and the cost of all.
void measure(const KnobSearch& s, std::vector<KnobPoint>& points, std::size_t first_new, bool combining) {
  const auto rounds = static_cast<std::size_t>(s.rounds);
  const std::size_t total = points.size() - first_new + points.size() * rounds;
  std::size_t done = 0;
  const auto count = [&] {
    if (s.progress) s.progress(combining, ++done, total);
  };
  for (std::size_t i = first_new; i < points.size(); ++i, count()) points[i].error = s.error(points[i].choice);
  std::vector<std::vector<double>> times(points.size());
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < points.size(); ++i, count()) times[i].push_back(s.cost(points[i].choice));
  for (std::size_t i = 0; i < points.size(); ++i) points[i].cost = median(std::move(times[i]));
}

// Whether b, a choice of the same knob, makes a not worth combining.
bool is_pointless_beside(const KnobPoint& a, const KnobPoint& b) {
  if (b.error.mean == a.error.mean) return b.cost != a.cost ? b.cost < a.cost : b.choice < a.choice;
  return b.error.mean < a.error.mean && b.cost * surely_cheaper < a.cost;
}

// Every choice that takes for each knob one of worthwhile[knob].
std::vector<KnobChoice> combinations(const std::vector<std::vector<int>>& worthwhile) {
  std::vector<KnobChoice> all = {{}};
  for (const std::vector<int>& choices : worthwhile) {
    std::vector<KnobChoice> longer;
    for (const KnobChoice& begun : all)
      for (const int choice : choices) {
        longer.push_back(begun);
        longer.back().push_back(choice);
      }
    all = std::move(longer);
  }
  return all;
}

}  // namespace

std::vector<KnobPoint> search(const KnobSearch& s) {
  const KnobChoice exact(s.choices.size(), 0);
  std::vector<KnobPoint> points;
  add(points, exact);
  std::vector<std::vector<std::size_t>> alone(s.choices.size());  // indices of each knob's choices
  for (std::size_t knob = 0; knob < s.choices.size(); ++knob)
    for (int k = 0; k < s.choices[knob]; ++k) {
      KnobChoice choice = exact;
      choice[knob] = k;
      alone[knob].push_back(add(points, choice));
    }
  for (const KnobChoice& choice : s.besides) add(points, choice);
  measure(s, points, 0, false);

  std::vector<std::vector<int>> worthwhile(s.choices.size());
  for (std::size_t knob = 0; knob < s.choices.size(); ++knob)
    for (const std::size_t i : alone[knob])
      if (std::none_of(alone[knob].begin(), alone[knob].end(),
                       [&](std::size_t j) { return is_pointless_beside(points[i], points[j]); }))
        worthwhile[knob].push_back(points[i].choice[knob]);
  const std::size_t first_new = points.size();
  for (const KnobChoice& choice : combinations(worthwhile)) add(points, choice);
  measure(s, points, first_new, true);

  std::vector<Tradeoff> tradeoffs;
  tradeoffs.reserve(points.size());
  for (const KnobPoint& point : points) tradeoffs.push_back({point.cost, point.error.mean});
  for (const std::size_t i : pareto_frontier(tradeoffs)) points[i].frontier = true;
  return points;
}

std::size_t cheapest_within(const std::vector<KnobPoint>& points, const PictureError& limit) {
  const auto within = [&](const KnobPoint& point) {
    return point.error.mean <= limit.mean && point.error.percentile99 <= limit.percentile99;
  };
  double least = std::numeric_limits<double>::infinity();
  for (const KnobPoint& point : points)
    if (within(point)) least = std::min(least, point.cost);
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const KnobPoint &point = points[i], &chosen = points[best];
    if (!within(point) || point.cost > least * equally_cheap) continue;
    const bool chosen_is_dear = chosen.cost > least * equally_cheap;
    if (chosen_is_dear || point.error.mean < chosen.error.mean ||
        (point.error.mean == chosen.error.mean && point.cost < chosen.cost))
      best = i;
  }
  return best;
}

}  // namespace tessera
