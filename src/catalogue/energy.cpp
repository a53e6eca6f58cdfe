// The catalogue's methods: energy that single scattering loses, and its compensation.
#include "catalogue/method.hpp"

namespace tessera::catalogue {
namespace {

using Q = Quantity;

constexpr const char* loss_file = "kernels/bsdf/energy_loss.hpp";
constexpr const char* compensation_file = "kernels/bsdf/energy_compensation.hpp";
constexpr const char* walk = "the random walk on the microsurface (Heitz et al. 2016): directional albedo";
constexpr const char* integral = "1 - E by quadrature";
constexpr const char* kulla_conty =
    "Kulla, Conty 2017, Revisiting Physically Based Shading at Imageworks; Favg^2 as Hill 2018 corrected it";
constexpr const char* slides = "Kulla, Conty 2017, Revisiting Physically Based Shading at Imageworks (first slides)";
constexpr const char* turquin =
    "Turquin 2019, Practical Multiple Scattering Compensation for Microfacet Models, eq. 16";
constexpr const char* hill = "Hill 2019, A Multi-Faceted Exploration (part 4); coefficients: own fit to random walks";
constexpr const char* fdez_aguera =
    "Fdez-Aguera 2019, A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting";

struct Entry {
  const char *term, *title, *formula, *paper, *file, *fails;
  std::vector<Quantity> inputs;
  double bound, floor;
  const char* truth = "";
  double method_bound = 0;
  bool own_test = false;
};

Method from_entry(const Entry& e) {
  Method m;
  m.family = "energy";
  m.term = e.term;
  m.title = e.title;
  m.formula = e.formula;
  m.paper = e.paper;
  m.file = e.file;
  m.fails = e.fails;
  m.inputs = e.inputs;
  m.high = std::string(e.term).rfind("Fms_", 0) == 0 ? 0.6 : 100;  // 1 - Eavg, or the value of a lobe
  m.arithmetic_bound = e.bound;
  m.arithmetic_floor = e.floor;
  m.truth = e.truth;
  m.method_bound = e.method_bound;
  m.own_test = e.own_test;
  return m;
}

}  // namespace

std::vector<Method> energy_methods() {
  const std::vector<Q> lobe = {Q::any, Q::F0, Q::NoV, Q::NoL, Q::alpha}, of_v = {Q::any, Q::F0, Q::NoV, Q::alpha};
  const char* no_color = "colour: what returns is as white as what left first";
  const std::vector<Entry> entries = {
      {"Ems_GGX",
       "1 - E, polynomial",
       "m u^2 (1 + mu^2 m^2) P(sqrt(m), alpha), m = mu / (mu + 2.5 alpha), u = 1 - m",
       "own fit, degree 8 x 5",
       loss_file,
       "its tail, Ems below 1e-3: up to 7 % of Ems",
       {Q::NoV, Q::alpha},
       1e-6,
       1,
       integral,
       7.5e-4},
      {"Ems_GGX_table",
       "1 - E, table",
       "m u^2 (1 + mu^2 m^2) times a table over (sqrt(m), roughness), bilinear",
       "own axes; nodes by quadrature",
       loss_file,
       "",
       {Q::NoV, Q::alpha},
       1e-6,
       1,
       integral,
       5e-4,
       true},
      {"Ems_GGX_integral",
       "1 - E, quadrature",
       "integral over slopes, 16 x 16 nodes",
       "own quadrature (kernels/bake/dfg.hpp)",
       "kernels/bake/dfg.hpp",
       "",
       {Q::NoV, Q::alpha},
       1e-6,
       1,
       integral,
       1e-5},
      {"Emsavg_GGX",
       "1 - Eavg",
       "alpha^2 (P(alpha) - ln alpha)",
       "own fit, degree 4",
       loss_file,
       "",
       {Q::alpha},
       1e-6,
       0,
       "2 integral (1 - E) mu dmu by quadrature",
       4e-4},
      {"Favg_Schlick",
       "average Fresnel",
       "F0 + (1 - F0) / 21",
       kulla_conty,
       compensation_file,
       "",
       {Q::F0},
       2e-7,
       0,
       "2 integral F mu dmu of Schlick's Fresnel",
       1e-12},
      {"Fms_KullaConty",
       "Kulla-Conty colour",
       "Favg^2 Eavg / (1 - Favg (1 - Eavg))",
       kulla_conty,
       compensation_file,
       "grazing angles: takes the facets' average Fresnel for that of the path",
       {Q::F0, Q::any},
       2e-6,
       0},
      {"Fms_KullaConty_slides",
       "Kulla-Conty colour, first slides",
       "Favg Eavg / (1 - Favg (1 - Eavg))",
       slides,
       compensation_file,
       "leaves out the absorption at one facet: too bright for every F0 < 1",
       {Q::F0, Q::any},
       2e-6,
       0},
      {"Fms_Hill",
       "Hill colour series",
       "1 - (1 - F0) (t0 + t1 F0 + t2 F0^2), t(sqrt(NoV), roughness)",
       hill,
       compensation_file,
       "",
       {Q::F0, Q::NoV, Q::alpha},
       1e-6,
       1},
      {"scale_Turquin",
       "Turquin scale",
       "1 + F0 (1 - E) / E",
       turquin,
       compensation_file,
       no_color,
       {Q::F0, Q::albedo},
       1e-6,
       0},
      {"f_SingleScattering",
       "none",
       "f",
       "Cook, Torrance 1982, A Reflectance Model for Computer Graphics",
       compensation_file,
       "rough surfaces: loses up to 0.69 of the light",
       {Q::any},
       1e-7,
       1e-30,
       walk,
       0.7},
      {"f_KullaConty", "Kulla-Conty, polynomial", "f + Fms (1 - E(v)) (1 - E(l)) / (pi (1 - Eavg))", kulla_conty,
       compensation_file, "", lobe, 3e-5, 1e-3, walk, 0.1},
      {"f_KullaConty_slides", "Kulla-Conty, first slides",
       "f + Favg Eavg / (1 - Favg (1 - Eavg)) (1 - E(v)) (1 - E(l)) / (pi (1 - Eavg))", slides, compensation_file,
       "leaves out the absorption at one facet: too bright for every F0 < 1", lobe, 3e-5, 1e-3, walk, 0.3},
      {"f_KullaConty_table", "Kulla-Conty, table", "f + Fms (1 - E(v)) (1 - E(l)) / (pi (1 - Eavg))", kulla_conty,
       compensation_file, "", lobe, 3e-6, 1e-30, walk, 0.1, true},
      {"f_Turquin", "Turquin, polynomial", "f (1 + F0 (1 - E(v)) / E(v))", turquin, compensation_file,
       "not reciprocal; in between F0, too saturated", of_v, 3e-6, 1e-30, walk, 0.1},
      {"f_Turquin_table", "Turquin, table", "f (1 + F0 (1 - E(v)) / E(v))", turquin, compensation_file,
       "not reciprocal", of_v, 3e-6, 1e-30, walk, 0.1, true},
      {"f_Hill", "Hill series", "f + Fms(F0, v) (1 - E(v)) (1 - E(l)) / (pi (1 - Eavg))", hill, compensation_file,
       "not reciprocal", lobe, 1e-3, 1e-2, walk, 0.01},
      {"split_SingleScattering",
       "none (environment)",
       "F0 A + B",
       "Karis 2013, Real Shading in Unreal Engine 4, eq. 8",
       compensation_file,
       "rough surfaces: loses up to 0.69 of the light",
       {Q::F0, Q::albedo, Q::albedo},
       2e-7,
       1e-30,
       walk,
       0.7},
      {"split_KullaConty",
       "Kulla-Conty (environment)",
       "F0 A + B; Fms (1 - A - B)",
       kulla_conty,
       compensation_file,
       "",
       {Q::F0, Q::albedo, Q::albedo, Q::alpha},
       1e-6,
       1,
       walk,
       0.1},
      {"split_Turquin",
       "Turquin (environment)",
       "(F0 A + B) (1 + F0 (1 - A - B) / (A + B))",
       turquin,
       compensation_file,
       "",
       {Q::F0, Q::albedo, Q::albedo},
       2e-6,
       0,
       walk,
       0.1,
       true},
      {"split_Hill",
       "Hill series (environment)",
       "F0 A + B; Fms(F0, v) (1 - A - B)",
       hill,
       compensation_file,
       "",
       {Q::F0, Q::albedo, Q::albedo, Q::NoV, Q::alpha},
       1e-6,
       1,
       walk,
       0.01},
      {"split_FdezAguera",
       "Fdez-Aguera, F0",
       "F0 A + B; Ems (F0 A + B) Favg / (1 - Favg Ems)",
       fdez_aguera,
       compensation_file,
       "",
       {Q::F0, Q::albedo, Q::albedo},
       2e-6,
       1,
       walk,
       0.1,
       true},
      {"split_FdezAguera_kS",
       "Fdez-Aguera, kS as published",
       "kS A + B; Ems (kS A + B) Favg / (1 - Favg Ems)",
       fdez_aguera,
       "kernels/bsdf/energy.hpp",
       "smooth surfaces at grazing angles: counts the rise to F90 twice",
       {Q::F0, Q::albedo, Q::albedo, Q::NoV, Q::roughness},
       2e-6,
       1,
       walk,
       0.3,
       true},
  };
  std::vector<Method> methods;
  methods.reserve(entries.size());
  for (const Entry& entry : entries) methods.push_back(from_entry(entry));
  return methods;
}

}  // namespace tessera::catalogue
