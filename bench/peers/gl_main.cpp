// Times Mesa's llvmpipe on the deferred-shading workload, as bench/workload times Tessera:
//   tessera_peer_gl --data FOLDER --shader deferred.frag --variant L1,L4,L16 --out PREFIX [--seconds 1]
// One JSON line per variant on standard output; the picture as raw RGBA float in PREFIX_VARIANT.f32.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "bench/peers/gl_context.hpp"
#include "bench/peers/gl_deferred.hpp"
#include "bench/workload/timing.hpp"

namespace tessera::peers {
namespace {

void save(const std::string& path, const std::vector<float>& picture) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(picture.data()), std::streamsize(sizeof(float) * picture.size()));
  if (!file) throw output_error("{}: cannot be written", path);
}

void run(int argc, char** argv) {
  std::map<std::string, std::string> options = {{"--data", "."},
                                                {"--shader", "bench/peers/deferred.frag"},
                                                {"--variant", "L4"},
                                                {"--out", "llvmpipe"},
                                                {"--seconds", "1"}};
  for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
  const GlContext context;
  GlDeferred pass(options["--data"], options["--shader"]);
  std::stringstream variants(options["--variant"]);
  for (std::string variant; std::getline(variants, variant, ',');) {
    pass.use_lights(variant.substr(1));
    const workload::Timing timing = workload::measure([&] { pass.draw(); }, std::stod(options["--seconds"]));
    const std::string path = options["--out"] + "_" + variant + ".f32";
    save(path, pass.read());
    fmt::print(R"({{"impl":"{}","workload":"w1","variant":"{}","median_ms":{:.3f},"frames":{},"out":"{}"}})"
               "\n",
               context.driver(), variant, timing.median, timing.frames, path);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace tessera::peers

int main(int argc, char** argv) {
  try {
    tessera::peers::run(argc, argv);
    return 0;
  } catch (const tessera::Error& error) {
    std::fprintf(stderr, "tessera_peer_gl: error: %s\n", error.what());
    return static_cast<int>(error.status());
  }
}
