// The cheapest of many settings that stay near the exact ones: each knob alone first, then combinations of what proved
// worth its price. Knows neither frames nor settings.
#pragma once
#include <functional>
#include <vector>

#include "frame/picture_error.hpp"

namespace tessera {

/// One choice of each knob; 0 is the exact one.
using KnobChoice = std::vector<int>;

struct KnobPoint {
  KnobChoice choice;
  PictureError error;
  double cost = 0;  // milliseconds, the least of all rounds: what disturbs a frame only makes it longer
  bool frontier =
      false;  // no other is at most as dear and at most as wrong (by the mean), and better in one of the two
};

struct KnobSearch {
  std::vector<int> choices;         // of each knob
  std::vector<KnobChoice> besides;  // to be measured in any case
  int rounds = 1;                   // timed frames of each choice
  std::size_t most = 72;            // combinations that are measured
  double limit = 0;                 // of the mean error: near it most is wanted

  std::function<PictureError(const KnobChoice&)> error;  // asked once for each choice
  std::function<double(const KnobChoice&)> cost;         // one timed frame, milliseconds
  std::function<void(bool combining, std::size_t done, std::size_t total)> progress;
};

/// Everything that was measured, the exact choice first. Choices take turns, so that a machine that slows down slows
/// all of them. Combined are the choices of each knob that, with the other knobs exact, no other is nearer than and at
/// least 5 % cheaper than; they are measured together with the single ones, again, which makes their costs comparable.
///
/// Of more than `most` combinations, two thirds of that are chosen by what the single choices promise, costs multiplied
/// and errors added up: half of them the cheapest within the limit, half along the frontier. The last third are
/// neighbours, one knob away, of what then was found on the frontier, by the same rule.
std::vector<KnobPoint> search(const KnobSearch& search);

/// The frontier without those that cost less than 2 % less than a nearer one: times repeat no better. Indices,
/// cheapest first.
std::vector<std::size_t> clear_frontier(const std::vector<KnobPoint>& points);

/// The index of the cheapest point whose errors are within limit, which the exact one always is. Points that cost at
/// most 2 % more count as equally cheap, since times repeat no better: of these the one with the smallest mean error.
std::size_t cheapest_within(const std::vector<KnobPoint>& points, const PictureError& limit);

}  // namespace tessera
