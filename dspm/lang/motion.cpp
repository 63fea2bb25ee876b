#include "dspm/lang/motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dspm/math/vanishing.h"

namespace dspm {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;
using Quaternion = std::array<double, 4>;  // x, y, z, w

constexpr Matrix4 kZero{{{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}};

// Equal values stay equal: rounding would make them distinct states.
double mix(double a, double b, double t) { return a == b ? a : (1 - t) * a + t * b; }

template <std::size_t N>
std::array<double, N> mix(const std::array<double, N>& a, const std::array<double, N>& b, double t) {
  std::array<double, N> r;
  for (std::size_t i = 0; i < N; ++i) r[i] = mix(a[i], b[i], t);
  return r;
}

/// M = translate * rotate * stretch.
struct Decomposition {
  std::array<double, 3> translation;
  Quaternion rotation;
  Matrix3 stretch;
};

Quaternion quaternion_of(const Matrix4& rotation) {
  const auto& m = rotation.m;
  const double trace = m[0][0] + m[1][1] + m[2][2];
  if (trace > 0) {
    const double s = 2 * std::sqrt(1 + trace);
    return {(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4};
  }
  std::size_t i = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (m[k][k] > m[i][i]) i = k;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const double s = 2 * std::sqrt(std::max(0.0, 1 + m[i][i] - m[j][j] - m[k][k]));
  Quaternion q;
  q[i] = s / 4, q[j] = (m[j][i] + m[i][j]) / s, q[k] = (m[k][i] + m[i][k]) / s, q[3] = (m[k][j] - m[j][k]) / s;
  return q;
}

Matrix4 matrix_of(const Quaternion& q) {
  const auto [x, y, z, w] = q;
  Matrix4 r;
  r.m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0};
  r.m[1] = {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0};
  r.m[2] = {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0};
  return r;
}

Quaternion slerp(const Quaternion& a, Quaternion b, double t) {
  double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  if (cosine < 0) {  // q and -q are the same rotation: take the shorter arc
    for (double& v : b) v = -v;
    cosine = -cosine;
  }
  const double angle = std::acos(std::min(cosine, 1.0));
  Quaternion r = mix(a, b, t);
  if (angle > 1e-6)
    for (std::size_t i = 0; i < 4; ++i)
      r[i] = (std::sin((1 - t) * angle) * a[i] + std::sin(t * angle) * b[i]) / std::sin(angle);
  const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  for (double& v : r) v /= length;
  return r;
}

double determinant3(const Matrix4& a) {
  const auto& m = a.m;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// The rotation nearest to a regular linear map, by Newton's iteration R <- (s R + R^-T / s) / 2; the scaling s by
/// determinants makes a few steps enough [Higham 1986, Computing the Polar Decomposition]. Mirroring goes into the
/// stretch.
Matrix4 rotation_of(Matrix4 linear) {
  if (determinant3(linear) < 0)
    for (std::size_t i = 0; i < 3; ++i)
      for (double& v : linear.m[i]) v = -v;
  for (int step = 0; step < 100; ++step) {
    const auto inverse = linear.inverse();
    if (!inverse) break;
    const double s = 1 / std::cbrt(determinant3(linear));
    double change = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        change = std::max(change, std::abs(s * linear.m[i][j] - inverse->m[j][i] / s));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) linear.m[i][j] = (s * linear.m[i][j] + inverse->m[j][i] / s) / 2;
    if (change < 1e-15) break;
  }
  return linear;
}

Decomposition decompose(const Matrix4& matrix) {
  const auto& m = matrix.m;
  Matrix4 linear = matrix;
  for (std::size_t i = 0; i < 3; ++i) linear.m[i][3] = 0;
  const Matrix4 rotation = rotation_of(linear);
  Matrix3 stretch{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) stretch[i][j] += rotation.m[k][i] * linear.m[k][j];
  return {{m[0][3], m[1][3], m[2][3]}, quaternion_of(rotation), stretch};
}

Matrix4 interpolate(const Matrix4& a, const Matrix4& b, double t) {
  if (a == b) return a;
  Decomposition from = decompose(a), to = decompose(b);
  // Nothing has no rotation, so it takes the other's.
  if (vanishes(a)) from.rotation = to.rotation, from.stretch = {};
  if (vanishes(b)) to.rotation = from.rotation, to.stretch = {};
  const auto translation = mix(from.translation, to.translation, t);
  Matrix4 stretch;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) stretch.m[i][j] = mix(from.stretch[i][j], to.stretch[i][j], t);
  return Matrix4::translate(translation[0], translation[1], translation[2]) *
         matrix_of(slerp(from.rotation, to.rotation, t)) * stretch;
}

bool same_sequence(const std::vector<TransformOp>& a, const std::vector<TransformOp>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const TransformOp& x, const TransformOp& y) { return x.kind == y.kind; });
}

Matrix4 product(const std::vector<TransformOp>& ops) {
  Matrix4 r;
  for (const TransformOp& op : ops) r = r * op.matrix();
  return r;
}

double eased(double t, Ease ease) {
  switch (ease) {
    case Ease::linear: return t;
    case Ease::smooth: return t * t * (3 - 2 * t);
    case Ease::step: break;
  }
  return 0;
}

Matrix4 interpolate(const std::vector<TransformOp>& a, const std::vector<TransformOp>& b, double t) {
  if (!same_sequence(a, b)) return interpolate(product(a), product(b), t);
  Matrix4 r;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].kind == TransformOp::Kind::matrix)
      r = r * interpolate(a[i].matrix(), b[i].matrix(), t);
    else
      r = r * TransformOp{a[i].kind, mix(a[i].arguments, b[i].arguments, t)}.matrix();
  }
  return r;
}

}  // namespace

Matrix4 TransformOp::matrix() const {
  const auto& v = arguments;
  switch (kind) {
    case Kind::translate: return Matrix4::translate(v[0], v[1], v[2]);
    case Kind::rotate: {
      const double length2 = v[1] * v[1] + v[2] * v[2] + v[3] * v[3];
      return length2 > 0 && std::isfinite(length2) ? Matrix4::rotate(v[0], v[1], v[2], v[3]) : kZero;
    }
    case Kind::scale: return Matrix4::scale(v[0], v[1], v[2]);
    case Kind::look_at:
      return Matrix4::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}).value_or(kZero);
    case Kind::matrix: break;
  }
  return Matrix4::from_columns(v);
}

Matrix4 KeyedTransform::at(Moment moment) const {
  const auto next = std::upper_bound(keys_.begin(), keys_.end(), moment,
                                     [](Moment m, const TransformKey& key) { return m < key.moment; });
  if (next == keys_.begin()) return product(keys_.front().ops);
  const TransformKey& from = *(next - 1);
  if (next == keys_.end() || from.moment == moment) return product(from.ops);
  return interpolate(from.ops, next->ops, eased(fraction(from.moment, next->moment, moment), from.ease));
}

void Motion::multiply(const Matrix4& matrix) {
  if (factors_.empty() || factors_.back().keyed)
    factors_.push_back({matrix, {}, false});
  else
    factors_.back().fixed = factors_.back().fixed * matrix;
}

void Motion::multiply(KeyedTransform keyed) {
  if (factors_.empty() || factors_.back().keyed) factors_.emplace_back();
  factors_.back().keyed = std::make_shared<const KeyedTransform>(std::move(keyed));
}

Matrix4 Motion::at(Moment moment) const {
  Matrix4 r;
  for (const Factor& factor : factors_) {
    r = r * factor.fixed;
    if (!factor.keyed) continue;
    const Matrix4 keyed = factor.keyed->at(moment);
    r = r * (factor.inverted ? keyed.inverse().value_or(kZero) : keyed);
  }
  return r;
}

bool Motion::is_keyed() const { return keyed_count() > 0; }

int Motion::keyed_count() const {
  return static_cast<int>(
      std::count_if(factors_.begin(), factors_.end(), [](const Factor& factor) { return factor.keyed != nullptr; }));
}

Motion Motion::inverse() const {
  Motion result;
  for (auto factor = factors_.rbegin(); factor != factors_.rend(); ++factor) {
    if (factor->keyed) result.factors_.push_back({Matrix4{}, factor->keyed, !factor->inverted});
    result.multiply(factor->fixed.inverse().value_or(kZero));
  }
  return result;
}

}  // namespace dspm
