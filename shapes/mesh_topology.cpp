#include "dspm/shapes/mesh_topology.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "dspm/base/math/vec.h"

namespace dspm {

std::vector<int> weld(const std::vector<Vec3>& vertices) {
  const auto at = [&](int i) -> const Vec3& { return vertices[static_cast<std::size_t>(i)]; };
  std::vector<int> order(vertices.size()), place(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::tie(at(a).x, at(a).y, at(a).z, a) < std::tie(at(b).x, at(b).y, at(b).z, b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && at(order[i]) == at(order[i - 1]);
    place[static_cast<std::size_t>(order[i])] = again ? place[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return place;
}

std::vector<Face> replace_vertices(std::vector<Face> faces, const std::vector<int>& place) {
  for (Face& f : faces)
    for (int& v : f) v = place[static_cast<std::size_t>(v)];
  return faces;
}

std::vector<Edge> edges_of(const std::vector<Face>& faces) {
  std::vector<Edge> edges;
  edges.reserve(3 * faces.size());
  for (const Face& f : faces) {
    if (has_repeated_vertex(f)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = f[i], b = f[(i + 1) % 3];
      edges.push_back(a < b ? Edge{a, b, 1, 0} : Edge{b, a, 0, 1});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  std::size_t count = 0;
  for (const Edge& e : edges) {
    if (count > 0 && edges[count - 1].low == e.low && edges[count - 1].high == e.high)
      edges[count - 1].forward += e.forward, edges[count - 1].backward += e.backward;
    else
      edges[count++] = e;
  }
  edges.resize(count);
  return edges;
}

int count_holes(const std::vector<Edge>& edges) {
  std::map<int, int> parents;  // a forest over the vertices of open edges: one tree per rim
  const auto root = [&](int v) {
    while (parents.at(v) != v) v = parents[v] = parents.at(parents.at(v));
    return v;
  };
  int holes = 0;
  for (const Edge& e : edges) {
    if (!e.is_open()) continue;
    holes += parents.try_emplace(e.low, e.low).second ? 1 : 0;
    holes += parents.try_emplace(e.high, e.high).second ? 1 : 0;
    const int a = root(e.low), b = root(e.high);
    if (a == b) continue;
    parents[a] = b;
    --holes;
  }
  return holes;
}

}  // namespace dspm
