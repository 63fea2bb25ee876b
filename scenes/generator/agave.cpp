// The plant beside the basin of water.dsc: agave.ply, a rosette of fleshy leaves, its foot at the origin, and
// agave_pot.ply, the bowl that it grows in, standing on y = -0.2. Metres.
#include <cmath>

#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr int kLeaves = 26, kSteps = 14, kCorners = 8;
constexpr float kGoldenAngle = 2.39996323f;

struct Leaf {
  float length, rise;  // rise: 1 stands upright, 0 lies flat
};

/// Points of the leaf's section: a sickle that opens upwards, for half-width 1.
Vec2 section(int corner) {
  const float angle = 2 * kPi * static_cast<float>(corner) / kCorners, across = std::cos(angle);
  return {across, 0.35f * across * across + 0.16f * std::sin(angle)};
}

/// A leaf along x that bends outwards as it rises.
MeshData grow(const Leaf& leaf) {
  MeshData mesh;
  Vec3 p{0.02f, 0, 0};
  for (int i = 0; i <= kSteps; ++i) {
    const float s = static_cast<float>(i) / kSteps;
    const float pitch = 0.5f * kPi * leaf.rise + 0.5f * s * (0.9f - leaf.rise);
    const Vec3 along{std::cos(pitch), std::sin(pitch), 0}, up{-along.y, along.x, 0};
    const float half_width = leaf.length * 0.17f * std::pow(1 - s, 0.7f) * (0.55f + 1.5f * s * (1 - s) + 0.25f * s);
    for (int k = 0; k < (i < kSteps ? kCorners : 1); ++k) {
      const Vec2 c = section(k) * half_width;
      mesh.vertices.push_back(p + up * c.y + Vec3{0, 0, c.x});
    }
    p += along * (leaf.length / kSteps);
  }
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kCorners; ++k) {
      const int near = i * kCorners, far = near + kCorners, next = (k + 1) % kCorners;
      if (i + 1 == kSteps) {
        mesh.faces.push_back({near + k, near + next, far});
        continue;
      }
      mesh.faces.push_back({near + k, near + next, far + k});
      mesh.faces.push_back({near + next, far + next, far + k});
    }
  return mesh;
}

MeshData rosette() {
  MeshData mesh;
  for (int i = 0; i < kLeaves; ++i) {
    const float age = static_cast<float>(i) / (kLeaves - 1);  // 0 is the oldest, at the outside
    const Leaf leaf{0.3f - 0.08f * age, 0.12f + 0.74f * age};
    const double degrees = static_cast<double>(static_cast<float>(i) * kGoldenAngle * 180 / kPi);
    append(mesh, grow(leaf), Transform(Matrix4::rotate(degrees, 0, 1, 0)));
  }
  return with_normals(mesh, 70);
}

}  // namespace

void make_agave(const std::filesystem::path& directory) {
  write_ply(directory / "agave.ply", rosette());
  const std::vector<Vec2> profile{{0, -0.2f},        {0.095f, -0.2f},   {0.1f, -0.195f},   {0.145f, -0.03f},
                                  {0.162f, -0.028f}, {0.166f, -0.022f}, {0.17f, 0.012f},   {0.166f, 0.018f},
                                  {0.15f, 0.018f},   {0.146f, 0.012f},  {0.143f, -0.025f}, {0, -0.02f}};
  write_ply(directory / "agave_pot.ply", with_normals(lathe(profile, 64), 35));
}

}  // namespace dspm
