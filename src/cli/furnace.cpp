// tessera furnace: what a specular lobe gives back of a uniform white light.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "cli/commands.hpp"
#include "cli/furnace_lobe.hpp"
#include "cli/furnace_picture.hpp"
#include "cli/parse.hpp"
#include "cli/picture.hpp"
#include "cli/text.hpp"
#include "frame/dispatch.hpp"

namespace tessera::cli {
namespace {

constexpr const char* footer =
    R"(A lobe that conserves energy gives back all of a white furnace when its facets are white (--f0 1): the table says 1
everywhere, and the spheres of the picture vanish. Single scattering alone loses light as the roughness grows.

The picture (-o) shows a sphere per roughness in a furnace of middle grey, so that a gain would show too. Below them is a
map: NoV from 0 to 1 across, a band per roughness downwards; white within 0.001 of the furnace, blue darker, red brighter.

--brdf takes names of parts, with or without their prefix: a distribution (D_...), masking (V_...), Fresnel (F_...) and
energy compensation (f_... for lights, split_... for environments); 'tessera furnace --list' names all. What is not
named is D_GGX, V_SmithGGXCorrelated, F_Schlick, and no compensation. Compensations know the energy that GGX with
V_SmithGGXCorrelated loses: with other parts they are off, and the table shows by how much.

Examples:
  tessera furnace
  tessera furnace --brdf KullaConty_table -o furnace.png
  tessera furnace --brdf ggx,SmithGGXSeparable,Turquin --roughness 0.25,0.5,1 --json
  tessera furnace --brdf split_FdezAguera_kS --f0 0.9)";

struct Options {
  std::string brdf, roughness = "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1", output, isa;
  double f0 = 1, gamma = 2;
  int size = 128;
  bool json = false, list = false;
};

constexpr double shown[] = {0.02, 0.1, 0.25, 0.5, 0.75, 1};

// Crowded towards the horizon, where albedo changes fastest; those that the table shows among them.
std::vector<double> cosines(int count) {
  std::vector<double> list(std::begin(shown), std::end(shown));
  for (int i = 1; i <= count; ++i) list.push_back(double(i) * i / (double(count) * count));
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end(), [](double a, double b) { return b - a < 1e-9; }), list.end());
  return list;
}

struct Row {
  std::vector<double> at;  // as `shown`
  double average = 0, lowest = 0, highest = 0;
};

Row summary(const FurnaceGrid& grid, std::size_t row) {
  Row r;
  for (const double mu : shown) r.at.push_back(grid.at_cosine(row, mu));
  r.lowest = r.highest = grid.at(row, 0);
  // 2 integral E mu dmu, E linear between the columns; below the first constant.
  r.average = grid.at(row, 0) * grid.NoV[0] * grid.NoV[0];
  for (std::size_t i = 1; i < grid.NoV.size(); ++i) {
    const double a = grid.NoV[i - 1], b = grid.NoV[i], Ea = grid.at(row, i - 1), Eb = grid.at(row, i);
    r.average += (b - a) / 3 * (2 * (a * Ea + b * Eb) + a * Eb + b * Ea);
  }
  for (std::size_t i = 0; i < grid.NoV.size(); ++i) {
    r.lowest = std::min(r.lowest, grid.at(row, i));
    r.highest = std::max(r.highest, grid.at(row, i));
  }
  return r;
}

std::string for_a_person(const LobeChoice& choice, const FurnaceGrid& grid) {
  std::string text = fmt::format("{} x {} x {}, {}, F0 = {}\nreflected of a white furnace, by roughness and NoV:\n\n",
                                 choice.distribution, choice.masking, choice.fresnel, choice.compensation, choice.f0);
  text += fmt::format("{:>9}", "roughness");
  for (const double mu : shown) text += fmt::format("{:>9}", mu);
  text += fmt::format("{:>10}{:>9}{:>9}\n", "average", "lowest", "highest");
  for (std::size_t row = 0; row < grid.roughness.size(); ++row) {
    const Row r = summary(grid, row);
    text += fmt::format("{:>9}", grid.roughness[row]);
    for (const double E : r.at) text += fmt::format("{:>9.4f}", E);
    text += fmt::format("{:>10.4f}{:>9.4f}{:>9.4f}\n", r.average, r.lowest, r.highest);
  }
  return text;
}

std::string as_json(const LobeChoice& choice, const FurnaceGrid& grid) {
  nlohmann::ordered_json j;
  j["distribution"] = choice.distribution;
  j["masking"] = choice.masking;
  j["fresnel"] = choice.fresnel;
  j["compensation"] = choice.compensation;
  j["f0"] = choice.f0;
  j["NoV"] = grid.NoV;
  j["rows"] = nlohmann::ordered_json::array();
  for (std::size_t row = 0; row < grid.roughness.size(); ++row) {
    const Row r = summary(grid, row);
    const auto first = grid.albedo.begin() + std::ptrdiff_t(row * grid.NoV.size());
    j["rows"].push_back({{"roughness", grid.roughness[row]},
                         {"average", r.average},
                         {"lowest", r.lowest},
                         {"highest", r.highest},
                         {"albedo", std::vector<double>(first, first + std::ptrdiff_t(grid.NoV.size()))}});
  }
  return j.dump(2) + "\n";
}

std::string names_of_parts() {
  std::string text;
  for (const auto& [kind, title] : {std::pair{'D', "distributions"},
                                    {'V', "masking"},
                                    {'F', "Fresnel"},
                                    {'f', "energy compensation (f_SingleScattering: none)"}}) {
    text += fmt::format("{}:\n", title);
    for (const std::string& name : lobe_parts(kind)) text += "  " + name + "\n";
  }
  return text;
}

void run_furnace(const Options& options) {
  if (options.list) return print(names_of_parts());
  LobeChoice choice = parse_lobe(options.brdf);
  choice.f0 = options.f0;
  choice.gamma = options.gamma;
  FurnaceGrid grid;
  grid.roughness = parse_numbers("--roughness", options.roughness, 1, 64);
  for (const double r : grid.roughness)
    if (!(r >= 0.02 && r <= 1)) throw usage_error("--roughness: {} is not between 0.02 and 1", r);
  if (!(options.f0 >= 0 && options.f0 <= 1)) throw usage_error("--f0: {} is not between 0 and 1", options.f0);
  if (!(options.gamma >= 0.5 && options.gamma <= 4))
    throw usage_error("--gamma: {} is not between 0.5 and 4", options.gamma);
  if (options.size < 16 || options.size > 1024)
    throw usage_error("--size: {} is not between 16 and 1024", options.size);
  if (!options.output.empty()) check_writable(options.output);
  const Kernels& kernels = select_kernels(options.isa);
  grid.NoV = cosines(options.output.empty() ? 24 : 64);
  run_with_threads(0, [&] {
    for (const double r : grid.roughness) {
      const std::vector<double> row = furnace_albedo(kernels, choice, r, grid.NoV);
      grid.albedo.insert(grid.albedo.end(), row.begin(), row.end());
    }
  });
  if (!options.output.empty()) write_furnace_picture(options.output, grid, options.size, kernels);
  if (options.output != "-") print(options.json ? as_json(choice, grid) : for_a_person(choice, grid));
}

}  // namespace

void add_furnace(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("furnace", "White-furnace test: what a specular lobe gives back of a uniform light");
  auto options = std::make_shared<Options>();
  command->add_option("--brdf", options->brdf, "Parts of the lobe, comma-separated (see below)")->type_name("PARTS");
  command->add_option("--roughness", options->roughness, "Perceptual roughnesses, 0.02 to 1, comma-separated")
      ->type_name("LIST")
      ->default_str("0.1,...,1");
  command->add_option("--f0", options->f0, "Reflectance of the facets at normal incidence, 0 to 1")
      ->type_name("X")
      ->default_str("1");
  command->add_option("--gamma", options->gamma, "Exponent of D_GTR, 0.5 to 4")->type_name("X")->default_str("2");
  command
      ->add_option("-o,--output", options->output, "Picture: a sphere per roughness, and a map of the difference (PNG)")
      ->type_name("FILE");
  command->add_option("--size", options->size, "Pixels across one sphere, 16 to 1024")
      ->type_name("N")
      ->default_str("128");
  command->add_option("--isa", options->isa, "Instruction set; see 'tessera isa'")->type_name("NAME");
  command->add_flag("--json", options->json, "Print JSON");
  command->add_flag("--list", options->list, "Name the parts there are");
  command->footer(footer);
  command->callback([options] { run_furnace(*options); });
}

}  // namespace tessera::cli
