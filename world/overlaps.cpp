#include "dspm/world/overlaps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/sampling.h"
#include "dspm/integrators/transport/nesting.h"
#include "dspm/integrators/transport/path_step.h"

namespace dspm {
namespace {

constexpr std::size_t kMostPairs = 1024;
constexpr int kMostRays = 1 << 15, kMostRaysOfPair = 512, kMostSurfaces = 256;
constexpr float kRounding = 1e-5f;  // surfaces that coincide overlap by this share of the bodies' size at most

const PlacedShape& shape_of(const Scene& scene, int shape) { return scene.shapes[static_cast<std::size_t>(shape)]; }

Bounds3 bounds_of(const PlacedShape& shape) {
  Bounds3 box;
  for (int i = 0; i < shape.shape->primitive_count(); ++i) box.add(shape.bounds(i));
  return box;
}
Bounds3 common_of(const Bounds3& a, const Bounds3& b) { return {max(a.low, b.low), min(a.high, b.high)}; }

/// A ray through all bodies. What it has entered and not yet left is a value, as frames may part.
class Probe {
 public:
  Probe(const Scene& bodies, float least_depth, std::map<std::pair<int, int>, Overlap>& found)
      : bodies_(bodies), least_depth_(least_depth), found_(found) {}

  void follow(const Ray& ray, FrameSet frames) { follow(ray, frames, {}, 0, 0); }

 private:
  struct Entered {
    int shape, material;
    float at;
  };

  void follow(const Ray& ray, FrameSet frames, const std::vector<Entered>& before, float passed, int surfaces) {
    if (surfaces == kMostSurfaces) return;
    for (const FrameHit& part : bodies_.accel->partition(ray, frames)) {
      if (part.hit.missed()) continue;
      const Vertex vertex(bodies_, ray, part);
      if (!is_finite(vertex.point)) continue;
      std::vector<Entered> inside = before;
      const float at = passed + part.hit.t;
      if (dot(ray.direction, vertex.point.ng) < 0)
        inside.push_back({part.hit.shape, vertex.shape.material, at});
      else
        leave(inside, part, vertex, at);
      follow(vertex.point.spawn(ray.direction), part.frames, inside, at, surfaces + 1);
    }
  }

  /// Leaves a body, which may consist of several shapes. What was entered after it and is still around overlaps it. If
  /// the ray leaves a body that it has not entered, the surfaces are boundaries, not those of bodies.
  void leave(std::vector<Entered>& inside, const FrameHit& part, const Vertex& vertex, float at) {
    const auto last = [&](auto&& is_it) {
      const auto found = std::find_if(inside.rbegin(), inside.rend(), is_it);
      return found == inside.rend() ? inside.end() : std::next(found).base();
    };
    auto left = last([&](const Entered& each) { return each.shape == part.hit.shape; });
    const bool by_shape = left != inside.end();
    if (!by_shape) left = last([&](const Entered& each) { return each.material == vertex.shape.material; });
    if (left == inside.end()) return inside.clear();
    for (auto other = left + 1; other != inside.end(); ++other)
      if (other->material != left->material || by_shape) report(*left, *other, part.frames, vertex, at);
    inside.erase(left);
  }

  void report(const Entered& first, const Entered& second, FrameSet frames, const Vertex& end, float at) {
    const float depth = at - second.at;
    const FrameSet both = undecided(bodies_, first.shape, second.shape, frames);
    if (depth < least_depth_ || both.empty()) return;
    Overlap& known = found_[std::minmax(first.shape, second.shape)];
    if (depth > known.depth) known = {first.shape, second.shape, both, end.point.p + 0.5f * depth * end.wo, depth};
  }

  const Scene& bodies_;
  float least_depth_;
  std::map<std::pair<int, int>, Overlap>& found_;
};

}  // namespace

FrameSet undecided(const Scene& bodies, int shape, int other, FrameSet frames) {
  const int materials[2] = {shape_of(bodies, shape).material, shape_of(bodies, other).material};
  FrameSet undecided;
  for_each_nesting(bodies, materials, frames, [&](FrameSet common, std::span<const Material* const> states) {
    if (states[0] == nullptr || states[1] == nullptr) return;
    const bool first_is_lower = states[0]->priority() < states[1]->priority();
    if (states[0]->priority() == states[1]->priority() || states[first_is_lower ? 0 : 1]->scatters_inside())
      undecided |= common;
  });
  return undecided;
}

std::vector<Neighbours> neighbours(const Scene& bodies) {
  std::vector<Bounds3> boxes;
  for (const PlacedShape& shape : bodies.shapes) boxes.push_back(bounds_of(shape));
  std::vector<int> by_x(boxes.size());
  std::iota(by_x.begin(), by_x.end(), 0);
  const auto box = [&](int shape) -> const Bounds3& { return boxes[static_cast<std::size_t>(shape)]; };
  std::stable_sort(by_x.begin(), by_x.end(), [&](int a, int b) { return box(a).low.x < box(b).low.x; });
  std::vector<Neighbours> pairs;
  for (std::size_t i = 0; i < by_x.size(); ++i)
    for (std::size_t j = i + 1; j < by_x.size() && box(by_x[j]).low.x < box(by_x[i]).high.x; ++j) {
      const auto [a, b] = std::minmax(by_x[i], by_x[j]);
      const Bounds3 common = common_of(box(a), box(b));
      const FrameSet together = shape_of(bodies, a).frames & shape_of(bodies, b).frames;
      if (common.empty() || undecided(bodies, a, b, together).empty()) continue;
      pairs.push_back({a, b, common});
      if (pairs.size() == kMostPairs) return pairs;
    }
  return pairs;
}

std::vector<Overlap> find_overlaps(const Scene& bodies, const std::vector<Neighbours>& pairs) {
  std::map<std::pair<int, int>, Overlap> found;
  const int rays = std::min(kMostRaysOfPair, kMostRays / std::max(1, static_cast<int>(pairs.size())));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Neighbours& pair = pairs[i];
    Bounds3 whole = bounds_of(shape_of(bodies, pair.a));
    whole.add(bounds_of(shape_of(bodies, pair.b)));
    const float size = length(whole.extent());
    Probe probe(bodies, kRounding * size, found);
    const FrameSet together = shape_of(bodies, pair.a).frames & shape_of(bodies, pair.b).frames;
    const PathRandom random(0, Stream::camera, i, 0);
    for (int ray = 0; ray < rays; ++ray) {
      const Vec2 xy = random.pair(ray, 0), way = random.pair(ray, 1);
      const Vec3 share{xy.x, xy.y, random.number(ray, 2)}, through = pair.common.low + share * pair.common.extent();
      probe.follow({through - uniform_sphere(way) * size, uniform_sphere(way)}, together);
    }
  }
  std::vector<Overlap> overlaps;
  for (const auto& [shapes, overlap] : found) overlaps.push_back(overlap);
  return overlaps;
}

}  // namespace dspm
