// What a chart holds, and how a family of methods measures itself for one. Each family is one file,
// bench/chart/family_NAME.cpp (NAME of [a-z]), with one function `Family measure_NAME(Session&)`: that is all it takes
// to be found (cmake/chart.cmake). The pages, plots and files are made elsewhere and know no family.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/image.hpp"
#include "kernels/interface.hpp"

namespace tessera::chart {

/// Time of one evaluation, nanoseconds: median, and the lowest and highest of the repetitions.
struct Cost {
  double ns = 0, low = 0, high = 0;
  int repetitions = 0;
};

/// An error over a domain, which the family states in words. All three in the same unit.
struct Error {
  double max = 0, mean = 0, rms = 0;
};

/// Error over two parameters: values[row * columns.size() + column], drawn as a picture. Signed where it can be.
struct ErrorMap {
  std::string title, column_name, row_name;  // "NoV", "roughness"
  std::vector<double> columns, rows;
  std::vector<double> values;
};

/// One method on one plot.
struct Point {
  std::string id;     // stable, of [a-z0-9-]
  std::string title;  // as people call it
  std::string formula, paper, file, fails, note;
  std::map<std::string, Cost> cost;  // by instruction set ("avx2")
  Error method;                      // the formula in double against truth
  Error arithmetic;                  // the kernel in float against the formula in double
  std::vector<ErrorMap> maps;
  std::map<std::string, double>
      extra;  // further columns of the table: "reciprocity error", "bytes", "instructions avx2"
};

/// Which of an Error's numbers a plot shows.
enum class Measure { max, mean, rms };

/// One scatter plot: cost against method error.
struct Plot {
  std::string id, title;
  std::string error_name;  // the axis, with its measure and its unit: "largest error of reflectance"
  std::string domain;      // over what: "F0 = 0.04, VoH in [0,1]"
  std::string truth;       // against what
  std::vector<Point> points;
  Measure measure = Measure::max;  // what error_name speaks of
};

struct Family {
  std::string id, title;
  std::string about;                  // a paragraph: what is compared and how it was measured
  std::vector<std::string> findings;  // what the numbers show, in words, with the numbers of this run in them
  std::vector<Plot> plots;
};

/// A person's environment: an equirectangular picture, RGB, finite, not negative.
struct GivenEnvironment {
  std::string id, title;
  Image picture;
};

/// What a family gets to work with.
class Session {
 public:
  virtual ~Session() = default;
  std::vector<GivenEnvironment> pictures;  // --env: environments to measure in, instead of a family's own
  bool quick = false;                      // --quick: fewer samples, coarser maps; the same methods
  std::vector<const Kernels*> kernels;     // the instruction sets to time, widest last; errors are those of any of them
  /// Time per evaluation of body, which does `evaluations` of them. Through Google Benchmark, on one thread.
  virtual Cost time(std::uint64_t evaluations, const std::function<void()>& body) = 0;
  /// For a person who watches: "fresnel: exact conductor".
  virtual void progress(const std::string& what) = 0;
};

Family measure_fresnel(Session&);
Family measure_distribution(Session&);
Family measure_masking(Session&);
Family measure_diffuse(Session&);
Family measure_energy(Session&);
Family measure_function(Session&);
Family measure_dfg(Session&);
Family measure_sampling(Session&);
Family measure_ibl(Session&);

/// Times a term (kernels/terms.hpp) on every instruction set of the session, over arrays that lie in the first-level
/// cache. inputs: as many equally long arrays as it takes.
std::map<std::string, Cost> time_term(Session&, const std::string& term, const std::vector<std::vector<float>>& inputs,
                                      const float* table = nullptr, int table_size = 0);

}  // namespace tessera::chart
