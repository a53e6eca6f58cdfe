#include "precompute/sphere_tree.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace tessera {

void SphereCut::resize(std::size_t count) {
  for (ScratchVector<float>* plane : {&x, &y, &z, &red, &green, &blue, &solid_angle}) plane->resize(count);
}

PointSources SphereCut::view(float alpha2) const {
  return {x.data(),    y.data(),      z.data(), red.data(), green.data(),
          blue.data(), int(x.size()), alpha2,   1,          solid_angle.data()};
}

SphereTree::SphereTree(const CubeLevel& radiance) : size_(radiance.size) {
  for (int n = size_; n >= 1; n /= 2) {
    levels_.emplace_back(std::size_t{6} * std::size_t(n) * std::size_t(n));
    std::vector<Node>& level = levels_.back();
    const std::vector<Node>* finer = levels_.size() > 1 ? &levels_[levels_.size() - 2] : nullptr;
    parallel_for(std::size_t{6} * std::size_t(n), [&](std::size_t row) {
      const int face = int(row) / n, j = int(row) % n;
      for (int i = 0; i < n; ++i) {
        Node& node = level[row * std::size_t(n) + std::size_t(i)];
        const CubeDirection d = texel_direction(face, i, j, n);
        node = {d.x, d.y, d.z, 0, 0, {0, 0, 0}};
        if (finer == nullptr) {
          node.solid_angle = d.solid_angle;
          for (int c = 0; c < 3; ++c)
            node.flux[c] =
                radiance.texels[(row * std::size_t(n) + std::size_t(i)) * 4 + std::size_t(c)] * d.solid_angle;
        } else {
          for (int k = 0; k < 4; ++k) {
            const std::size_t above =
                (std::size_t(face) * std::size_t(2 * n) + std::size_t(2 * j + (k >> 1))) * std::size_t(2 * n) +
                std::size_t(2 * i + (k & 1));
            const Node& child = (*finer)[above];
            node.solid_angle += child.solid_angle;
            for (int c = 0; c < 3; ++c) node.flux[c] += child.flux[c];
          }
        }
        node.width = std::sqrt(node.solid_angle);
      }
    });
  }
}

// Level by level, coarsest first. A node is left out, taken as it is, or opened: which one is as good as random, so
// that all are written and the counts say what stays.
void SphereTree::cut(const Cap& cap, float alpha, float fineness, Scratch& scratch, SphereCut& out) const {
  constexpr float quarter_turn = 1.41422f;  // chord from an axis to its horizon
  const float core = 4 * alpha * alpha, limit = fineness * fineness;
  std::size_t candidates = 6, taken = 0;
  scratch.places.resize(std::max<std::size_t>(scratch.places.size(), candidates));
  for (int face = 0; face < 6; ++face) scratch.places[std::size_t(face)] = {face, 0, 0};
  for (int level = int(levels_.size()) - 1; level >= 0 && candidates != 0; --level) {
    const int n = size_ >> level;
    const Node* const nodes = levels_[std::size_t(level)].data();
    scratch.open.resize(std::max(scratch.open.size(), candidates + 1));
    scratch.taken.resize(std::max(scratch.taken.size(), taken + candidates + 1));
    std::size_t opened = 0;
    for (std::size_t k = 0; k < candidates; ++k) {
      const Place place = scratch.places[k];
      const Node& node = nodes[(std::size_t(place.face) * std::size_t(n) + std::size_t(place.j)) * std::size_t(n) +
                               std::size_t(place.i)];
      const float dx = node.x - cap.x, dy = node.y - cap.y, dz = node.z - cap.z;
      const float distance = std::max(std::sqrt(dx * dx + dy * dy + dz * dz) - cap.radius, 0.0f);
      const bool seen = !(distance - node.width > quarter_turn);
      const bool wide = (level > 0) & (node.width * node.width > limit * (core + distance * distance));
      scratch.open[opened] = place;
      opened += seen & wide;
      scratch.taken[taken] = &node;
      taken += seen & !wide;
    }
    candidates = 4 * opened;
    scratch.places.resize(std::max(scratch.places.size(), candidates));
    for (std::size_t k = 0; k < opened; ++k) {
      const Place place = scratch.open[k];
      for (int child = 0; child < 4; ++child)
        scratch.places[4 * k + std::size_t(child)] = {place.face, 2 * place.i + (child & 1),
                                                      2 * place.j + (child >> 1)};
    }
  }
  out.resize(taken);
  for (std::size_t k = 0; k < taken; ++k) {
    const Node& node = *scratch.taken[k];
    out.x[k] = node.x;
    out.y[k] = node.y;
    out.z[k] = node.z;
    out.red[k] = node.flux[0];
    out.green[k] = node.flux[1];
    out.blue[k] = node.flux[2];
    out.solid_angle[k] = node.solid_angle;
  }
}

}  // namespace tessera
