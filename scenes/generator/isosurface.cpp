#include "scenes/generator/isosurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

/// Field values at the corners of a grid of cubes.
class Grid {
 public:
  Grid(const Field& field, const Bounds3& bounds, float cell) : low_(bounds.low), cell_(cell) {
    const auto corners = [&](int axis) { return static_cast<int>(bounds.extent()[axis] / cell) + 2; };
    size_ = {corners(0), corners(1), corners(2)};
    values_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                   static_cast<std::size_t>(size_[2]));
    const std::array<int, 3> blocks{size_[0] / kBlock + 1, size_[1] / kBlock + 1, size_[2] / kBlock + 1};
    parallel_for(blocks[0] * blocks[1] * blocks[2], 8, [&](std::int64_t i) {
      const int block = static_cast<int>(i);
      sample(field, {block % blocks[0], block / blocks[0] % blocks[1], block / blocks[0] / blocks[1]});
    });
  }
  const std::array<int, 3>& size() const { return size_; }
  int index(int x, int y, int z) const { return (z * size_[1] + y) * size_[0] + x; }
  Vec3 point(int i) const {
    const int x = i % size_[0], y = i / size_[0] % size_[1], z = i / size_[0] / size_[1];
    return low_ + Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} * cell_;
  }
  double value(int i) const { return values_[static_cast<std::size_t>(i)]; }
  bool inside(int i) const { return value(i) < 0; }

 private:
  static constexpr int kBlock = 8;  // corners along its edge

  /// Far from the surface, the value in a block's middle stands for all of it: only its sign matters there.
  void sample(const Field& field, const std::array<int, 3>& block) {
    constexpr float kMiddle = 0.5f * (kBlock - 1);
    const auto middle = [&](std::size_t axis) { return static_cast<float>(block[axis] * kBlock) + kMiddle; };
    const double in_middle = field(low_ + Vec3{middle(0), middle(1), middle(2)} * cell_);
    const bool far = std::abs(in_middle) > 2.6 * double{kMiddle} * double{cell_};  // 1.5 times to the corner
    const auto end = [&](std::size_t axis) { return std::min((block[axis] + 1) * kBlock, size_[axis]); };
    for (int z = block[2] * kBlock; z < end(2); ++z)
      for (int y = block[1] * kBlock; y < end(1); ++y)
        for (int x = block[0] * kBlock; x < end(0); ++x) {
          const int i = index(x, y, z);
          values_[static_cast<std::size_t>(i)] = far ? in_middle : field(point(i));
        }
  }

  Vec3 low_;
  float cell_;
  std::array<int, 3> size_{};
  std::vector<double> values_;
};

/// Cuts each cube into six tetrahedra, and these by the surface. Neighbours cut the faces that they share alike, so the
/// result is closed and manifold whatever the field. [Doi, Koide 1991]
class Marcher {
 public:
  explicit Marcher(const Grid& grid) : grid_(grid) {}

  MeshData run() {
    for (int z = 0; z + 1 < grid_.size()[2]; ++z)
      for (int y = 0; y + 1 < grid_.size()[1]; ++y)
        for (int x = 0; x + 1 < grid_.size()[0]; ++x) cut_cube(x, y, z);
    return std::move(mesh_);
  }

 private:
  using Tetrahedron = std::array<int, 4>;  // grid corners, positively oriented

  void cut_cube(int x, int y, int z) {
    std::array<int, 8> corners{};
    int count = 0;
    for (int i = 0; i < 8; ++i) {
      corners[static_cast<std::size_t>(i)] = grid_.index(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
      count += grid_.inside(corners[static_cast<std::size_t>(i)]);
    }
    if (count == 0 || count == 8) return;
    // From corner 0 to corner 7 along the axes a, b, c in each of the six orders.
    constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
        {{1, 2, 4}, {2, 4, 1}, {4, 1, 2}, {1, 4, 2}, {4, 2, 1}, {2, 1, 4}}};
    for (std::size_t i = 0; i < kOrders.size(); ++i) {
      const auto& [a, b, c] = kOrders[i];
      Tetrahedron t{corners[0], corners[a], corners[a + b], corners[a + b + c]};
      if (i >= 3) std::swap(t[1], t[2]);
      cut(t);
    }
  }

  void cut(Tetrahedron t) {
    const auto is_inside = [&](int i) { return grid_.inside(i); };
    // An even number of swaps keeps the orientation while the inside corners move to the front.
    for (int last = 3; last > 0; --last)
      for (std::size_t i = 0; i < static_cast<std::size_t>(last); ++i)
        if (!is_inside(t[i]) && is_inside(t[i + 1])) {
          std::swap(t[i], t[i + 1]);
          turned_ = !turned_;
        }
    const bool turned = std::exchange(turned_, false);
    const auto count = std::count_if(t.begin(), t.end(), is_inside);
    const auto edge = [&](std::size_t i, std::size_t j) { return vertex(t[i], t[j]); };
    if (count == 1) triangle(edge(0, 1), edge(0, 2), edge(0, 3), turned);
    if (count == 3) triangle(edge(3, 0), edge(3, 2), edge(3, 1), turned);
    if (count != 2) return;
    triangle(edge(0, 2), edge(0, 3), edge(1, 3), turned);
    triangle(edge(0, 2), edge(1, 3), edge(1, 2), turned);
  }

  void triangle(int a, int b, int c, bool turned) { mesh_.faces.push_back(turned ? Face{a, c, b} : Face{a, b, c}); }

  /// Where the surface crosses the edge between two corners.
  int vertex(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [at, is_new] = vertices_.try_emplace({a, b}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      const auto t = static_cast<float>(grid_.value(a) / (grid_.value(a) - grid_.value(b)));
      mesh_.vertices.push_back(grid_.point(a) * (1 - t) + grid_.point(b) * t);
    }
    return at->second;
  }

  const Grid& grid_;
  bool turned_ = false;
  MeshData mesh_;
  std::map<std::pair<int, int>, int> vertices_;
};

/// Every vertex moves to the middle of its neighbours.
void relax(MeshData& mesh) {
  std::vector<Vec3> sums(mesh.vertices.size());
  std::vector<float> counts(mesh.vertices.size(), 0);
  for (const Face& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {  // each edge once in each direction, by its two faces
      const auto from = static_cast<std::size_t>(face[k]), to = static_cast<std::size_t>(face[(k + 1) % 3]);
      sums[from] += mesh.vertices[to];
      ++counts[from];
    }
  for (std::size_t v = 0; v < sums.size(); ++v) mesh.vertices[v] = sums[v] / counts[v];
}

/// Newton's steps along the gradient.
void pull_to_surface(const Field& field, std::vector<Vec3>& points) {
  for (Vec3& p : points)
    for (int i = 0; i < 2; ++i) p += gradient(field, p) * static_cast<float>(-field(p));
}

}  // namespace

MeshData isosurface(const Field& field, const Bounds3& bounds, float cell, int triangles,
                    const Coarseness& coarseness) {
  MeshData mesh = simplified(Marcher(Grid(field, bounds, cell)).run(), triangles, coarseness);
  for (int i = 0; i < 3; ++i) {
    relax(mesh);
    pull_to_surface(field, mesh.vertices);
  }
  return mesh;
}

Vec3 gradient(const Field& field, const Vec3& p) {
  constexpr float kStep = 1e-3f;
  Vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 low = p, high = p;
    low[axis] -= kStep, high[axis] += kStep;
    slope[axis] = static_cast<float>(field(high) - field(low));
  }
  return normalize(slope);
}

}  // namespace dspm
