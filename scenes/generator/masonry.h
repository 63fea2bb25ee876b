// Walls with arched openings. A wall lies in coordinates of its own, s along it, y up and d into it, which a function
// maps to the world, so that curved walls are built like flat ones.
#pragma once

#include <functional>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// The height of a pointed arch of half-span 1 and rise 1, at t = |distance from its middle| <= 1. Each half is an arc
/// of a circle whose centre lies `pointedness` beyond the middle; 0 is a round arch.
float arch_height(float t, float pointedness);
/// Where to sample it: `count` + 1 places from 1 down to 0, at equal steps along the arc.
std::vector<float> arch_places(float pointedness, int count);

/// A hole: a closed clockwise outline that meets every vertical line at most twice. `inner` is the outline at the
/// depth, with as many points: the reveal between them may be splayed.
struct Opening {
  std::vector<Vec2> outline, inner;  // (s, y)
  float depth = 0;
};

struct Arch {
  float middle = 0, half_width = 1, sill = 0, spring = 1, pointedness = 0.4f;
  int steps = 8;  // per half
};
std::vector<Vec2> outline_of(const Arch& arch);
std::vector<Vec2> circle_outline(const Vec2& middle, float radius, int steps);
/// An arch whose reveal narrows by `splay` at both sides and the sill.
Opening arched_opening(const Arch& arch, float depth, float splay = 0);

using WallPlace = std::function<Vec3(float s, float y, float d)>;

struct Wall {
  float s_low = 0, s_high = 1, y_low = 0, y_high = 1;
  std::vector<Opening> openings;
  std::vector<float> breaks;  // where it bends
  WallPlace place;

  MeshData face() const;     // with holes
  MeshData reveals() const;  // from the face to each opening's depth
  MeshData panes() const;    // that close the openings there
  /// A block in the wall's coordinates, such as a bar of a window.
  MeshData block(const Vec3& low, const Vec3& high) const;
};

}  // namespace dspm
