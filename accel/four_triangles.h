// A ray against four triangles side by side: the SIMD twin of meet() in meet.h. It does the same operations in the same
// order, so its hits are identical bit for bit; it leaves triangles whose edge the ray hits to the scalar one.
#pragma once

#include "dspm/accel/meet.h"
#include "dspm/accel/triangle_packet.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/simd.h"

namespace dspm {

/// A ray in four equal lanes. The inputs of the float test are ordered by the ray's axes.
struct FourRays {
  MeshRay one;
  __m128 x, y, z, sx, sy, sz, near_origin[3], inverse[3];

  explicit FourRays(const Ray& ray) : one(ray) {
    const TriangleRay& r = one.triangle;
    x = _mm_set1_ps(r.origin[r.kx]), y = _mm_set1_ps(r.origin[r.ky]), z = _mm_set1_ps(r.origin[r.kz]);
    sx = _mm_set1_ps(r.sx), sy = _mm_set1_ps(r.sy), sz = _mm_set1_ps(r.sz);
    for (int axis = 0; axis < 3; ++axis) {
      near_origin[axis] = _mm_set1_ps(one.box.near_origin[axis]);
      inverse[axis] = _mm_set1_ps(one.box.inverse[axis]);
    }
  }
};

struct FourHits {
  alignas(16) float t[4], u[4], v[4];
  unsigned lanes;  // bits of the triangles that are hit
};

class FourTriangles {
 public:
  using Vertices = TrianglePacket::Vertices;

  /// The vertices must outlive this.
  FourTriangles(const FourRays& ray, const Vertices& vertices) : vertices_(vertices) {
    const TriangleRay& r = ray.one.triangle;
    __m128 x[3], y[3];
    for (int c = 0; c < 3; ++c) {
      const __m128 z = coordinate(c, r.kz) - ray.z;
      x[c] = (coordinate(c, r.kx) - ray.x) - ray.sx * z;
      y[c] = (coordinate(c, r.ky) - ray.y) - ray.sy * z;
      z_[c] = ray.sz * z;
    }
    u_ = x[2] * y[1] - y[2] * x[1];
    v_ = x[0] * y[2] - y[0] * x[2];
    w_ = x[1] * y[0] - y[1] * x[0];
  }

  /// Returns the triangles that the ray may hit at a distance in (0, limit]: no two of their edge functions have
  /// opposite signs, and their corners are neither all before the ray's origin nor all too far. Zero is no sign: the
  /// triangle test examines that case. It keeps distances between those of the corners.
  unsigned candidates(float limit) const {
    const __m128 zero = _mm_setzero_ps();
    const __m128 outside = _mm_and_ps(_mm_cmplt_ps(least(u_, v_, w_), zero), _mm_cmpgt_ps(most(u_, v_, w_), zero));
    const __m128 apart = _mm_or_ps(_mm_cmple_ps(most(z_[0], z_[1], z_[2]), zero),
                                   _mm_cmpgt_ps(least(z_[0], z_[1], z_[2]), _mm_set1_ps(limit)));
    return 15u & ~static_cast<unsigned>(_mm_movemask_ps(_mm_or_ps(outside, apart)));
  }

  /// Returns the candidates whose boxes the ray enters within `limit`: a hit is never before that, see meet.h.
  unsigned entered(const FourRays& ray, unsigned candidates, float limit) const {
    const __m128 enter = entry(ray), infinity = _mm_set1_ps(kInfinity);
    const __m128 late = _mm_and_ps(_mm_cmpgt_ps(enter, _mm_set1_ps(limit)), _mm_cmplt_ps(enter, infinity));
    return candidates & ~static_cast<unsigned>(_mm_movemask_ps(late));
  }

  /// Tests the `wanted` ones of the candidates.
  FourHits meet(const FourRays& ray, unsigned wanted) const {
    const __m128 zero = _mm_setzero_ps(), infinity = _mm_set1_ps(kInfinity), t_max = _mm_set1_ps(ray.one.t_max);
    const __m128 determinant = (u_ + v_) + w_, scale = _mm_set1_ps(1) / determinant;
    // std::min(a, b) is _mm_min_ps(b, a) if a or b is NaN, or both are zeros; likewise for max.
    const __m128 nearest = _mm_min_ps(_mm_min_ps(z_[2], z_[1]), z_[0]);
    const __m128 farthest = _mm_max_ps(_mm_max_ps(z_[2], z_[1]), z_[0]);
    const Planes planes = plane_distances(ray, wanted);
    __m128 t = _mm_max_ps(_mm_min_ps(farthest, planes.t), nearest);
    const __m128 enter = entry(ray);
    __m128 good = _mm_and_ps(_mm_and_ps(_mm_cmpgt_ps(t, zero), _mm_cmplt_ps(t, t_max)), _mm_cmplt_ps(t, infinity));
    good = _mm_and_ps(_mm_and_ps(good, planes.exist), _mm_cmpneq_ps(determinant, zero));
    t = _mm_blendv_ps(t, enter, _mm_and_ps(_mm_cmpgt_ps(enter, t), _mm_cmplt_ps(enter, infinity)));
    good = _mm_and_ps(good, _mm_cmplt_ps(t, t_max));

    FourHits hits;
    _mm_store_ps(hits.t, t);
    _mm_store_ps(hits.u, v_ * scale);
    _mm_store_ps(hits.v, w_ * scale);
    hits.lanes = wanted & static_cast<unsigned>(_mm_movemask_ps(good));
    const __m128 on_edge = _mm_or_ps(_mm_or_ps(_mm_cmpeq_ps(u_, zero), _mm_cmpeq_ps(v_, zero)),
                                     _mm_or_ps(_mm_cmpeq_ps(w_, zero), _mm_cmpunord_ps(determinant, determinant)));
    const unsigned doubtful = wanted & static_cast<unsigned>(_mm_movemask_ps(on_edge));
    if (doubtful != 0) [[unlikely]]
      look_closer(ray.one, doubtful, hits);
    return hits;
  }

 private:
  struct Planes {
    __m128 t, exist;
  };

  static __m128 least(__m128 a, __m128 b, __m128 c) { return _mm_min_ps(_mm_min_ps(a, b), c); }
  static __m128 most(__m128 a, __m128 b, __m128 c) { return _mm_max_ps(_mm_max_ps(a, b), c); }
  static __m128 absolute(__m128 a) { return _mm_andnot_ps(_mm_set1_ps(-0.f), a); }

  const float* at(int corner, int axis) const { return vertices_[corner][axis]; }
  __m128 coordinate(int corner, int axis) const { return _mm_load_ps(at(corner, axis)); }

  /// Returns where the ray hits the triangles' planes; only wanted lanes are valid.
  Planes plane_distances(const FourRays& ray, unsigned wanted) const {
    __m128 t[2] = {_mm_setzero_ps(), _mm_setzero_ps()}, exist[2] = {_mm_setzero_ps(), _mm_setzero_ps()};
    for (int pair = 0; pair < 2; ++pair) {
      if ((wanted >> 2 * pair & 3) == 0) continue;
      const TriangleRay& r = ray.one.triangle;
      __m128d a[3], b[3], from_origin[3], d[3];
      for (int axis = 0; axis < 3; ++axis) {
        const __m128d p0 = two(at(0, axis) + 2 * pair);
        a[axis] = two(at(1, axis) + 2 * pair) - p0;
        b[axis] = two(at(2, axis) + 2 * pair) - p0;
        from_origin[axis] = p0 - _mm_set1_pd(double{r.origin[axis]});
        d[axis] = _mm_set1_pd(double{r.direction[axis]});
      }
      const __m128d n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
      t[pair] = _mm_cvtpd_ps(dot(n, from_origin) / dot(n, d));
      exist[pair] = _mm_castpd_ps(_mm_cmpgt_pd(dot(n, n), _mm_setzero_pd()));
    }
    return {_mm_movelh_ps(t[0], t[1]), _mm_shuffle_ps(exist[0], exist[1], _MM_SHUFFLE(2, 0, 2, 0))};
  }
  static __m128d two(const float* p) {
    return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))));
  }
  static __m128d dot(const __m128d* a, const __m128d* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  /// Does BoxRay::entry for the triangles' boxes with margin.
  __m128 entry(const FourRays& ray) const {
    __m128 low[3], high[3], largest = _mm_setzero_ps();
    for (int axis = 0; axis < 3; ++axis) {
      const __m128 p[3] = {coordinate(0, axis), coordinate(1, axis), coordinate(2, axis)};
      low[axis] = least(p[0], p[1], p[2]), high[axis] = most(p[0], p[1], p[2]);
      largest = most(absolute(low[axis]), absolute(high[axis]), largest);
    }
    const __m128 margin = _mm_set1_ps(kBoxMargin) * largest;
    __m128 t = _mm_setzero_ps();
    for (int axis = 0; axis < 3; ++axis) {
      const bool negative = ray.one.box.negative[static_cast<std::size_t>(axis)];
      const __m128 plane = negative ? high[axis] + margin : low[axis] - margin;
      t = _mm_max_ps((plane - ray.near_origin[axis]) * ray.inverse[axis], t);
    }
    return t;
  }

  void look_closer(const MeshRay& ray, unsigned doubtful, FourHits& hits) const;

  const Vertices& vertices_;
  __m128 u_, v_, w_, z_[3];
};

}  // namespace dspm
