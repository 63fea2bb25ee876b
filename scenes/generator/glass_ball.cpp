// The glass ball of disco.dsc: glass_ball.01.ply to .24.ply, two seconds, at its place in the room; metres, the floor
// is at y = 0. It bounces to and fro, one jump per second, and rings like a drop: every impact squeezes it, and it
// swings back in the two lowest modes of a ball with surface tension, whose squared frequencies are as
// l (l - 1) (l + 2). The volume stays the same. Frame 25 would be frame 1 again. [Rayleigh 1879, On the Capillary
// Phenomena of Jets]
#include <fmt/format.h>

#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr int kFrames = 24, kJumps = 2, kRingsOfMesh = 48, kSides = 96;
constexpr float kRadius = 0.19f, kJump = 0.42f;                   // of the centre, above its place at the impact
constexpr Vec3 kLeft{-0.7f, 0, 0.7f}, kRight{0.25f, 0, 0.1f};     // places of the impacts
constexpr float kSqueeze = 0.27f, kSwings = 3.2f, kDecay = 2.6f;  // amplitude of l = 2, per jump

/// Radii over the mean, by the angle to the vertical axis.
struct Deformation {
  float second, third;  // amplitudes of the Legendre polynomials P2 and P3

  float operator()(float angle) const {
    const float c = std::cos(angle);
    return 1 + second * 0.5f * (3 * c * c - 1) + third * 0.5f * (5 * c * c * c - 3 * c);
  }
  float volume() const;  // over that of the unit ball
};

float Deformation::volume() const {
  constexpr int kSteps = 256;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float angle = kPi * (static_cast<float>(i) + 0.5f) / kSteps;
    sum += std::pow((*this)(angle), 3.f) * std::sin(angle);
  }
  return sum * kPi / (2 * kSteps);
}

/// At a time in jumps since the impact, 0 to 1.
Deformation ringing(float time) {
  const float fading = kSqueeze * std::exp(-kDecay * time), phase = 2 * kPi * kSwings * time;
  const float third_over_second = std::sqrt(3.f * 2 * 5 / (2.f * 1 * 4));
  return {-fading * std::cos(phase), 0.35f * fading * std::sin(third_over_second * phase)};
}

MeshData ball(int frame) {
  const float jumps = static_cast<float>(frame * kJumps) / kFrames, time = jumps - std::floor(jumps);
  const Deformation shape = ringing(time);
  const float radius = kRadius / std::cbrt(shape.volume());
  const float height = 4 * kJump * time * (1 - time) + radius * shape(kPi);
  const float along = jumps < 1 ? time : 1 - time;
  const Vec3 centre = kLeft * (1 - along) + kRight * along + Vec3{0, height, 0};

  std::vector<Vec2> profile;
  for (int i = 0; i <= kRingsOfMesh; ++i) {
    const float angle = kPi * (1 - static_cast<float>(i) / kRingsOfMesh), r = radius * shape(angle);
    const bool pole = i == 0 || i == kRingsOfMesh;
    profile.push_back({pole ? 0 : r * std::sin(angle), r * std::cos(angle)});
  }
  MeshData mesh = with_normals(lathe(profile, kSides), 180);
  for (Vec3& p : mesh.vertices) p += centre;
  return mesh;
}

}  // namespace

void make_glass_ball(const std::filesystem::path& directory) {
  for (int frame = 0; frame < kFrames; ++frame)
    write_ply(directory / fmt::format("glass_ball.{:02}.ply", frame + 1), ball(frame));
}

}  // namespace dspm
