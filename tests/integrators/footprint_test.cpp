// The disk that a camera path stands for behind curved mirrors and lenses, against the paths of neighbouring points of
// the film. Paths start in the plane y = 0 across the middle of the film, where all surfaces stand upright, so the
// neighbour above parts from them along y: the width of the disk is the width there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dspm/integrators/transport/camera_path.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace footprint_test {

constexpr float kMiddle = 100;  // of the film

struct Arrival {
  Vec3 p;
  float diameter;
};

/// Where the path through that point of the film arrives after so many specular bounces. `lobe`: 0 where the first of
/// two is taken, reflection; 1 for the other.
Arrival arrive(const Scene& scene, Vec2 film, int bounces, float lobe) {
  CameraPath path;
  path.camera = scene.camera.states.front().object.get();
  path.ray = path.camera->ray(film, {0.5f, 0.5f}), path.frames = scene.frames(), path.width = 1;
  while (true) {
    const HitPartition parts = scene.accel->partition(path.ray, path.frames);
    const FrameHit& part = *parts.begin();
    const Vertex vertex(scene, path.ray, part);
    if (path.bounces == bounces) return {vertex.point.p, path.diameter(part.hit.t)};
    path.travel(part.hit.t);
    for_each_surface(vertex, [&](FrameSet, const Bsdf& bsdf) {
      const auto sample = bsdf.sample(vertex.wo, {0.5f, 0.5f, lobe}, Transport::radiance, bsdf.all_lobes());
      ASSERT_TRUE(sample && sample->specular);
      extend(path, vertex, *sample);
      path.leave(vertex, *sample);
    });
  }
}

/// The part of the unit sphere that faces the camera, as triangles with normals.
std::string half_a_ball_of_triangles() {
  constexpr int kSteps = 24;
  std::string points, indices;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double x = 1.4 * i / kSteps - 0.7, y = 1.4 * j / kSteps - 0.71;  // no edge at y = 0
      points += fmt::format("{} {} {} ", x, y, -std::sqrt(std::max(0., 1 - x * x - y * y)));
      const int at = i * (kSteps + 1) + j, next = at + kSteps + 1;
      if (i < kSteps && j < kSteps)
        indices += fmt::format("{} {} {} {} {} {} ", at, at + 1, next, at + 1, next + 1, next);
    }
  return fmt::format(R"(Shape "trianglemesh" "integer indices" [{}] "point3 P" [{}] "normal N" [{}])", indices, points,
                     points);
}

struct Case {
  std::string name, what;
  int bounces;
  float lobe;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Footprint : public testing::TestWithParam<Case> {};

TEST_P(Footprint, IsAsFarAsNeighboursAreApart) {
  const TestScene test(R"(
LookAt 0 0 -10  0 0 0  0 1 0
Camera "perspective" "float fov" 12
Film "rgb" "integer xresolution" 200 "integer yresolution" 200
WorldBegin
Shape "sphere" "float radius" 50
)" + GetParam().what);
  const auto scene = test.scene(test.all_frames());
  for (const float x : {2.f, 30.f, 55.f}) {
    constexpr float kUp = 0.02f;
    const auto [bounces, lobe] = std::pair(GetParam().bounces, GetParam().lobe);
    const Arrival here = arrive(*scene, {kMiddle + x, kMiddle}, bounces, lobe);
    const Arrival above = arrive(*scene, {kMiddle + x, kMiddle - kUp}, bounces, lobe);
    const float apart = std::abs(above.p.y - here.p.y) / kUp;
    EXPECT_NEAR(here.diameter, apart, 0.03f * apart) << "x = " << x;
  }
}

const std::string kMirror = "Material \"conductor\" \"float roughness\" 0\n", kGlass = "Material \"dielectric\"\n";

INSTANTIATE_TEST_SUITE_P(
    Surfaces, Footprint,
    testing::Values(Case{"nothing", "", 0, 0},
                    Case{"flat mirror", kMirror + "Rotate 20 0 1 0 Shape \"disk\" \"float radius\" 2", 1, 0},
                    Case{"convex mirror", kMirror + R"(Shape "sphere")", 1, 0},
                    Case{"one inside out", kMirror + R"(ReverseOrientation Shape "sphere")", 1, 0},
                    Case{"one that is scaled", kMirror + R"(Scale .5 .5 .5 Shape "sphere" "float radius" 2)", 1, 0},
                    Case{"one of triangles", kMirror + half_a_ball_of_triangles(), 1, 0},
                    Case{"concave mirror",
                         kMirror + R"(Translate 0 0 -4 Shape "sphere" "float radius" 4 "float zmin" 3)", 1, 0},
                    Case{"reflection on glass", kGlass + R"(Shape "sphere")", 1, 0},
                    Case{"ball of glass", kGlass + R"(Shape "sphere")", 2, 1},
                    Case{"block of glass",
                         kGlass + "Shape \"disk\" \"float radius\" 2 Translate 0 0 1 "
                                  "ReverseOrientation Shape \"disk\" \"float radius\" 2",
                         2, 1},
                    Case{"thin pane", "Material \"thindielectric\" Shape \"disk\" \"float radius\" 2", 1, 1}));

}  // namespace footprint_test
}  // namespace dspm::test
