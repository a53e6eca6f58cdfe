#include "cli/report.hpp"

#include <sys/resource.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/text.hpp"
#include "io/output_file.hpp"

namespace tessera::cli {
namespace {

using Json = nlohmann::ordered_json;

struct RunStage {
  const char *key, *words;
  double ms;
};

std::array<RunStage, 7> stages_of(const RunReport& r) {
  return {{{"load", "read the input", r.load_ms},
           {"environment", "prefilter the environment", r.environment_ms},
           {"prepare", "tables and textures", r.frame.prepare_ms},
           {"geometry", "vertices, triangles, bins", r.frame.geometry_ms},
           {"tiles", "rasterize and shade tiles", r.frame.tiles_ms},
           {"encode", "tone map and encode", r.encode_ms},
           {"write", "compress and write", r.write_ms}}};
}

std::uint64_t peak_memory() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::uint64_t>(usage.ru_maxrss) * 1024 : 0;
}

}  // namespace

void tell(const RunReport& r) {
  std::string text = fmt::format("{}: {} x {}, {} samples per pixel, {} on {} thread{}", printable(r.output), r.width,
                                 r.height, r.samples, r.frame.isa, r.frame.threads, r.frame.threads == 1 ? "" : "s");
  if (r.scene_triangles != 0) text += fmt::format(", {} triangles", grouped(r.scene_triangles));
  text += "\n";
  for (const RunStage& stage : stages_of(r)) text += fmt::format("  {:<28}{:>10.1f} ms\n", stage.words, stage.ms);
  text += fmt::format("  {:<28}{:>10.1f} ms\n", "in all", r.total_ms);
  std::fputs(text.c_str(), stderr);
}

void write_statistics(const std::string& path, const RunReport& r) {
  const FrameStatistics& f = r.frame;
  Json j;
  j["tessera"] = TESSERA_VERSION;
  j["command"] = r.command;
  j["scene"] = r.scene;
  j["output"] = r.output;
  j["width"] = r.width;
  j["height"] = r.height;
  j["samples"] = r.samples;
  j["isa"] = f.isa;
  j["threads"] = f.threads;
  j["pixel_hash"] = fmt::format("{:016x}", f.pixel_hash);  // of the linear picture, whatever the file's format
  for (const RunStage& stage : stages_of(r)) j["stages_ms"][stage.key] = stage.ms;
  j["stages_ms"]["total"] = r.total_ms;
  for (std::size_t k = 0; k < stage_names.size(); ++k)
    j[int(k) < first_tile_stage ? "geometry_stages_thread_ms" : "tile_stages_thread_ms"][stage_names[k]] =
        f.stage_ms[k];
  j["triangles"] = {{"in", f.geometry.in},       {"outside", f.geometry.outside}, {"back_face", f.geometry.back_face},
                    {"empty", f.geometry.empty}, {"clipped", f.geometry.clipped}, {"kept", f.geometry.kept},
                    {"binned", f.binned}};
  j["tiles"] = {{"all", f.tiles}, {"empty", f.tiles_empty}};
  j["fragments_shaded"] = f.fragments;
  j["pixels_shaded"] = f.pixels_shaded;
  j["memory_bytes"] = {
      {"peak", peak_memory()}, {"textures", f.texture_bytes}, {"tables", f.table_bytes}, {"working", f.working_bytes}};
  const std::string text = j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  OutputFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace tessera::cli
