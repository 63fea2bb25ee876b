#include "dspm/accel/four_triangles.h"

#include <bit>

#include "dspm/base/math/vec.h"

namespace dspm {

void FourTriangles::look_closer(const MeshRay& ray, unsigned doubtful, FourHits& hits) const {
  for (; doubtful != 0; doubtful &= doubtful - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(doubtful));
    const auto corner = [&](int c) { return Vec3{at(c, 0)[lane], at(c, 1)[lane], at(c, 2)[lane]}; };
    hits.lanes &= ~(1u << lane);
    const auto hit = dspm::meet(ray, corner(0), corner(1), corner(2));
    if (!hit) continue;
    hits.t[lane] = hit->t, hits.u[lane] = hit->uv.x, hits.v[lane] = hit->uv.y;
    hits.lanes |= 1u << lane;
  }
}

}  // namespace dspm
