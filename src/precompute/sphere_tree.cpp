#include "precompute/sphere_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.hpp"

namespace tessera {

void SphereCut::clear() {
  for (AlignedVector<float>* plane : {&x, &y, &z, &red, &green, &blue, &solid_angle}) plane->clear();
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

void SphereTree::cut(const Cap& cap, float alpha, float fineness, SphereCut& out) const {
  constexpr float quarter_turn = 1.41422f;  // chord from an axis to its horizon
  struct Entry {
    int level, face, i, j;
  };
  std::array<Entry, 64> stack;  // a level leaves three brothers behind: 6 + 3 * 12 at most
  int depth = 0;
  const int last = int(levels_.size()) - 1;
  for (int face = 0; face < 6; ++face) stack[std::size_t(depth++)] = {last, face, 0, 0};
  out.clear();
  const float core = 4 * alpha * alpha, limit = fineness * fineness;
  while (depth > 0) {
    const Entry e = stack[std::size_t(--depth)];
    const int n = size_ >> e.level;
    const Node& node =
        levels_[std::size_t(e.level)]
               [(std::size_t(e.face) * std::size_t(n) + std::size_t(e.j)) * std::size_t(n) + std::size_t(e.i)];
    const float dx = node.x - cap.x, dy = node.y - cap.y, dz = node.z - cap.z;
    const float distance = std::max(std::sqrt(dx * dx + dy * dy + dz * dz) - cap.radius, 0.0f);
    if (distance - node.width > quarter_turn) continue;
    if (e.level > 0 && node.width * node.width > limit * (core + distance * distance)) {
      for (int k = 0; k < 4; ++k)
        stack[std::size_t(depth++)] = {e.level - 1, e.face, 2 * e.i + (k & 1), 2 * e.j + (k >> 1)};
      continue;
    }
    out.x.push_back(node.x);
    out.y.push_back(node.y);
    out.z.push_back(node.z);
    out.red.push_back(node.flux[0]);
    out.green.push_back(node.flux[1]);
    out.blue.push_back(node.flux[2]);
    out.solid_angle.push_back(node.solid_angle);
  }
}

}  // namespace tessera
