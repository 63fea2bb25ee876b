// Vectors of motion through cameras that move, against what formulas say; and dspm's promises for all vectors.
#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/state_in_memory.h"
#include "tests/integrators/motion_vectors.h"

namespace dspm::test {
namespace camera_motion_test {

using namespace motion_vectors;

/// A picture through a pinhole whose screen reaches to the tangents `tangent` and, vertically, half of it.
std::string seen(const std::string& camera, const std::string& contents) {
  return fmt::format(R"(
Frames 2
Option "disablepixeljitter" true
Integrator "path"
PixelFilter "box"
Film "rgb" "integer xresolution" 32 "integer yresolution" 16
{}
WorldBegin
LightSource "infinite"
{}
)",
                     camera, contents);
}

const char* const kWall = R"(Shape "bilinearmesh" "point3 P" [-99 -99 4 99 -99 4 -99 99 4 99 99 4])";

constexpr double kDepth = 4;  // of the wall

TEST(CameraMotion, OfACameraThatPassesByAWall) {
  const Vectors vectors = vectors_of(seen(R"(
Keyframe 1 LookAt 0 0 0  0 0 1  0 1 0
Keyframe 2 LookAt .5 .25 1  .5 .25 2  0 1 0
KeyframeEnd
Camera "perspective" "float fov" 90 "float screenwindow" [-1 1 -.5 .5]
)",
                                          kWall));
  const double scale = kWidth / 2.;  // pixels per tangent
  for (const int x : {3, 16, 30})
    for (const int y : {2, 13}) {
      const double px = right(x) / scale * kDepth, py = up(y) / scale * kDepth;  // on the wall
      expect(vectors, "forward", 0, x, y,
             {(px - 0.5) / (kDepth - 1) * scale - right(x), (py - 0.25) / (kDepth - 1) * scale - up(y)});
      const double back = right(x) / scale * (kDepth - 1) + 0.5;  // where the second frame sees it
      expect(vectors, "backward", 1, x, y,
             {back / kDepth * scale - right(x), (up(y) / scale * (kDepth - 1) + 0.25) / kDepth * scale - up(y)});
    }
}

TEST(CameraMotion, OfAZoom) {
  const Vectors vectors = vectors_of(seen(R"(
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov@1" 90 "float fov@2" 60 "float screenwindow" [-1 1 -.5 .5]
)",
                                          kWall));
  const double growth = std::sqrt(3.);  // tan 45 over tan 30
  for (const int x : {3, 16, 30}) {
    expect(vectors, "forward", 0, x, 4, {right(x) * (growth - 1), up(4) * (growth - 1)});
    expect(vectors, "backward", 1, x, 4, {right(x) * (1 / growth - 1), up(4) * (1 / growth - 1)});
  }
}

/// Returns how far a pan of that angle to the right moves the direction that a pixel shows.
Expected panned(int x, int y, double degrees) {
  const double scale = kWidth / 2., angle = degrees * std::acos(-1.) / 180;
  const double a = right(x) / scale, b = up(y) / scale;
  const double depth = std::cos(angle) + a * std::sin(angle);
  return {(a * std::cos(angle) - std::sin(angle)) / depth * scale - right(x), b / depth * scale - up(y)};
}

// What is infinitely far away does not care where the camera is.
TEST(CameraMotion, OfTheSkyArePannedWithTheCamera) {
  const std::string perspective = R"(
Keyframe 1 LookAt 0 0 0  0 0 1  0 1 0
Keyframe 2 LookAt 7 8 9  7.5 8 9.8660254  0 1 0
KeyframeEnd
Camera "perspective" "float fov" 90 "float screenwindow" [-1 1 -.5 .5]
)";
  const Vectors vectors = vectors_of(seen(perspective, ""));
  for (const int x : {3, 16, 30})
    for (const int y : {2, 13}) {
      expect(vectors, "forward", 0, x, y, panned(x, y, 30));
      expect(vectors, "backward", 1, x, y, panned(x, y, -30));
    }
}

// A pixel that shows both: a disk that moves by 1 at a distance of 4, and the sky, which stands still.
TEST(CameraMotion, LeavesEdgesTheVectorsOfTheSurface) {
  std::string text = seen(R"(
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" 90 "float screenwindow" [-1 1 -.5 .5]
)",
                          R"(
DynamicBegin "disk"
  Keyframe 1 Translate 0 0 4 Keyframe 2 Translate 1 0 4 KeyframeEnd
  Shape "disk" "float radius" 1.1
DynamicEnd
)");
  text.replace(text.find("true"), 4, "false");
  TestScene test(text, asking({"motion.forward", "alpha"}));
  const Vectors vectors = vectors_of(test, {FileFrame(0)}, 16);
  int edges = 0;
  for (int x = 0; x < kWidth; ++x)
    for (int y = 0; y < kHeight; ++y) {
      const float alpha = vectors.at("alpha")[0].at(x, y).r;
      if (alpha > 0) expect(vectors, "forward", 0, x, y, {kWidth / 2. / kDepth, 0});
      if (alpha > 0 && alpha < 1) ++edges;
    }
  EXPECT_GT(edges, 10);
}

// 64 pixels go around. A turn by 45 degrees takes +z, the middle of the picture, towards +x, which is on its left.
TEST(CameraMotion, OfASphericalCamera) {
  std::string text = seen(R"(
Keyframe 1 Rotate 0 0 1 0
Keyframe 2 Rotate 45 0 1 0
KeyframeEnd
Camera "spherical" "string mapping" "equirectangular"
)",
                          R"(Shape "sphere" "float radius" 9)");
  const auto double_size = [&](const std::string& name, int size) {
    const std::string old = fmt::format("\"integer {}\" {}", name, size);
    text.replace(text.find(old), old.size(), fmt::format("\"integer {}\" {}", name, 2 * size));
  };
  double_size("xresolution", kWidth), double_size("yresolution", kHeight);
  const Vectors vectors = vectors_of(text);
  for (const int x : {25, 40}) expect(vectors, "forward", 0, x, 16, {-8, 0});
  expect(vectors, "backward", 1, 40, 16, {8, 0});
  expect(vectors, "forward", 0, 3, 16, {0, 0});  // the edge is too near
}

// What is behind the camera in the other frame has no place there.
TEST(CameraMotion, AreZeroIfTheOtherFrameCannotSeeThePoint) {
  const Vectors vectors = vectors_of(seen(R"(
Keyframe 1 LookAt 0 0 0  0 0 1  0 1 0
Keyframe 2 LookAt 0 0 9  0 0 10  0 1 0
KeyframeEnd
Camera "perspective"
)",
                                          kWall));
  expect(vectors, "forward", 0, 3, 4, {0, 0});
}

/// A turning ball, a wall and a camera that moves, jittered.
std::string moving(const std::string& integrator) {
  return fmt::format(R"(
Frames 3
Integrator {}
Film "rgb" "integer xresolution" 32 "integer yresolution" 16
Keyframe 1 LookAt 0 0 0  0 0 1  0 1 0
Keyframe 3 LookAt .5 .25 .5  .5 .2 2  0 1 0
KeyframeEnd
Camera "perspective" "float fov@1" 60 "float fov@3" 90 "float shutterclose" 0.5
WorldBegin
LightSource "point" "point3 from" [0 3 0]
Shape "disk" "float radius" 2 "float height" 4
DynamicBegin "ball"
  Keyframe 1 Translate -1 0 3 Rotate 0 0 1 1 Keyframe 3 Translate 1 .5 2.5 Rotate 120 0 1 1 KeyframeEnd
  Shape "trianglemesh" "point3 P" [-1 -1 0 1 -1 0 -1 1 0 1 1 0] "integer indices" [0 1 2 2 1 3]
DynamicEnd
)",
                     integrator);
}

class VectorsOfEveryIntegrator : public testing::TestWithParam<const char*> {};

TEST_P(VectorsOfEveryIntegrator, HasTheSameVectorsHoweverItRenders) {
  const auto all = [&](Choices choices, int threads = 2) {
    const ThreadLimit limit(threads);
    TestScene test(moving(GetParam()), choices);
    return vectors_of(test, test.all_frames());
  };
  const Vectors whole = all(asking());
  EXPECT_EQ(all(asking(), 1), whole);
  EXPECT_EQ(all(asking(), 5), whole);
  TestScene single(moving(GetParam()), asking());
  for (const FileFrame f : single.all_frames())
    for (const auto& [output, images] : vectors_of(single, {f})) EXPECT_EQ(images[0], whole.at(output)[f.slot()]);
  Choices crop = asking();
  crop.pixel_bounds = {5, kWidth, 3, kHeight - 2};
  const Vectors cropped = all(crop);
  for (const auto& [output, images] : cropped)
    for (std::size_t f = 0; f < images.size(); ++f)
      for (int y = 0; y < images[f].height; ++y)
        for (int x = 0; x < images[f].width; ++x)
          ASSERT_EQ(images[f].at(x, y), whole.at(output)[f].at(x + 5, y + 3)) << output << ", " << x << ", " << y;
}

TEST_P(VectorsOfEveryIntegrator, GoesOnFromTheStateOfVectors) {
  TestScene test(moving(GetParam()), asking());
  const auto scene = test.scene(test.all_frames());
  const auto calm = test.integrator(*scene), first = test.integrator(*scene), second = test.integrator(*scene);
  test.iterate(*calm, *scene, 0, 4);
  test.iterate(*first, *scene, 0, 2);
  const std::string saved = state_of(*first);
  LoadedState state(saved);
  ASSERT_TRUE(second->persist(state));
  test.iterate(*second, *scene, 2, 4);
  for (const std::string& output : test.job().settings.outputs)
    for (const Frame f : {0, 1, 2}) EXPECT_EQ(second->estimate(f, output), calm->estimate(f, output)) << output;
}

INSTANTIATE_TEST_SUITE_P(Integrators, VectorsOfEveryIntegrator,
                         testing::Values(R"("path")", R"("vcm" "string emission" "power" "integer photons" 500)",
                                         R"("dsppm" "string emission" "power" "integer photons" 500)",
                                         R"("photonmap" "string emission" "power" "integer photons" 500
                                            "integer causticphotons" 500)"));

}  // namespace camera_motion_test
}  // namespace dspm::test
