// The apse: a half round with five lancet windows under half a dome, and the altar on its steps.
#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/hall.h"
#include "scenes/generator/modelling.h"

namespace dspm::hall {
namespace {

constexpr int kWindows = 5, kSegments = 40;
constexpr float kHalfRound = kPi * kNave;  // the wall's length

/// s runs around the half round from small z to large z.
Vec3 around(float s, float y, float d) {
  const float angle = s / kNave - 0.5f * kPi, radius = kNave + d;
  return {kEnd + radius * std::cos(angle), y, radius * std::sin(angle)};
}

void add_wall(Parts& parts) {
  Wall wall{0, kHalfRound, -0.05f, kVaultSpring + 0.06f, {}, {}, around};
  for (int i = 1; i < kSegments; ++i) wall.breaks.push_back(kHalfRound * static_cast<float>(i) / kSegments);
  for (int i = 0; i < kWindows; ++i) {
    const Arch window{kHalfRound * (static_cast<float>(i) + 0.5f) / kWindows, 0.75f, 2.6f, 6.4f, 0.6f, 9};
    wall.openings.push_back(arched_opening(window, 0.5f, 0.2f));
    append(parts.trim, wall.block({window.middle - 0.04f, 2.6f, 0.38f}, {window.middle + 0.04f, 7.4f, 0.48f}));
  }
  append(parts.stone, wall.face());
  append(parts.stone, wall.reveals());
  append(parts.shady, wall.panes());
}

/// The courses under windows and dome; the upper one covers the seam between wall and dome.
void add_courses(MeshData& trim) {
  for (const float y : {2.2f, kVaultSpring}) {
    std::vector<Vec3> path;
    for (int i = -1; i <= kSegments + 1; ++i)
      path.push_back(around(kHalfRound * static_cast<float>(i) / kSegments, y, 0));
    append(trim, sweep(ellipse(0.13f, 0.13f, 8), path, {0, 1, 0}));
  }
}

void add_dome(Parts& parts) {
  const std::vector<float> places = arch_places(kPointedness, 12);
  const int rings = static_cast<int>(places.size()), columns = kSegments + 1;
  MeshData dome;
  for (const float t : places)
    for (int i = 0; i < columns; ++i) {
      const float s = kHalfRound * static_cast<float>(i) / kSegments;
      dome.vertices.push_back(around(s, kVaultSpring + kVaultRise * arch_height(t, kPointedness), (t - 1) * kNave));
    }
  for (int r = 0; r + 1 < rings; ++r)
    for (int i = 0; i + 1 < columns; ++i) {
      const int low = r * columns + i, high = low + columns;
      dome.faces.push_back({low, low + 1, high});
      if (r + 2 < rings) dome.faces.push_back({low + 1, high + 1, high});
    }
  append(parts.webs, dome);
  for (int k = 1; k < kWindows; ++k) {
    const float s = kHalfRound * static_cast<float>(k) / kWindows, angle = s / kNave - 0.5f * kPi;
    std::vector<Vec3> path;
    for (const float t : places)
      path.push_back(around(s, kVaultSpring + kVaultRise * arch_height(t, kPointedness), (t - 1) * kNave));
    append(parts.trim, sweep(ellipse(0.1f, 0.16f, 8), path, {-std::sin(angle), 0, std::cos(angle)}));
  }
}

void add_altar(Parts& parts) {
  constexpr float kStep = 0.17f;
  for (int i = 0; i < 3; ++i) {
    const float low = static_cast<float>(i) * kStep - 0.05f, back = kEnd + kNave + 0.4f - 0.01f * static_cast<float>(i);
    const float half_width = kNave - 0.6f - 0.02f * static_cast<float>(i);
    append(parts.border, box({kEnd - 2.5f + 0.4f * static_cast<float>(i), low, -half_width},
                             {back, low + kStep + 0.05f, half_width}));
  }
  append(parts.trim, box({kEnd + 0.6f, 0.4f, -1.3f}, {kEnd + 1.5f, 1.4f, 1.3f}));
  append(parts.trim, box({kEnd + 0.45f, 1.4f, -1.5f}, {kEnd + 1.65f, 1.52f, 1.5f}));
}

}  // namespace

void add_apse(Parts& parts) {
  add_wall(parts);
  add_courses(parts.trim);
  add_dome(parts);
  add_altar(parts);
}

}  // namespace dspm::hall
