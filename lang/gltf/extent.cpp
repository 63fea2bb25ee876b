#include "dspm/lang/gltf/extent.h"

#include <algorithm>
#include <cmath>

namespace dspm::gltf {
namespace {

constexpr float kLeeway = 1e-5f;  // of the largest coordinate, for rounding

Vec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

/// Returns the box of rest + weight * target, a sum for each axis.
Bounds3 moved(const Bounds3& rest, const Bounds3& target, float weight) {
  const Vec3 a = target.low * weight, b = target.high * weight;
  return {rest.low + min(a, b), rest.high + max(a, b)};
}

/// Joints may squeeze what hangs on them flat, so the matrix need not have an inverse.
Vec3 moved(const Matrix4& matrix, const Vec3& p) {
  const auto row = [&](std::size_t r) {
    const auto& m = matrix.m[r];
    return static_cast<float>(m[0] * double{p.x} + m[1] * double{p.y} + m[2] * double{p.z} + m[3]);
  };
  return {row(0), row(1), row(2)};
}

float largest_of(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

}  // namespace

PosedBoxes::PosedBoxes(const Primitive& rest) {
  for (std::size_t i = 0; i < rest.positions.count; ++i) {
    bool hangs = false;
    for (std::size_t set = 0; set < rest.joints.size(); ++set)
      for (std::size_t k = 0; k < rest.joints[set].width; ++k) {
        if (!(rest.weights[set][i][k] > 0)) continue;
        add(rest, i, static_cast<std::size_t>(std::max(rest.joints[set][i][k], 0.f))), hangs = true;
      }
    if (!hangs) add(rest, i, kStill);
  }
}

void PosedBoxes::add(const Primitive& rest, std::size_t vertex, std::size_t joint) {
  auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.joint == joint; });
  if (group == groups_.end())
    group = groups_.insert(groups_.end(), Group{joint, {}, std::vector<Bounds3>(rest.targets.size())});
  group->rest.add(vec(rest.positions[vertex]));
  for (std::size_t t = 0; t < rest.targets.size(); ++t)
    if (const Numbers& added = rest.targets[t].positions; added.count > 0) group->targets[t].add(vec(added[vertex]));
}

Bounds3 PosedBoxes::posed(const std::vector<double>& weights, const std::vector<Matrix4>& skin) const {
  Bounds3 all;
  float largest = 0;
  for (const Group& group : groups_) {
    Bounds3 box = group.rest;
    for (std::size_t t = 0; t < std::min(weights.size(), group.targets.size()); ++t)
      if (!group.targets[t].empty()) box = moved(box, group.targets[t], static_cast<float>(weights[t]));
    const Matrix4 by_joint = group.joint < skin.size() ? skin[group.joint] : Matrix4();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                   corner & 4 ? box.high.z : box.low.z};
      const Vec3 placed = moved(by_joint, p);
      all.add(placed), largest = std::max({largest, largest_of(p), largest_of(placed)});
    }
  }
  const Vec3 leeway{kLeeway * largest, kLeeway * largest, kLeeway * largest};
  return {all.low - leeway, all.high + leeway};
}

}  // namespace dspm::gltf
