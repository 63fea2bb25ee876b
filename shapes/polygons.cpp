#include "dspm/shapes/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle.h"

namespace dspm {
namespace {

constexpr std::size_t kLarge = 64;               // corners
constexpr std::size_t kMostLooks = 100'000'000;  // less than a second, for a file that would take hours

using Corners = std::span<const int>;

class Triangulation {
 public:
  explicit Triangulation(const std::vector<Vec3>& vertices) : vertices_(vertices) {}

  void add(Corners polygon) {
    if (polygon.size() < 3) return;
    if (polygon.size() == 3) return faces_.push_back({polygon[0], polygon[1], polygon[2]});
    normal_ = area_of(polygon);
    if (fan_is_good(polygon))
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i) faces_.push_back({polygon[0], polygon[i], polygon[i + 1]});
    else
      cut_ears({polygon.begin(), polygon.end()});
  }
  std::vector<Face> take() { return std::move(faces_); }

 private:
  const Vec3& at(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }
  DoubleVec3 area(int a, int b, int c) const { return area_vector(at(a), at(b), at(c)); }
  double turn(int a, int b, int c) const { return dot(area(a, b, c), normal_); }

  // Twice the polygon's area along its normal: the sum over any fan. [Newell]
  DoubleVec3 area_of(Corners polygon) const {
    DoubleVec3 sum{0, 0, 0};
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum = sum + area(polygon[0], polygon[i], polygon[i + 1]);
    return sum;
  }

  bool fan_is_good(Corners polygon) const {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      if (turn(polygon[0], polygon[i], polygon[i + 1]) < 0) return false;
    return true;
  }

  // Cuts off the first corner that turns the same way as the polygon and whose triangle contains no other corner. If
  // there is none (the polygon intersects itself), any corner. A cut creates or removes ears only at its two
  // neighbours.
  void cut_ears(std::vector<int> ring) {
    large_ = ring.size() > kLarge;
    std::vector<bool> ears(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) ears[i] = is_ear(ring, i);
    while (ring.size() > 3) {
      const auto first = std::find(ears.begin(), ears.end(), true);
      const std::size_t i = first == ears.end() ? 0 : static_cast<std::size_t>(first - ears.begin());
      cut(ring, i);
      ears.erase(ears.begin() + static_cast<std::ptrdiff_t>(i));
      for (const std::size_t j : {(i + ring.size() - 1) % ring.size(), i % ring.size()}) ears[j] = is_ear(ring, j);
    }
    cut(ring, 1);
  }

  static std::array<int, 3> triangle_at(const std::vector<int>& ring, std::size_t i) {
    const std::size_t n = ring.size();
    return {ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]};
  }

  void cut(std::vector<int>& ring, std::size_t i) {
    faces_.push_back(triangle_at(ring, i));
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
  }

  bool is_ear(const std::vector<int>& ring, std::size_t i) {
    const auto [a, b, c] = triangle_at(ring, i);
    if (!(turn(a, b, c) > 0)) return false;
    for (const int p : ring) {
      if (large_ && ++looks_ > kMostLooks) fail(ring.size());
      // Most corners lie beyond ca, the cut.
      const bool inside = turn(c, a, p) >= 0 && turn(a, b, p) >= 0 && turn(b, c, p) >= 0;
      if (inside && !(at(p) == at(a) || at(p) == at(b) || at(p) == at(c))) return false;
    }
    return true;
  }

  [[noreturn]] static void fail(std::size_t corners) {
    throw std::runtime_error(
        fmt::format("its polygons are too intricate (one has {} corners left and is not convex): "
                    "triangulate them first",
                    corners));
  }

  const std::vector<Vec3>& vertices_;
  DoubleVec3 normal_{0, 0, 0};
  std::vector<Face> faces_;
  bool large_ = false;     // the current polygon
  std::size_t looks_ = 0;  // at corners of large polygons
};

}  // namespace

std::vector<Face> triangulate(const Polygons& polygons, const std::vector<Vec3>& vertices) {
  Triangulation triangulation(vertices);
  std::size_t begin = 0;
  for (const std::size_t end : polygons.ends) {
    triangulation.add(Corners(polygons.corners).subspan(begin, end - begin));
    begin = end;
  }
  return triangulation.take();
}

}  // namespace dspm
