#include "dspm/lights/emitter_sight.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dspm/base/math/sampling.h"
#include "dspm/lights/seen_triangle.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {
namespace {

/// Returns the normal of a primitive that is flat; nullopt of others.
std::optional<Vec3> flat_normal(const PlacedShape& placed, int primitive) {
  const Vec3 normal = placed.sample_area(primitive, {0.5f, 0.5f}).point.ng;
  if (placed.shape->triangles() != nullptr) return normal;
  constexpr int kAlong = 8;
  for (int y = 0; y < kAlong; ++y)
    for (int x = 0; x < kAlong; ++x) {
      const Vec2 u{(static_cast<float>(x) + 0.5f) / kAlong, (static_cast<float>(y) + 0.5f) / kAlong};
      if (!(dot(placed.sample_area(primitive, u).point.ng, normal) > 1 - 1e-5f)) return std::nullopt;
    }
  return normal;
}

LightBounds bounds_of_primitive(const PlacedShape& placed, int primitive, bool two_sided) {
  LightBounds bounds{placed.bounds(primitive)};
  bounds.two_sided = two_sided;
  const auto normal = flat_normal(placed, primitive);
  if (normal && is_finite(*normal)) bounds.axis = *normal, bounds.spread = 0;
  return bounds;
}

/// Returns the factor by which the transform scales all lengths; nullopt if it does not scale them alike.
std::optional<float> scale_of(const PlacedShape& placed) {
  if (!placed.in_object_space()) return 1;
  const std::array<Vec3, 3> axes{placed.to_world.vector({1, 0, 0}), placed.to_world.vector({0, 1, 0}),
                                 placed.to_world.vector({0, 0, 1})};
  const float scale2 = length2(axes[0]);
  constexpr float kTolerance = 1e-5f;
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(length2(axes[i]) - scale2) <= kTolerance * scale2 &&
          std::abs(dot(axes[i], axes[(i + 1) % 3])) <= kTolerance * scale2))
      return std::nullopt;
  return std::sqrt(scale2);
}

}  // namespace

LightBounds bounds_of_emitter(const PlacedShape& placed, bool two_sided) {
  LightBounds all = bounds_of_primitive(placed, 0, two_sided);
  for (int i = 1; i < placed.shape->primitive_count(); ++i) all.add(bounds_of_primitive(placed, i, two_sided));
  return all;
}

EmitterSight::EmitterSight(const PlacedShape& placed, std::span<const float> powers, bool two_sided) : placed_(placed) {
  if (const auto radius = placed.shape->sphere_radius())
    if (const auto scale = scale_of(placed))
      radius_ = *radius * *scale, center_ = placed.in_object_space() ? placed.to_world.point({}) : Vec3{};
  if (powers.size() <= 2) {
    std::copy(powers.begin(), powers.end(), of_two_.begin());
    return;
  }
  std::vector<LightTree::Lamp> lamps;
  for (std::size_t i = 0; i < powers.size(); ++i)
    lamps.push_back({bounds_of_primitive(placed, static_cast<int>(i), two_sided), static_cast<double>(powers[i])});
  tree_ = LightTree(lamps);
}

std::array<Vec3, 3> EmitterSight::corners(int primitive) const {
  const TriangleMesh& mesh = *placed_.shape->triangles();
  std::array<Vec3, 3> corners{mesh.vertex(primitive, 0), mesh.vertex(primitive, 1), mesh.vertex(primitive, 2)};
  if (placed_.in_object_space())
    for (Vec3& corner : corners) corner = placed_.to_world.point(corner);
  return corners;
}

// By solid angle if they are near: the two halves of a rectangle are then one.
EmitterSight::Pair EmitterSight::chances_of_two(const Vec3& from) const {
  Pair weights{static_cast<double>(of_two_[0]), static_cast<double>(of_two_[1])};
  if (of_two_[1] > 0 && placed_.shape->triangles() != nullptr) {
    const SeenTriangle first(corners(0), from), second(corners(1), from);
    if (first.is_near() && second.is_near())
      weights.first *= first.solid_angle() / static_cast<double>(placed_.shape->area(0)),
          weights.second *= second.solid_angle() / static_cast<double>(placed_.shape->area(1));
  }
  const double share = weights.first / (weights.first + weights.second);
  return {share, 1 - share};
}

EmitterSight::Choice EmitterSight::choose(const Vec3& from, float u) const {
  if (!tree_.empty()) {
    Choice choice{0, 0, 0};
    tree_.choose({from}, 1, static_cast<double>(u), [&](int lamp, float probability, int, float rest) {
      choice = {lamp, probability, rest};
    });
    return choice;
  }
  const auto [first, second] = chances_of_two(from);
  const double number = static_cast<double>(u);
  constexpr double kBelowOne = 1 - 0x1p-24;
  if (number < first) return {0, static_cast<float>(first), static_cast<float>(std::min(number / first, kBelowOne))};
  return {1, static_cast<float>(second), static_cast<float>(std::min((number - first) / second, kBelowOne))};
}

float EmitterSight::probability(const Vec3& from, int primitive) const {
  if (!tree_.empty()) return tree_.probability({from}, primitive);
  const auto [first, second] = chances_of_two(from);
  return static_cast<float>(primitive == 0 ? first : second);
}

std::optional<float> EmitterSight::cone(const Vec3& from) const {
  const float d2 = length2(center_ - from), sine2 = radius_ * radius_ / d2;
  if (!(radius_ > 0 && sine2 < 0.9999f)) return std::nullopt;
  return sine2 / (1 + std::sqrt(1 - sine2));
}

// A sphere is met where the ray first comes as near to its centre as its radius. [Pharr, Jakob, Humphreys, 6.2.4]
std::optional<EmitterSight::Point> EmitterSight::sample(const Vec3& from, int primitive, Vec2 u) const {
  if (placed_.shape->triangles() != nullptr) {
    const SeenTriangle seen(corners(primitive), from);
    if (!seen.is_near()) return std::nullopt;
    return Point{placed_.surface_point(primitive, seen.sample(u)), static_cast<float>(1 / seen.solid_angle())};
  }
  const auto versine = cone(from);
  if (!versine) return std::nullopt;
  const Vec3 d = center_ - from;
  const float distance = length(d);
  const Basis basis = Basis::around(d / distance);
  const Vec3 local = uniform_cone(u, *versine);
  const float sine2 = local.x * local.x + local.y * local.y;
  const float t = distance * local.z - std::sqrt(std::max(0.f, radius_ * radius_ - distance * distance * sine2));
  // From the centre, whose direction keeps its digits if the sphere is far away.
  const Vec3 normal{t * local.x, t * local.y, t * local.z - distance};
  const Vec3 p = center_ + basis.to_world(normal * (radius_ / length(normal)));
  const auto numbers = placed_.area_numbers(primitive, p);
  if (!numbers) return std::nullopt;
  return Point{placed_.sample_area(primitive, *numbers).point, uniform_cone_pdf_w(*versine)};
}

std::optional<float> EmitterSight::pdf_w(const Vec3& from, int primitive) const {
  if (placed_.shape->triangles() != nullptr) {
    const SeenTriangle seen(corners(primitive), from);
    return seen.is_near() ? std::optional(static_cast<float>(1 / seen.solid_angle())) : std::nullopt;
  }
  const auto versine = cone(from);
  return versine ? std::optional(uniform_cone_pdf_w(*versine)) : std::nullopt;
}

}  // namespace dspm
