// The parts that plots are drawn from.
#pragma once
#include <string>
#include <vector>

#include "chart/labels.hpp"

namespace tessera::chart {

/// Elements with a class of style.hpp.
std::string line(const char* cls, double x0, double y0, double x1, double y1);
std::string text(const char* cls, double x, double y, const char* anchor, const std::string& words);
std::string rectangle(const char* cls, const Rect& rect);
/// Words that read upwards, centred on y.
std::string upright_text(const char* cls, double x, double y, const std::string& words);

/// The value of a path's "d".
std::string path_of(const std::vector<Segment>& segments);

struct Place {
  double x, y;
};
/// A staircase from the first point's height `top` down over all points, in the order of x, to `right`: between two of
/// a frontier's points there is nothing to be had.
std::vector<Segment> staircase(std::vector<Place> points, double top, double right);

/// What stands around a plot in a file of its own.
struct Lettering {
  std::string title, subtitle;
  std::vector<std::string> captions;  // lines below
};
/// A whole SVG file around content of that size.
std::string standalone(const std::string& content, double width, double height, const Lettering& around);

}  // namespace tessera::chart
