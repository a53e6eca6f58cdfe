#include "bench/chart/output.hpp"

#include <filesystem>
#include <functional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "bench/chart/compare.hpp"
#include "bench/chart/error_map.hpp"
#include "bench/chart/page.hpp"
#include "bench/chart/plot.hpp"
#include "bench/chart/raster.hpp"
#include "io/image_file.hpp"
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

void write_picture(const fs::path& path, const std::string& svg, double scale) {
  const Picture picture = picture_of_svg(svg, scale);
  write_png(path.string(), picture.width, picture.height, 3, picture.rgb.data());
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

// Drawing takes longer than writing, so all files are jobs for every core.
using Jobs = std::vector<std::function<void()>>;

void add_maps(Jobs& jobs, const fs::path& folder, const Plot& plot, const std::string& name) {
  for (const MapGroup& group : map_groups(plot))
    for (const MapGroup::Member& member : group.members) {
      std::string file = name + "-" + member.point->id;
      if (member.point->maps.size() > 1) file.append(1, '-').append(file_part(member.map->title));
      jobs.emplace_back([=, path = folder / (file + ".png"), scale = group.scale] {
        const std::string& title = member.map->title;
        write_picture(
            path,
            standalone_map(*member.map, scale, member.point->title, title == member.point->title ? "error" : title),
            map_scale);
      });
    }
}

}  // namespace

void prepare_folder(const std::string& folder) {
  make_folder(folder);
  const OutputFile trial((fs::path(folder) / "results.json").string());  // never committed
}

void write_chart(const std::string& folder, const Results& results, const Results* other) {
  const fs::path top = folder;
  make_folder(top);
  write_file(top / "results.json", to_json(results));
  write_file(top / "results.csv", to_csv(results));
  make_folder(top / "plots");
  make_folder(top / "maps");
  Jobs jobs;
  for (const Family& family : results.families)
    for (const Plot& plot : family.plots) {
      // Ids of plots often begin with their family's.
      const std::string name = plot.id.rfind(family.id, 0) == 0 ? plot.id : family.id + "-" + plot.id;
      const Plot* theirs = other == nullptr ? nullptr : matching_plot(*other, family.id, plot.id);
      for (const std::string& isa : results.machine.isas)
        jobs.emplace_back([&, name, theirs, isa] {
          const PlotContext context{results.machine, plot, isa, theirs,
                                    other == nullptr ? "" : name_of_run(other->machine)};
          const std::string svg = standalone_plot(context, family.title), file = name + "-" + isa;
          write_file(top / "plots" / (file + ".svg"), svg);
          write_picture(top / "plots" / (file + ".png"), svg, plot_scale);
        });
      add_maps(jobs, top / "maps", plot, name);
    }
  parallel_for(jobs.size(), [&](std::size_t i) { jobs[i](); });
  write_file(top / "index.html", make_page(results, other));
}

}  // namespace tessera::chart
