// The integral over light is taken over facets, as in reference/albedo.cpp: tan^2 of a facet's angle = alpha^2 u / (1 -
// u) spreads them as GGX does, dh = du dphi / (2 pi D_GGX n.h) and dl = 4 (v.h) dh, so that
//   albedo = integral of D V F n.l 4 (v.h) / (2 pi D_GGX n.h) du dphi,
// cut at the edge where l meets the horizon.
#include "cli/furnace_lobe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "catalogue/method.hpp"
#include "catalogue/run_term.hpp"
#include "cli/parse.hpp"
#include "reference/energy_table.hpp"
#include "reference/quadrature.hpp"

namespace tessera::cli {
namespace {

using catalogue::Method;
using catalogue::Quantity;
using Planes = std::vector<std::vector<float>>;

constexpr int nodes = 40, table_size = 32;

// What a furnace knows how to fill in.
bool can_feed(Quantity q, char kind) {
  switch (q) {
    case Quantity::NoH:
    case Quantity::sin2:
    case Quantity::XoH:
    case Quantity::YoH:
    case Quantity::gamma:
      return kind == 'D' || (kind == 'V' && q == Quantity::NoH);
    case Quantity::alpha:
    case Quantity::alpha_y:
    case Quantity::roughness:
    case Quantity::NoV:
    case Quantity::NoL:
    case Quantity::VoH:
      return true;
    case Quantity::phi:
      return kind == 'V';
    case Quantity::F0:
      return kind != 'D' && kind != 'V';
    default:
      return false;
  }
}

bool usable(const Method& method, char kind) {
  if (method.estimate) return false;
  if (kind == 'f') return method.term.rfind("f_", 0) == 0 || method.term.rfind("split_", 0) == 0;
  if (method.term.size() < 2 || method.term[0] != kind || method.term[1] != '_') return false;
  return std::all_of(method.inputs.begin(), method.inputs.end(), [&](Quantity q) { return can_feed(q, kind); });
}

// Facets for one direction of view: what terms may ask for, and what a unit of D V F counts.
struct Facets {
  std::vector<float> NoH, sin2, XoH, YoH, NoL, VoH, phi;
  std::vector<double> weight;

  [[nodiscard]] std::size_t size() const { return weight.size(); }
};

double horizon_azimuth(double sin_v, double cos_v, double sin_h, double cos_h) {
  const double numerator = cos_v * (1 / (2 * cos_h) - cos_h), denominator = sin_v * sin_h;
  if (numerator <= -denominator) return std::numbers::pi;
  return numerator >= denominator ? 0 : std::acos(numerator / denominator);
}

void add_ring(double mu, double alpha, double w0, double w1, Facets& facets) {
  const auto& rule = reference::gauss_legendre(nodes);
  const double sin_v = std::sqrt(1 - mu * mu);
  for (std::size_t i = 0; i < nodes; ++i) {
    const double x = rule.nodes[i], w = w0 + (w1 - w0) * x * x * (3 - 2 * x);  // w = sqrt(1 - u)
    const double du = 2 * w * (w1 - w0) * 6 * x * (1 - x) * rule.weights[i];
    const double tangent = alpha * std::sqrt(1 - w * w) / w, cos_h = 1 / std::hypot(1, tangent),
                 sin_h = tangent * cos_h;
    const double edge = horizon_azimuth(sin_v, mu, sin_h, cos_h);
    const double ratio = alpha / (cos_h * cos_h * (alpha * alpha + tangent * tangent));
    const double ggx = ratio * ratio / std::numbers::pi;
    for (std::size_t j = 0; j < nodes; ++j) {
      const double phi = edge * rule.nodes[j];
      const double VoH = sin_v * sin_h * std::cos(phi) + mu * cos_h, NoL = 2 * VoH * cos_h - mu;
      if (VoH <= 0 || NoL <= 0) continue;
      const double lx = 2 * VoH * sin_h * std::cos(phi) - sin_v, ly = 2 * VoH * sin_h * std::sin(phi);
      facets.NoH.push_back(float(cos_h));
      facets.sin2.push_back(float(sin_h * sin_h));
      facets.XoH.push_back(float(sin_h * std::cos(phi)));
      facets.YoH.push_back(float(sin_h * std::sin(phi)));
      facets.NoL.push_back(std::min(float(NoL), 1.0f));
      facets.VoH.push_back(std::min(float(VoH), 1.0f));
      facets.phi.push_back(float(std::abs(std::atan2(ly, lx))));
      facets.weight.push_back(du * 2 * edge * rule.weights[j] * NoL * 4 * VoH / (2 * std::numbers::pi * ggx * cos_h));
    }
  }
}

Facets facets_of(double mu, double alpha) {
  const double theta = std::acos(mu), quarter = std::numbers::pi / 2;
  const auto w = [&](double theta_h) { return alpha / std::hypot(alpha, std::tan(theta_h)); };
  // l leaves the hemisphere first behind v, last before it.
  const double first = w((quarter - theta) / 2), last = w((quarter + theta) / 2);
  Facets facets;
  add_ring(mu, alpha, first, 1, facets);
  add_ring(mu, alpha, last, first, facets);
  return facets;
}

const std::vector<float>& energy_table() {
  static const std::vector<float> table = reference::energy_loss_table(table_size);
  return table;
}

std::vector<float> evaluate(const Kernels& kernels, const std::string& name, const Planes& inputs, int output = 0) {
  const float* table = name.ends_with("_table") ? energy_table().data() : nullptr;
  return catalogue::run_term(catalogue::require_term(kernels.terms, name), inputs, table, table_size)
      .at(std::size_t(output));
}

class Lobe {
 public:
  Lobe(const Kernels& kernels, const LobeChoice& choice, double mu, double roughness)
      : kernels_(kernels), choice_(choice), mu_(mu), roughness_(roughness), facets_(facets_of(mu, alpha())) {}

  double albedo() const { return choice_.compensation.rfind("split_", 0) == 0 ? of_split() : of_lobe(); }

 private:
  [[nodiscard]] double alpha() const { return roughness_ * roughness_; }

  std::vector<float> plane(Quantity q, double f0) const {
    switch (q) {
      case Quantity::NoH:
        return facets_.NoH;
      case Quantity::sin2:
        return facets_.sin2;
      case Quantity::XoH:
        return facets_.XoH;
      case Quantity::YoH:
        return facets_.YoH;
      case Quantity::NoL:
        return facets_.NoL;
      case Quantity::VoH:
        return facets_.VoH;
      case Quantity::phi:
        return facets_.phi;
      default:
        return std::vector<float>(facets_.size(), value(q, f0));
    }
  }
  float value(Quantity q, double f0) const {
    switch (q) {
      case Quantity::NoV:
        return float(mu_);
      case Quantity::roughness:
        return float(roughness_);
      case Quantity::gamma:
        return float(choice_.gamma);
      case Quantity::F0:
        return float(f0);
      default:
        return float(alpha());
    }
  }

  // The lobe before compensation.
  double single(const std::string& fresnel, double f0) const {
    std::vector<double> product = facets_.weight;
    for (const std::string& term : {choice_.distribution, choice_.masking, fresnel}) {
      Planes planes;
      for (const Quantity q : catalogue::method_of(term).inputs) planes.push_back(plane(q, f0));
      const std::vector<float> factor = evaluate(kernels_, term, planes);
      for (std::size_t i = 0; i < product.size(); ++i) product[i] *= double(factor[i]);
    }
    double sum = 0;
    for (const double x : product) sum += x;
    return sum;
  }

  double of_split() const {
    const double B = single("F_Schlick", 0), A = single("F_Schlick", 1) - B;
    const auto& inputs = catalogue::method_of(choice_.compensation).inputs;
    Planes planes = {{float(choice_.f0)}, {float(A)}, {float(B)}};
    for (std::size_t k = 3; k < inputs.size(); ++k) planes.push_back({value(inputs[k], choice_.f0)});
    return double(evaluate(kernels_, choice_.compensation, planes)[0]) +
           double(evaluate(kernels_, choice_.compensation, planes, 1)[0]);
  }

  // Every f_ is affine in the lobe's value: scale times it, plus what is added for each l.
  double of_lobe() const {
    const auto& rule = reference::gauss_legendre(8);
    std::vector<float> l;
    std::vector<double> weight;
    double low = 0, high = std::min(alpha() / 20, 1.0);
    while (low < 1) {
      for (std::size_t i = 0; i < 8; ++i) {
        l.push_back(float(low + (high - low) * rule.nodes[i]));
        weight.push_back(2 * std::numbers::pi * (high - low) * rule.weights[i] * double(l.back()));
      }
      low = high;
      high = std::min(high * 2, 1.0);
    }
    const auto with = [&](float value_of_lobe) {
      Planes planes;
      for (const Quantity q : catalogue::method_of(choice_.compensation).inputs)
        planes.push_back(q == Quantity::NoL   ? l
                         : q == Quantity::any ? std::vector<float>(l.size(), value_of_lobe)
                                              : std::vector<float>(l.size(), value(q, choice_.f0)));
      return evaluate(kernels_, choice_.compensation, planes);
    };
    const std::vector<float> added = with(0);
    double sum = (double(with(1).back()) - double(added.back())) * single(choice_.fresnel, choice_.f0);
    for (std::size_t i = 0; i < l.size(); ++i) sum += weight[i] * double(added[i]);
    return sum;
  }

  const Kernels& kernels_;
  const LobeChoice& choice_;
  double mu_, roughness_;
  Facets facets_;
};

std::string lower(std::string_view text) {
  std::string out;
  for (const char c : text) out += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return out;
}

}  // namespace

std::vector<std::string> lobe_parts(char kind) {
  std::vector<std::string> names;
  for (const Method& method : catalogue::methods())
    if (usable(method, kind)) names.push_back(method.term);
  return names;
}

LobeChoice parse_lobe(std::string_view names) {
  LobeChoice choice;
  bool given[4] = {};
  if (names.empty()) return choice;
  for (const std::string& name : parse_words("--brdf", names)) {
    std::vector<std::pair<int, std::string>> found;
    if (lower(name) == "none") found.emplace_back(3, "f_SingleScattering");
    for (int kind = 0; kind < 4; ++kind)
      for (const std::string& term : lobe_parts("DVFf"[kind]))
        if (lower(term) == lower(name) || lower(term.substr(term.find('_') + 1)) == lower(name))
          if (term == name || !term.starts_with("split_")) found.emplace_back(kind, term);
    // Where case alone tells parts apart (F_... and f_...), the exact name decides.
    for (const auto& candidate : std::vector<std::pair<int, std::string>>(found))
      if (candidate.second == name) found = {candidate};
    if (found.empty())
      throw usage_error("--brdf: there is no part '{}' that a furnace can take; 'tessera furnace --list' names them",
                        name);
    if (found.size() > 1)
      throw usage_error("--brdf: '{}' may be {} or {}: give the whole name", name, found[0].second, found[1].second);
    const auto& [kind, term] = found[0];
    if (given[kind]) throw usage_error("--brdf: {} is a second part of the same kind", term);
    given[kind] = true;
    std::string* const slots[] = {&choice.distribution, &choice.masking, &choice.fresnel, &choice.compensation};
    *slots[kind] = term;
  }
  return choice;
}

std::vector<double> furnace_albedo(const Kernels& kernels, const LobeChoice& choice, double roughness,
                                   const std::vector<double>& NoV) {
  if (choice.compensation.ends_with("_table")) energy_table();  // once, before the threads
  std::vector<double> albedo(NoV.size());
  parallel_for(NoV.size(), [&](std::size_t i) { albedo[i] = Lobe(kernels, choice, NoV[i], roughness).albedo(); });
  return albedo;
}

}  // namespace tessera::cli
