// Light shared between a specular and a diffuse lobe: what is lost, what is invented, what is not reciprocal.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "bench/chart/diffuse_lobes.hpp"
#include "reference/albedo.hpp"
#include "reference/fresnel.hpp"
#include "reference/quadrature.hpp"

namespace tessera::chart {
namespace {

using reference::Vec3;
using std::numbers::pi;
using Planes = std::vector<std::vector<float>>;

// A dielectric of F0 = 0.04 over white Lambert: nothing absorbs, so all light should come back.
struct Coupling {
  std::string id, term, title;
  // kd of the diffuse lobe (times pi for a whole lobe): specular albedos along v and l, their average, cosines.
  std::function<std::vector<float>(double E_v, double E_l, double average, const Vec3& v, const Vec3& l)> inputs;
  bool whole_lobe = false;
};

}  // namespace

Plot measure_split(Session& session) {
  constexpr double f0 = 0.04;
  const auto schlick = [](double c) { return float(reference::fresnel_schlick(f0, c)); };
  const std::vector<Coupling> couplings = {
      {"kd-fresnel-voh", "kd_Fresnel", "1 - F(v.h)",
       [&](double, double, double, const Vec3& v, const Vec3& l) {
         return std::vector<float>{schlick(dot(v, normalize(v + l))), 0};
       }},
      {"kd-fresnel-nov", "kd_Fresnel", "1 - F(n.v)",
       [&](double, double, double, const Vec3& v, const Vec3&) {
         return std::vector<float>{schlick(v.z), 0};
       }},
      {"kd-albedoscaled", "kd_AlbedoScaled", "1 - E(v)",
       [](double E_v, double, double, const Vec3&, const Vec3&) {
         return std::vector<float>{0, 0, float(E_v), 0};
       }},
      {"kd-coupled", "kd_Coupled", "(1 - E(v))(1 - E(l)) / (1 - Eavg)",
       [](double E_v, double E_l, double average, const Vec3&, const Vec3&) {
         return std::vector<float>{float(E_v), float(E_l), float(average), 0};
       }},
      {"fd-ashikhminshirley", "Fd_AshikhminShirley", "Ashikhmin-Shirley",
       [](double, double, double, const Vec3& v, const Vec3& l) {
         return std::vector<float>{float(f0), float(v.z), float(l.z)};
       },
       true},
  };
  const int steps = session.quick ? 5 : 12, order = 8;
  const auto roughness = spread(0.1, 1, steps), NoV = spread(0.05, 1, steps);
  Plot plot;
  plot.id = "diffuse-split";
  plot.title = "Light shared between a specular and a diffuse lobe";
  plot.error_name = "largest share of light lost or invented";
  plot.domain = "F0 = 0.04 over white Lambert, roughness 0.1 to 1, n.v 0.05 to 1";
  plot.truth = "white furnace: all light comes back";
  for (const Coupling& coupling : couplings) {
    Point point = describe(coupling.term);
    point.id = coupling.id;
    point.title = coupling.title;
    plot.points.push_back(point);
    plot.points.back().maps = {{point.title + ": light too much or missing", "NoV", "roughness", NoV, roughness, {}}};
  }
  std::vector<std::vector<double>> lost(couplings.size()), turned(couplings.size());
  for (const double r : roughness) {
    session.progress(fmt::format("diffuse: split, roughness {:.2f}", r));
    const auto E = [&](double mu) {
      const auto dfg = reference::directional_albedo(mu, r * r, 32);
      return f0 * dfg.A + dfg.B;
    };
    const double average = reference::integrate([&](double mu) { return 2 * mu * E(mu); }, 0, 1, 20);
    // The azimuth changes neither: E at the rule's heights only.
    std::vector<double> E_l;
    for (const DiffuseSample& s : hemisphere(0.5, order, 0.5))
      E_l.push_back(E_l.size() % (2 * order) == 0 ? E(s.l.z) : E_l.back());
    for (const double mu : NoV) {
      const double E_v = E(mu);
      const std::vector<DiffuseSample> samples = hemisphere(mu, order, 0.5);
      for (std::size_t k = 0; k < couplings.size(); ++k) {
        Planes there, back;
        for (std::size_t i = 0; i < samples.size(); ++i) {
          const auto in = couplings[k].inputs(E_v, E_l[i], average, samples[i].v, samples[i].l);
          const auto turn = couplings[k].inputs(E_l[i], E_v, average, samples[i].l, samples[i].v);
          there.resize(in.size()), back.resize(in.size());
          for (std::size_t p = 0; p < in.size(); ++p) there[p].push_back(in[p]), back[p].push_back(turn[p]);
        }
        std::vector<double> f = in_double(couplings[k].term, there), g = in_double(couplings[k].term, back);
        for (std::size_t i = 0; i < f.size() && !couplings[k].whole_lobe; ++i) f[i] /= pi, g[i] /= pi;
        lost[k].push_back(E_v + albedo_of(samples, f) - 1);
        for (std::size_t i = 0; i < f.size(); ++i) turned[k].push_back(f[i] - g[i]);
        plot.points[k].maps[0].values.push_back(lost[k].back());
      }
    }
  }
  for (std::size_t k = 0; k < couplings.size(); ++k) {
    Point& point = plot.points[k];
    point.method = error_of(lost[k]);
    point.extra["reciprocity error"] = error_of(turned[k]).max;
    const Planes drawn = catalogue::draw_inputs(catalogue::method_of(couplings[k].term), 20000, 3);
    point.arithmetic =
        relative_error(in_float(session, couplings[k].term, drawn), in_double(couplings[k].term, drawn), 0.05);
    add_cost(session, point, couplings[k].term, drawn);
  }
  return plot;
}

}  // namespace tessera::chart
