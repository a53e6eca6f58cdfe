// Heights appear only through C = C1(h), the fraction of the surface below: Smith's masking, and so the walk, is the
// same for every distribution of heights. A ray at C along w
//   leaves unhindered with probability C^Lambda(w)  (w upwards)
//   meets the surface at C' = C (1 - U)^(-1 / Lambda(w)), outside if >= 1  (its inverse; downwards Lambda(w) <= -1)
#include "reference/walk.hpp"

#include <algorithm>
#include <numbers>

#include "reference/microfacet.hpp"
#include "reference/random.hpp"

namespace tessera::reference {
namespace {

// Light weaker than this is dropped: what it could still bring is less.
constexpr double negligible = 1e-9;

// Smith's Lambda for any direction: Heitz 2016, appendix A (GGX), without cancellation for directions near +Z.
double lambda(const Vec3& w, double alpha) {
  const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  const double s = std::min(alpha * alpha * tan2, 1e200),
               root = std::sqrt(1 + s);  // along the horizon tan2 is infinite
  return w.z > 0 ? 0.5 * s / (1 + root) : -0.5 * (1 + root);
}

// Area of the visible surface seen from w, per area of the plane: (1 + Lambda) cos, below the horizon too.
double projected_area(const Vec3& w, double alpha) {
  const double tangential = w.x * w.x + w.y * w.y, root = std::sqrt(w.z * w.z + alpha * alpha * tangential);
  return w.z > 0 ? 0.5 * (w.z + root) : 0.5 * alpha * alpha * tangential / (root - w.z);  // no cancellation
}

double next_height(double C, const Vec3& w, double alpha, Random& random) {
  return C * std::pow(1 - random.uniform(), -1 / lambda(w, alpha));
}

// A facet as seen from w: a point of the cap of the sphere that reflects w upwards, in the space where alpha = 1.
// Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps. Holds below the horizon.
Vec3 visible_normal(const Vec3& w, double alpha, Random& random) {
  const Vec3 stretched = normalize({w.x * alpha, w.y * alpha, w.z});
  const double phi = 2 * std::numbers::pi * random.uniform();
  const double z = 1 - random.uniform() * (1 + stretched.z), r = std::sqrt(std::max(1 - z * z, 0.0));
  const Vec3 h = Vec3{r * std::cos(phi), r * std::sin(phi), z} + stretched;
  return normalize({h.x * alpha, h.y * alpha, std::max(h.z, 0.0)});
}

// Cosine-distributed around n: a point on the unit sphere at its tip.
Vec3 diffuse_direction(const Vec3& n, Random& random) {
  const double z = 1 - 2 * random.uniform(), phi = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(std::max(1 - z * z, 0.0));
  return normalize(n + Vec3{r * std::cos(phi), r * std::sin(phi), z});
}

// The light that a facet seen from w sends along l: the phase functions of Heitz 2016. Mirrors have a closed form; for
// diffuse facets it is the value for the facet m that the walk drew, whose mean is the integral.
double phase(const Microsurface& surface, const Vec3& w, const Vec3& m, const Vec3& l) {
  if (surface.facets == Microsurface::Facets::diffuse)
    return surface.reflectance(dot(w, m)) * std::max(dot(m, l), 0.0) / std::numbers::pi;
  const Vec3 sum = w + l;
  const double length2 = dot(sum, sum);
  if (sum.z <= 0) return 0;
  const double cosine = std::min(std::sqrt(length2) / 2, 1.0);  // w.h = |w + l| / 2
  const double d = ggx_distribution((sum.x * sum.x + sum.y * sum.y) / length2, sum.z * sum.z / length2, surface.alpha);
  return surface.reflectance(cosine) * d / (4 * projected_area(w, surface.alpha));
}

// Sums and sums of squares over walks.
class Tally {
 public:
  explicit Tally(int orders) : sums_(orders + 2), walk_(orders + 2) {}

  void add(int order, double value) {
    walk_[0] += value;
    if (order > 1) walk_[1] += value;
    if (order < int(walk_.size()) - 1) walk_[order + 1] += value;
  }
  void end_walk() {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      sums_[i].mean += walk_[i];
      sums_[i].error += walk_[i] * walk_[i];
      walk_[i] = 0;
    }
  }
  WalkResult result(long walks) {
    for (Estimate& sum : sums_) {
      const double mean = sum.mean / walks, variance = std::max(sum.error / walks - mean * mean, 0.0);
      sum = {mean, std::sqrt(variance / std::max(walks - 1, 1L))};
    }
    return {sums_[0], sums_[1], {sums_.begin() + 2, sums_.end()}};
  }

 private:
  std::vector<Estimate> sums_;  // total, multiple, orders
  std::vector<double> walk_;
};

// score(order, weight, C, w, m) at each facet m that is seen from w, before it reflects; leave(order, weight) at the
// end.
template <class AtFacet, class Leave>
void walk(const Microsurface& surface, const Vec3& v, Random& random, AtFacet at_facet, Leave leave) {
  Vec3 w = v * -1;  // travelling
  double C = 1, weight = 1;
  for (int order = 0; weight > negligible; ++order) {
    C = next_height(C, w, surface.alpha, random);
    if (C >= 1) {
      if (order > 0) leave(order, weight);
      return;
    }
    const Vec3 from = w * -1, m = visible_normal(from, surface.alpha, random);
    at_facet(order + 1, weight, C, from, m);
    const double cosine = std::clamp(dot(from, m), 0.0, 1.0);
    weight *= surface.reflectance(cosine);
    w = surface.facets == Microsurface::Facets::mirror ? normalize(m * (2 * cosine) - from)
                                                       : diffuse_direction(m, random);
  }
}

}  // namespace

WalkResult walk_albedo(const Microsurface& surface, double mu, long walks, int orders, std::uint64_t seed) {
  Random random(seed);
  Tally tally(orders);
  const Vec3 v = {std::sqrt(std::max(1 - mu * mu, 0.0)), 0, mu};
  for (long i = 0; i < walks; ++i) {
    walk(
        surface, v, random, [](int, double, double, const Vec3&, const Vec3&) {},
        [&](int order, double weight) { tally.add(order, weight); });
    tally.end_walk();
  }
  return tally.result(walks);
}

WalkResult walk_brdf(const Microsurface& surface, const Vec3& v, const Vec3& l, long walks, int orders,
                     std::uint64_t seed) {
  Random random(seed);
  Tally tally(orders);
  const double lambda_l = lambda(l, surface.alpha);
  for (long i = 0; i < walks; ++i) {
    walk(
        surface, v, random,
        [&](int order, double weight, double C, const Vec3& from, const Vec3& m) {
          tally.add(order, weight * phase(surface, from, m, l) * std::pow(C, lambda_l) / l.z);
        },
        [](int, double) {});
    tally.end_walk();
  }
  return tally.result(walks);
}

}  // namespace tessera::reference
