#include "frame/knob_search.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "base/pareto.hpp"

namespace tessera {
namespace {

constexpr double equally_cheap = 1.02;
constexpr double surely_cheaper = 1.05;  // the few frames of the first measurement tell no less apart

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
  for (KnobPoint& point : points) point.cost = std::numeric_limits<double>::infinity();
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < points.size(); ++i, count())
      points[i].cost = std::min(points[i].cost, s.cost(points[i].choice));
}

// Whether b, a choice of the same knob, makes a not worth combining.
bool is_pointless_beside(const KnobPoint& a, const KnobPoint& b) {
  if (b.error.mean == a.error.mean) return b.cost != a.cost ? b.cost < a.cost : b.choice < a.choice;
  return b.error.mean < a.error.mean && b.cost * surely_cheaper < a.cost;
}

// What choices will probably cost and err by, from each knob's choices with the other knobs exact.
class Forecast {
 public:
  Forecast(const std::vector<KnobPoint>& points, const std::vector<std::vector<std::size_t>>& alone)
      : points_(points), alone_(alone) {}

  // From what was measured of `from`.
  [[nodiscard]] Tradeoff of(const KnobChoice& choice, const KnobPoint& from) const {
    Tradeoff result{from.cost, from.error.mean};
    for (std::size_t knob = 0; knob < choice.size(); ++knob) {
      const KnobPoint& now = single(knob, choice[knob]);
      const KnobPoint& before = single(knob, from.choice[knob]);
      result.cost *= now.cost / before.cost;
      result.error += now.error.mean - before.error.mean;
    }
    result.error = std::max(result.error, 0.0);
    return result;
  }

 private:
  [[nodiscard]] const KnobPoint& single(std::size_t knob, int choice) const {
    return points_[alone_[knob][static_cast<std::size_t>(choice)]];
  }
  const std::vector<KnobPoint>& points_;
  const std::vector<std::vector<std::size_t>>& alone_;
};

// Every choice that takes for each knob one of worthwhile[knob]; at most 2^16 of them, the most exact ones.
std::vector<KnobChoice> combinations(const std::vector<std::vector<int>>& worthwhile) {
  constexpr std::size_t most = std::size_t{1} << 16;
  std::vector<KnobChoice> all = {{}};
  for (const std::vector<int>& choices : worthwhile) {
    std::vector<KnobChoice> longer;
    for (const int choice : choices)
      for (const KnobChoice& begun : all) {
        if (longer.size() == most) break;
        longer.push_back(begun);
        longer.back().push_back(choice);
      }
    all = std::move(longer);
  }
  return all;
}

// Which of the promised tradeoffs to measure, `most` of them: half are the cheapest within the limit, half lie all
// along the frontier, then along the frontier of the others, and so on.
std::vector<std::size_t> most_promising(std::vector<Tradeoff> promised, double limit, std::size_t most) {
  std::vector<std::size_t> within;
  for (std::size_t i = 0; i < promised.size(); ++i)
    if (promised[i].error <= limit) within.push_back(i);
  std::stable_sort(within.begin(), within.end(),
                   [&](std::size_t a, std::size_t b) { return promised[a].cost < promised[b].cost; });
  within.resize(std::min(within.size(), most / 2));
  std::vector<std::size_t> best;
  const auto take = [&](std::size_t i) {
    best.push_back(i);
    promised[i].cost = std::numeric_limits<double>::quiet_NaN();  // takes no part any more
  };
  for (const std::size_t i : within) take(i);
  while (best.size() < most) {
    const std::vector<std::size_t> layer = pareto_frontier(promised);
    if (layer.empty()) break;
    const std::size_t count = std::min(layer.size(), most - best.size());
    for (std::size_t k = 0; k < count; ++k) take(layer[k * layer.size() / count]);
  }
  return best;
}

void mark_frontier(std::vector<KnobPoint>& points) {
  std::vector<Tradeoff> tradeoffs;
  tradeoffs.reserve(points.size());
  for (KnobPoint& point : points) {
    tradeoffs.push_back({point.cost, point.error.mean});
    point.frontier = false;
  }
  for (const std::size_t i : pareto_frontier(tradeoffs)) points[i].frontier = true;
}

// Choices that differ from a point of the frontier in one knob and are not measured yet, with what they promise.
void forecast_neighbours(const std::vector<KnobPoint>& points, const std::vector<std::vector<int>>& worthwhile,
                         const Forecast& forecast, std::vector<KnobChoice>& choices, std::vector<Tradeoff>& tradeoffs) {
  std::set<KnobChoice> known;
  for (const KnobPoint& point : points) known.insert(point.choice);
  for (const KnobPoint& point : points) {
    if (!point.frontier) continue;
    for (std::size_t knob = 0; knob < worthwhile.size(); ++knob)
      for (const int k : worthwhile[knob]) {
        KnobChoice choice = point.choice;
        choice[knob] = k;
        if (!known.insert(choice).second) continue;
        choices.push_back(choice);
        tradeoffs.push_back(forecast.of(choice, point));
      }
  }
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
  const std::vector<KnobPoint> singles = points;  // as they were measured together
  const Forecast forecast(singles, alone);
  std::vector<KnobChoice> all = combinations(worthwhile);
  const bool too_many = all.size() > s.most;
  if (too_many) {
    std::vector<Tradeoff> promised;
    promised.reserve(all.size());
    for (const KnobChoice& choice : all) promised.push_back(forecast.of(choice, singles[0]));
    std::vector<KnobChoice> promising;
    for (const std::size_t i : most_promising(std::move(promised), s.limit, s.most - s.most / 3))
      promising.push_back(all[i]);
    all = std::move(promising);
  }
  std::size_t first_new = points.size();
  for (const KnobChoice& choice : all) add(points, choice);
  measure(s, points, first_new, true);
  mark_frontier(points);
  if (too_many) {
    std::vector<KnobChoice> neighbours;
    std::vector<Tradeoff> promised;
    forecast_neighbours(points, worthwhile, forecast, neighbours, promised);
    first_new = points.size();
    for (const std::size_t i : most_promising(std::move(promised), s.limit, s.most / 3)) add(points, neighbours[i]);
    if (points.size() > first_new) measure(s, points, first_new, true);
    mark_frontier(points);
  }
  return points;
}

std::vector<std::size_t> clear_frontier(const std::vector<KnobPoint>& points) {
  std::vector<std::size_t> order, clear;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].frontier) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].error.mean != points[b].error.mean ? points[a].error.mean < points[b].error.mean
                                                        : points[a].cost < points[b].cost;
  });
  double last = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (points[i].cost * equally_cheap > last) continue;
    last = points[i].cost;
    clear.push_back(i);
  }
  std::reverse(clear.begin(), clear.end());
  return clear;
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
