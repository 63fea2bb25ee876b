// The glass animal: a body of round cones that melt into each other, meshed once, and a skeleton that carries it
// through a gallop. It looks along +x and stands on y = 0; metres.
#pragma once

#include <array>
#include <vector>

#include "dspm/base/math/vec.h"
#include "scenes/generator/isosurface.h"

namespace dspm::animal {

/// Bones turn in planes of constant z only. The last four come once for each leg.
enum Bone { chest, rump, neck, head, tail_root, tail_middle, tail_end, leg_bones };
enum LegBone { upper, middle, cannon, foot, bones_a_leg };
enum Leg { left_hind, right_hind, left_front, right_front, leg_count };
inline constexpr int kBones = leg_bones + int{leg_count} * int{bones_a_leg};

constexpr int bone_of(Leg leg, LegBone bone) { return leg_bones + int{leg} * int{bones_a_leg} + int{bone}; }

/// Where a bone begins and ends: (x, y).
struct Segment {
  Vec2 from, to;
};
using Skeleton = std::array<Segment, kBones>;

/// The pose in which the body is modelled: standing, all joints open.
const Skeleton& rest();
/// The pose at `phase` of a stride (any number; its integer part does not matter), over the ground it has covered.
Skeleton gallop(float phase);
inline constexpr float kStride = 3.9f;  // metres per stride

/// The body at rest, and how far each of its vertices follows each bone: kBones weights per vertex, of sum 1.
struct Body {
  MeshData mesh;
  std::vector<std::array<float, kBones>> weights;
};
Body make_body();

/// The body in a pose, with normals.
MeshData posed(const Body& body, const Skeleton& skeleton);

}  // namespace dspm::animal
