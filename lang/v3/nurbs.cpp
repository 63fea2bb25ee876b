#include "dspm/lang/v3/nurbs.h"

#include <algorithm>
#include <array>

namespace dspm::v3 {
namespace {

/// x, y, z and the weight, in double: knots may lie close together.
using Weighted = std::array<double, 4>;

Weighted mix(const Weighted& a, const Weighted& b, double t) {
  Weighted result;
  for (std::size_t c = 0; c < 4; ++c) result[c] = (1 - t) * a[c] + t * b[c];
  return result;
}

struct OnCurve {
  Weighted p, derivative;
};

/// Returns the index of the span that holds t: its first knot. Among its control points, it is that of the last one.
int span_of(const KnotVector& k, float t) {
  const auto begin = k.knots.begin() + k.order - 1, end = k.knots.begin() + k.count;
  return k.order - 2 + static_cast<int>(std::max(std::upper_bound(begin, end, t) - begin, std::ptrdiff_t{1}));
}

/// Evaluates the curve from the `points` of the span, as many as the order. [de Boor 1972, On Calculating with
/// B-Splines]
OnCurve de_boor(const KnotVector& k, int span, double t, std::vector<Weighted> points) {
  const int degree = k.order - 1;
  const auto knot = [&](int i) { return static_cast<double>(k.knots[static_cast<std::size_t>(i)]); };
  OnCurve result{};
  for (int level = 1; level <= degree; ++level)
    for (int i = degree; i >= level; --i) {
      const double from = knot(span - degree + i), width = knot(span + 1 + i - level) - from;
      Weighted &before = points[static_cast<std::size_t>(i) - 1], &here = points[static_cast<std::size_t>(i)];
      if (level == degree)
        for (std::size_t c = 0; c < 4 && width > 0; ++c) result.derivative[c] = degree * (here[c] - before[c]) / width;
      here = mix(before, here, width > 0 ? (t - from) / width : 0);
    }
  result.p = points.back();
  return result;
}

Vec3 narrow(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

/// Returns the derivative of p / w.
Vec3 derivative(const Weighted& p, const Weighted& d) {
  const auto by = [&](std::size_t c) { return (d[c] - p[c] / p[3] * d[3]) / p[3]; };
  return narrow(by(0), by(1), by(2));
}

}  // namespace

SplinePoint NurbsSurface::at(float u, float v) const {
  const int u_span = span_of(u_, u), v_span = span_of(v_, v);
  std::vector<Weighted> across, across_by_u;
  for (int j = v_span - v_.order + 1; j <= v_span; ++j) {
    std::vector<Weighted> row;
    for (int i = u_span - u_.order + 1; i <= u_span; ++i) {
      const float* p = &points_[4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(u_.count) +
                                     static_cast<std::size_t>(i))];
      row.push_back({p[0], p[1], p[2], p[3]});
    }
    const OnCurve on_row = de_boor(u_, u_span, u, std::move(row));
    across.push_back(on_row.p), across_by_u.push_back(on_row.derivative);
  }
  const OnCurve by_v = de_boor(v_, v_span, v, std::move(across));
  const Weighted& p = by_v.p;
  return {narrow(p[0] / p[3], p[1] / p[3], p[2] / p[3]),
          derivative(p, de_boor(v_, v_span, v, std::move(across_by_u)).p), derivative(p, by_v.derivative)};
}

}  // namespace dspm::v3
