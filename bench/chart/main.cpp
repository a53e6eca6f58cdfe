// tessera-chart: measures families of methods and writes a chart of them. `tessera chart` runs it (src/cli/chart.cpp).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <optional>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "bench/chart/compare.hpp"
#include "bench/chart/families.hpp"
#include "bench/chart/machine.hpp"
#include "bench/chart/output.hpp"
#include "bench/chart/session.hpp"
#include "catalogue/lookups.hpp"
#include "catalogue/method.hpp"
#include "chart/markup.hpp"
#include "cli/help.hpp"
#include "cli/text.hpp"
#include "frame/dispatch.hpp"
#include "frame/environment_file.hpp"

namespace tessera::chart {
namespace {

constexpr const char* footer = R"(Examples:
  tessera chart                                  all families on this machine: open out/chart/index.html
  tessera chart fresnel distribution --quick     two of them, in a hurry
  tessera chart ibl --env courtyard.exr          image-based lighting in an environment of yours
  tessera chart --isa avx2                       one instruction set instead of all that this CPU runs
  tessera chart --compare other/results.json     beside the run of another machine, compiler or commit
  tessera chart --from out/chart/results.json    the pages again, without measuring

Writes index.html (one page, no network needed), plots/*.svg and *.png, maps/*.png, results.json and results.csv.
Close other programs first: costs are times.

Exit status: 0 fine, 2 wrong usage, 3 an input cannot be read or is invalid, 4 an output cannot be written.)";

struct Options {
  std::vector<std::string> families, pictures;
  bool quick = false, list = false;
  std::string isa, compare, from, folder = "out/chart";
};

void list_families() {
  std::string text;
  const auto add = [&](const std::string& title, const std::string& paper) {
    text += paper.empty() ? fmt::format("  {}\n", title) : fmt::format("  {:<42}  {}\n", title, shortened(paper, 72));
  };
  for (const FamilyEntry& family : families()) {
    text += family.name + "\n";
    for (const catalogue::Method& method : catalogue::methods())
      if (method.family == family.name) add(method.title, method.paper);
    for (const catalogue::Lookup& lookup : catalogue::lookups())
      if (lookup.family == family.name) add(lookup.title, lookup.paper);
  }
  cli::print(text.empty() ? "no family is part of this build\n" : text);
}

std::vector<FamilyEntry> chosen_families(const Options& options) {
  if (options.families.empty()) return families();
  std::vector<FamilyEntry> chosen;
  std::string known;
  for (const FamilyEntry& family : families()) {
    known += (known.empty() ? "" : ", ") + family.name;
    if (std::find(options.families.begin(), options.families.end(), family.name) != options.families.end())
      chosen.push_back(family);
  }
  for (const std::string& name : options.families)
    if (std::none_of(families().begin(), families().end(), [&](const FamilyEntry& f) { return f.name == name; }))
      throw usage_error("there is no family '{}'; there are: {}", name, known.empty() ? "none in this build" : known);
  return chosen;
}

// Grey spread to RGB, what is negative or not finite as 0: as the renderer takes it.
GivenEnvironment read_given(const std::string& path, std::size_t number, const Kernels& kernels) {
  const Image image = read_environment_picture({path}, "equirect", kernels).image;
  GivenEnvironment around{fmt::format("env{}", number + 1), std::filesystem::path(path).filename().string(),
                          Image(image.width, image.height, 3)};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y)[image.channels < 3 ? 0 : c];
        around.picture.at(x, y)[c] = std::isfinite(value) && value > 0 ? value : 0.0f;
      }
  return around;
}

Results measure(const Options& options) {
  Progress progress(Progress::Show::on_terminal);
  TimedSession session(progress);
  session.quick = options.quick;
  if (options.isa.empty()) {
    for (const Kernels* kernels : built_kernels())
      if (cpu_runs(*kernels)) session.kernels.push_back(kernels);
  } else {
    session.kernels.push_back(&select_kernels(options.isa));
  }
  const std::vector<FamilyEntry> chosen = chosen_families(options);
  if (chosen.empty()) throw usage_error("no family is part of this build");
  if (!options.pictures.empty() &&
      std::none_of(chosen.begin(), chosen.end(), [](const FamilyEntry& family) { return family.name == "ibl"; }))
    throw usage_error("--env: of the families only ibl is measured in environments");
  for (const std::string& path : options.pictures)
    session.pictures.push_back(read_given(path, session.pictures.size(), *session.kernels.back()));
  prepare_folder(options.folder);  // minutes before it is written
  Results results;
  results.machine = describe_machine();
  results.machine.quick = options.quick;
  for (const Kernels* kernels : session.kernels) results.machine.isas.emplace_back(kernels->isa);
  for (const FamilyEntry& family : chosen) {
    session.progress(family.name);
    const Stopwatch watch;
    results.families.push_back(family.measure(session));
    cli::note(fmt::format("{:<14}{:>6.1f} s", family.name, watch.ms() / 1000));
  }
  return results;
}

void run(const Options& options) {
  if (options.list) {
    list_families();
    return;
  }
  // Before minutes of measuring: what cannot be read should be said at once.
  std::optional<Results> other;
  if (!options.compare.empty()) other = read_results(options.compare);
  const Results results = options.from.empty() ? measure(options) : read_results(options.from);
  write_chart(options.folder, results, other ? &*other : nullptr);
  if (other)
    for (const RatioSummary& row : summarise_ratios(results, *other))
      cli::print(fmt::format("{:<28}{:<8} cost x {:<6} ({} methods, x {} to x {})\n", cli::printable(row.family),
                             row.isa, amount(row.geometric_mean), row.methods, amount(row.lowest),
                             amount(row.highest)));
  cli::print(options.folder + "/index.html\n");
}

int start(int argc, char** argv) {
  Options options;
  CLI::App program("Measures every shading method's cost and error on this machine, and writes a page that shows both.",
                   "tessera chart");
  const auto formatter = std::make_shared<cli::HelpFormatter>();
  formatter->column_width(34);
  program.formatter(formatter);
  program.footer(footer);
  std::string names;
  for (const FamilyEntry& family : families()) names += (names.empty() ? "" : ", ") + family.name;
  program.add_option("family", options.families,
                     "Families to measure (default: all): " + (names.empty() ? "none built" : names));
  program.add_flag("--quick", options.quick, "Fewer samples and repetitions: two minutes at most");
  program.add_flag("--list", options.list, "List the families and their methods, and do nothing else");
  program
      .add_option("--isa", options.isa,
                  "Only this instruction set ('tessera isa' lists them; default: all that run here)")
      ->type_name("NAME");
  program
      .add_option("--env", options.pictures,
                  "Measure ibl in this latitude-longitude picture instead of made ones; once for each")
      ->type_name("FILE")
      ->allow_extra_args(false);
  program
      .add_option("--compare", options.compare,
                  "results.json of another run: its points as hollow markers, cost ratios")
      ->type_name("FILE");
  CLI::Option* from = program.add_option("--from", options.from, "Measure nothing: draw what this results.json holds")
                          ->type_name("FILE");
  for (const char* name : {"family", "--quick", "--isa", "--env"}) from->excludes(program.get_option(name));
  program.add_option("-o,--output", options.folder, "Folder for the page and its files")
      ->type_name("FOLDER")
      ->capture_default_str();
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    cli::print(cli::help_of(program, ""));
    return static_cast<int>(ExitStatus::ok);
  } catch (const CLI::ParseError& error) {
    throw usage_error("{}", error.what());
  }
  run(options);
  return static_cast<int>(ExitStatus::ok);
}

}  // namespace
}  // namespace tessera::chart

int main(int argc, char** argv) {
  tessera::remove_guarded_files_on_signals();
  const auto complain = [](tessera::ExitStatus status, const std::string& message) {
    tessera::cli::note("error: " + message);
    return static_cast<int>(status);
  };
  try {
    return tessera::chart::start(argc, argv);
  } catch (const tessera::Error& error) {
    return complain(error.status(), error.what());
  } catch (const std::bad_alloc&) {
    return complain(tessera::ExitStatus::input, "not enough memory");
  } catch (const std::exception& error) {
    return complain(tessera::ExitStatus::input, error.what());
  }
}
