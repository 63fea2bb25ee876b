// The product of chair.dsc, an easy chair that stands on the origin and looks along -z: chair_frame.ply, of wood, and
// chair_cushions.ply. The unit is 10 cm.
#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/subjects.h"
#include "scenes/generator/surface.h"

namespace dspm {
namespace {

constexpr float kSeatTilt = 6, kBackTilt = 24;  // degrees

MeshData mirrored(const MeshData& part) {
  MeshData both = part;
  append(both, part, Transform(Matrix4::scale(-1, 1, 1)));
  return both;
}

/// Two legs, the arm on them, and the rail under the seat, on the right of who sits there.
MeshData side_frame() {
  const Vec3 inwards{-1, 0, 0};
  MeshData mesh;
  append(mesh, limb({{{3.16f, .04f, -2.75f}, .13f, .13f},
                     {{3.12f, 1.8f, -2.62f}, .2f, .2f},
                     {{3.08f, 3.6f, -2.5f}, .22f, .24f},
                     {{3.06f, 5.5f, -2.42f}, .17f, .2f}},
                    inwards, 2.2f));
  append(mesh, limb({{{3.05f, .04f, 3.3f}, .13f, .13f},
                     {{3.02f, 1.6f, 2.62f}, .19f, .21f},
                     {{3, 3.2f, 2.3f}, .2f, .27f},
                     {{2.98f, 4.8f, 2.5f}, .2f, .26f},
                     {{2.94f, 6.4f, 3.06f}, .18f, .22f},
                     {{2.9f, 7.9f, 3.74f}, .14f, .17f}},
                    inwards, 2.2f, {.7f, 3.1f}));
  append(mesh, limb({{{3.1f, 5.66f, -3.15f}, .3f, .1f},
                     {{3.12f, 5.74f, -2.2f}, .44f, .13f},
                     {{3.12f, 5.7f, -.9f}, .43f, .14f},
                     {{3.07f, 5.54f, .5f}, .33f, .15f},
                     {{3.02f, 5.4f, 1.8f}, .24f, .16f},
                     {{2.97f, 5.4f, 2.85f}, .18f, .17f}},
                    {1, 0, 0}, 2.6f, {.2f, 7.3f}));
  append(mesh, limb({{{3.08f, 3.28f, -2.5f}, .16f, .3f},
                     {{3.05f, 3.1f, -.9f}, .16f, .32f},
                     {{3.02f, 2.9f, .8f}, .16f, .32f},
                     {{3, 2.72f, 2.35f}, .16f, .3f}},
                    inwards, 4, {1.1f, 5.9f}));
  return mesh;
}

MeshData frame() {
  MeshData mesh = mirrored(side_frame());
  const Vec3 up{0, 1, 0};
  append(mesh, limb({{{-3.08f, 3.2f, -2.5f}, .34f, .15f},
                     {{-1, 3.2f, -2.5f}, .36f, .15f},
                     {{1, 3.2f, -2.5f}, .36f, .15f},
                     {{3.08f, 3.2f, -2.5f}, .34f, .15f}},
                    -up, 4, {.4f, 1.7f}));
  append(mesh, limb({{{-3, 2.74f, 2.35f}, .3f, .15f}, {{0, 2.74f, 2.35f}, .3f, .15f}, {{3, 2.74f, 2.35f}, .3f, .15f}},
                    -up, 4, {.9f, 4.2f}));
  const auto back_rail = [&](float y, float z, float half_height, Vec2 offset) {
    append(mesh, limb({{{-2.95f, y, z}, half_height * .8f, .11f},
                       {{-1.5f, y + .03f, z + .14f}, half_height, .12f},
                       {{0, y + .05f, z + .2f}, half_height * 1.08f, .12f},
                       {{1.5f, y + .03f, z + .14f}, half_height, .12f},
                       {{2.95f, y, z}, half_height * .8f, .11f}},
                      {0, -1, -.42f}, 3, offset));
  };
  back_rail(7.45f, 3.54f, .3f, {.3f, 9.1f});
  back_rail(4.3f, 2.42f, .22f, {1.3f, 6.6f});
  for (int i = -3; i <= 3; ++i) {
    const float x = static_cast<float>(i) * .72f, bow = .17f * (1 - x * x / 9);
    append(mesh, limb({{{x, 4.3f, 2.42f + bow}, .07f, .07f},
                       {{x, 5.9f, 2.95f + bow}, .1f, .08f},
                       {{x, 7.45f, 3.54f + bow}, .07f, .07f}},
                      {1, 0, 0}, 2, {static_cast<float>(i), 0}));
  }
  return mesh;
}

MeshData cushions() {
  MeshData mesh;
  append(mesh, cushion({2.82f, 2.72f, .52f, .2f, .4f, .055f}),
         Transform(Matrix4::translate(0, 4.02, -.35) * Matrix4::rotate(kSeatTilt, 1, 0, 0)));
  append(mesh, cushion({2.78f, 2.05f, .44f, .26f, .45f, .055f}),
         Transform(Matrix4::translate(0, 6.35, 2.22) * Matrix4::rotate(kBackTilt - 90, 1, 0, 0)));
  return mesh;
}

}  // namespace

void make_chair(const std::filesystem::path& directory) {
  write_ply(directory / "chair_frame.ply", frame());
  write_ply(directory / "chair_cushions.ply", cushions());
}

}  // namespace dspm
