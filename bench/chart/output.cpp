#include "bench/chart/output.hpp"

#include <filesystem>

#include "base/error.hpp"
#include "bench/chart/compare.hpp"
#include "bench/chart/error_map.hpp"
#include "bench/chart/page.hpp"
#include "bench/chart/plot.hpp"
#include "bench/chart/raster.hpp"
#include "io/output_file.hpp"

namespace tessera::chart {
namespace {

namespace fs = std::filesystem;

constexpr double plot_scale = 2, map_scale = 1.5;  // pixels of a PNG per unit of its SVG: sharp on today's screens

void write_file(const fs::path& path, const std::string& content) {
  OutputFile file(path.string());
  file.write(content.data(), content.size());
  file.commit();
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw output_error("{}: the folder cannot be made: {}", folder.string(), error.message());
}

// Error maps are named by their titles, which are free text.
std::string file_part(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    const char kept = plain ? c : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : '-';
    if (kept != '-' || (!out.empty() && out.back() != '-')) out += kept;
    if (out.size() == 60) break;
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out;
}

void write_maps(const fs::path& folder, const Plot& plot, const std::string& name) {
  for (const Point& point : plot.points)
    for (const ErrorMap& map : point.maps) {
      if (map.columns.empty() || map.rows.empty()) continue;
      std::vector<const ErrorMap*> alike;
      for (const Point& other : plot.points)
        for (const ErrorMap& candidate : other.maps)
          if (candidate.title == map.title) alike.push_back(&candidate);
      make_folder(folder);
      write_file(folder / (name + "-" + point.id + "-" + file_part(map.title) + ".png"),
                 png_of_svg(standalone_map(map, scale_of(alike), point.title, map.title), map_scale));
    }
}

}  // namespace

void write_chart(const std::string& folder, const Results& results, const Results* other) {
  const fs::path top = folder;
  make_folder(top);
  write_file(top / "results.json", to_json(results));
  write_file(top / "results.csv", to_csv(results));
  for (const Family& family : results.families)
    for (const Plot& plot : family.plots) {
      const std::string name = family.id + "-" + plot.id;
      for (const std::string& isa : results.machine.isas) {
        const PlotContext context{results.machine, plot, isa,
                                  other == nullptr ? nullptr : matching_plot(*other, family.id, plot.id),
                                  other == nullptr ? "" : name_of_run(other->machine)};
        const std::string svg = standalone_plot(context, family.title);
        make_folder(top / "plots");
        write_file(top / "plots" / (name + "-" + isa + ".svg"), svg);
        write_file(top / "plots" / (name + "-" + isa + ".png"), png_of_svg(svg, plot_scale));
      }
      write_maps(top / "maps", plot, name);
    }
  write_file(top / "index.html", make_page(results, other));
}

}  // namespace tessera::chart
