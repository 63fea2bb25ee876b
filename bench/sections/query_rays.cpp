#include "bench/sections/query_rays.h"

#include <cmath>

#include "dspm/base/math/rng.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"

namespace dspm {
namespace {

constexpr int kResolution = 128;

}  // namespace

std::vector<Query> camera_rays(const QueryScene& scene) {
  std::vector<Query> queries;
  const Vec3 forward = normalize(scene.look_at - scene.eye), right = normalize(cross({0, 1, 0}, forward));
  const Vec3 up = cross(forward, right);
  for (int y = 0; y < kResolution; ++y) {
    for (int x = 0; x < kResolution; ++x) {
      const float sx = (static_cast<float>(x) + 0.5f) / kResolution - 0.5f;
      const float sy = 0.5f - (static_cast<float>(y) + 0.5f) / kResolution;
      queries.push_back({{scene.eye, normalize(forward + right * sx + up * sy)}, scene.all});
    }
  }
  return queries;
}

std::vector<Query> bounced(const QueryScene& scene, const Accel& accel, const std::vector<Query>& queries) {
  std::vector<Query> next;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const PathRandom random(1, Stream::camera, i, 0);
    for (const FrameHit& part : accel.partition(queries[i].ray, queries[i].frames)) {
      if (part.hit.missed()) continue;
      const PlacedShape& placed = scene.placed[static_cast<std::size_t>(part.hit.shape)];
      const SurfacePoint s = placed.seen(part.hit.primitive, part.hit.uv, queries[i].ray.direction);
      const Vec2 u = random.pair(0, 0);
      const float z = std::sqrt(u.x), r = std::sqrt(1 - u.x), phi = 2 * kPi * u.y;
      const Vec3 n = dot(s.ng, queries[i].ray.direction) > 0 ? -s.ng : s.ng;
      next.push_back({s.spawn(Basis::around(n).to_world({r * std::cos(phi), r * std::sin(phi), z})), part.frames});
    }
  }
  return next;
}

}  // namespace dspm
