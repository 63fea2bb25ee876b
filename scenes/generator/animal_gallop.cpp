// The gallop: hind feet strike one after the other, then the front feet, then the animal flies. Feet follow paths; the
// upper joints follow from the feet.
#include <algorithm>
#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/animal.h"

namespace dspm::animal {
namespace {

constexpr float kStance = 0.24f;                                       // the fraction of a stride that a foot stands
constexpr std::array<float, leg_count> kStrikes{0, .11f, .36f, .48f};  // when it comes down

float length_of(const Segment& s) { return std::hypot(s.to.x - s.from.x, s.to.y - s.from.y); }
float angle_of(const Segment& s) { return std::atan2(s.to.y - s.from.y, s.to.x - s.from.x); }
Vec2 direction(float angle) { return {std::cos(angle), std::sin(angle)}; }
Vec2 turned(Vec2 v, float angle) {
  const Vec2 d = direction(angle);
  return {v.x * d.x - v.y * d.y, v.x * d.y + v.y * d.x};
}
float wave(float phase, float peak) { return std::cos(2 * kPi * (phase - peak)); }
bool is_hind(Leg leg) { return leg == left_hind || leg == right_hind; }

/// `p`, a point of the bone at rest, where the bone is now.
Vec2 carried(const Segment& at_rest, const Segment& now, Vec2 p) {
  return now.from + turned(p - at_rest.from, angle_of(now) - angle_of(at_rest));
}
Segment turned_bone(const Segment& at_rest, Vec2 from, float turn) {
  return {from, from + direction(angle_of(at_rest) + turn) * length_of(at_rest)};
}

/// The state of a leg: where its hoof is and how far that is folded back (radians), and the swing of its uppermost
/// bone.
struct Step {
  Vec2 hoof;
  float fold = 0, swing = 0;
};
Step step_of(Leg leg, float phase) {
  const float reach = 0.43f, middle = is_hind(leg) ? -0.56f : 0.5f;
  const float p = phase - kStrikes[leg] - std::floor(phase - kStrikes[leg]);
  const float swing = (is_hind(leg) ? 0.42f : 0.34f) * wave(p, is_hind(leg) ? 0.94f : 0.96f);
  if (p < kStance) return {{middle + reach * (1 - 2 * p / kStance), 0}, 0, swing};
  const float s = (p - kStance) / (1 - kStance), lift = std::sin(kPi * std::pow(s, 0.8f));
  // Backward still when it leaves the ground, and again before it strikes.
  const float x = -reach + 2 * reach * s * s * (3 - 2 * s) - 0.8f * reach * s * (1 - s) * (1 - 2 * s);
  return {{middle + x, (is_hind(leg) ? 0.26f : 0.4f) * lift}, (is_hind(leg) ? 0.9f : 1.7f) * lift * lift, swing};
}

/// The joint between two bones of lengths a and b that reach from `from` to `to`.
Vec2 joint_between(Vec2 from, Vec2 to, float a, float b, bool forward) {
  const Vec2 line = to - from;
  const float distance = std::hypot(line.x, line.y), along = (a * a - b * b + distance * distance) / (2 * distance);
  const float across = std::sqrt(std::max(0.f, a * a - along * along)) * (forward ? 1.f : -1.f);
  return from + line * (along / distance) + Vec2{-line.y, line.x} * (across / distance);
}

/// How far `from` must come down for `to` to be within reach.
float sinking(Vec2 from, Vec2 to, float reach) {
  const float x = std::min(std::abs(to.x - from.x), reach);
  return std::max(0.f, from.y - to.y - std::sqrt(reach * reach - x * x));
}

/// The uppermost bone swings, the hoof follows its path, and the two bones between adapt. If the leg is too short, the
/// shoulder or hip sinks, as it does in a horse.
void pose_leg(Skeleton& pose, Leg leg, float phase) {
  const auto bone = [&](LegBone b) { return static_cast<std::size_t>(bone_of(leg, b)); };
  const Step step = step_of(leg, phase);
  const std::size_t root = is_hind(leg) ? rump : chest;
  const Segment& foot_at_rest = rest()[bone(foot)];
  const Vec2 top = carried(rest()[root], pose[root], rest()[bone(upper)].from);
  const Vec2 fetlock = step.hoof + Vec2{0, foot_at_rest.to.y} + turned(foot_at_rest.from - foot_at_rest.to, -step.fold);
  const float a = length_of(rest()[bone(middle)]), b = length_of(rest()[bone(cannon)]);
  Segment high = turned_bone(rest()[bone(upper)], top, step.swing);
  const Vec2 sink{0, -sinking(high.to, fetlock, 0.995f * (a + b))};
  high = {high.from + sink, high.to + sink};
  const Vec2 knee = joint_between(high.to, fetlock, a, b, !is_hind(leg));
  pose[bone(upper)] = high;
  pose[bone(middle)] = {high.to, knee};
  pose[bone(cannon)] = {knee, fetlock};
  pose[bone(foot)] = turned_bone(foot_at_rest, fetlock, -step.fold);
}

void pose_trunk(Skeleton& pose, float phase) {
  const float pitch = 0.08f * wave(phase, 0.08f), flex = 0.1f * wave(phase, 0.88f);
  const Vec2 loin = rest()[chest].from + Vec2{0, -0.02f + 0.06f * wave(phase, 0.86f)};
  pose[chest] = turned_bone(rest()[chest], loin, pitch - flex);
  pose[rump] = turned_bone(rest()[rump], loin, pitch + flex);
  const auto hang = [&](int bone, int from, float turn) {
    const auto b = static_cast<std::size_t>(bone), f = static_cast<std::size_t>(from);
    pose[b] = turned_bone(rest()[b], carried(rest()[f], pose[f], rest()[b].from), turn);
  };
  const float nod = -0.16f - 0.12f * wave(phase, 0.5f);
  hang(neck, chest, nod);
  hang(head, neck, 0.6f * nod + 0.1f);
  for (int i = 0; i < 3; ++i)
    hang(tail_root + i, i == 0 ? rump : tail_root + i - 1,
         -0.12f + (0.14f + 0.1f * static_cast<float>(i)) * wave(phase, 0.2f + 0.16f * static_cast<float>(i)));
}

}  // namespace

const Skeleton& rest() {
  static const Skeleton skeleton = [] {
    Skeleton s{};
    s[chest] = {{0, 1.28f}, {.55f, 1.28f}};
    s[rump] = {{0, 1.28f}, {-.6f, 1.3f}};
    s[neck] = {{.56f, 1.4f}, {1.08f, 1.9f}};
    s[head] = {{1.08f, 1.9f}, {1.5f, 1.55f}};
    s[tail_root] = {{-.74f, 1.4f}, {-1.0f, 1.4f}};
    s[tail_middle] = {{-1.0f, 1.4f}, {-1.24f, 1.3f}};
    s[tail_end] = {{-1.24f, 1.3f}, {-1.5f, 1.12f}};
    for (const Leg leg : {left_hind, right_hind, left_front, right_front}) {
      const Vec2 joints[]{
          is_hind(leg) ? Vec2{-.5f, 1.26f} : Vec2{.46f, 1.3f}, is_hind(leg) ? Vec2{-.36f, .92f} : Vec2{.42f, .9f},
          is_hind(leg) ? Vec2{-.69f, .57f} : Vec2{.47f, .52f}, is_hind(leg) ? Vec2{-.65f, .21f} : Vec2{.47f, .21f},
          is_hind(leg) ? Vec2{-.59f, .0f} : Vec2{.53f, .0f}};
      for (int b = 0; b < bones_a_leg; ++b)
        s[static_cast<std::size_t>(bone_of(leg, static_cast<LegBone>(b)))] = {joints[b], joints[b + 1]};
    }
    return s;
  }();
  return skeleton;
}

Skeleton gallop(float phase) {
  Skeleton pose{};
  pose_trunk(pose, phase);
  for (const Leg leg : {left_hind, right_hind, left_front, right_front}) pose_leg(pose, leg, phase);
  return pose;
}

}  // namespace dspm::animal
