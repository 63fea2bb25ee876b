// Numbers of frames, times of keys, ways through them, cycles, turns and aims, against positions computed by hand.
#include <cmath>
#include <set>

#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

constexpr const char* kFrames = "Frames 25 \"float fps\" 8\n";

Motion motion(const std::string& directives, const std::string& before = kFrames) {
  return good(before + "WorldBegin\nDynamicBegin \"a\"\n" + directives + "\nShape \"s\" DynamicEnd")
      .shapes.at(0)
      .world_from_object;
}

Matrix4 at(const std::string& directives, double frame) { return motion(directives).at(Moment(frame - 1)); }

double x(const std::string& directives, double frame) { return at(directives, frame).m[0][3]; }

std::array<double, 3> origin(const Matrix4& matrix) { return {matrix.m[0][3], matrix.m[1][3], matrix.m[2][3]}; }

// Frames with a first number.

TEST(FirstFrame, IsTheNumberOfTheFirst) {
  const SceneDescription scene = good(
      "Frames 25 \"integer first\" 1001 WorldBegin DynamicBegin \"a\"\n"
      "Keyframe 1001 Translate 0 0 0 Keyframe 1005 Translate 4 0 0 KeyframeEnd\n"
      "Shape \"s\" \"float radius@1001\" 1 \"float radius@1003\" 3 DynamicEnd");
  EXPECT_EQ(scene.frames.count(), 25);
  EXPECT_EQ(scene.frames.label(FileFrame(0)), "1001");
  EXPECT_EQ(scene.frames.label(FileFrame(24)), "1025");
  const Moment second = scene.frames.moment(FileFrame(1));
  expect_near(scene.shapes[0].world_from_object.at(second), Matrix4::translate(1, 0, 0));
  EXPECT_EQ(floats(scene.shapes[0].params.at(second), "radius"), std::vector<float>{2});
  EXPECT_EQ(scene.dynamic_blocks[0].moments, (MomentInterval{Moment::numbered(1001), Moment::numbered(1026)}));
}

TEST(FirstFrame, MayBeZero) {
  const SceneDescription scene = good(
      "Frames 5 \"integer first\" 0 WorldBegin DynamicBegin \"a\" \"integer frames\" [0 2]\n"
      "Keyframe 0 Translate 0 0 0 Keyframe 4 Translate 4 0 0 KeyframeEnd Shape \"s\" DynamicEnd");
  expect_near(scene.shapes[0].world_from_object.at(scene.frames.moment(FileFrame(0))), Matrix4{});
  expect_near(scene.shapes[0].world_from_object.at(scene.frames.moment(FileFrame(3))), Matrix4::translate(3, 0, 0));
}

TEST(FirstFrame, KeysOfOtherFramesAreWarnings) {
  const Parsed parsed = parse("Frames 5 \"integer first\" 1001\nWorldBegin\nMaterial \"m\" \"float f@5\" 1");
  EXPECT_EQ(parsed.diagnostics.error_count(), 0);
  ASSERT_EQ(parsed.diagnostics.all().size(), 1u);
  EXPECT_EQ(parsed.diagnostics.all()[0].message,
            "this key for frame 5 is out of range: the scene has frames 1001 to 1005");
}

std::string file(const std::string& parameters, int frame) {
  const SceneDescription scene = good(
      "Frames 25 \"integer first\" 1001 WorldBegin DynamicBegin \"a\" Shape \"plymesh\" "
      "\"string filename\" \"w.%04d.ply\"" +
      parameters + " DynamicEnd");
  const ParamList params = scene.shapes[0].params.at(scene.frames.moment(FileFrame(frame)));
  EXPECT_EQ(params.params.size(), 1u) << "first and step have been used";
  return std::get<std::vector<std::string>>(params.find("filename")->values).front();
}

TEST(FirstFrame, HasTheFirstOfNumberedFiles) {
  EXPECT_EQ(file("", 0), "w.1001.ply");
  EXPECT_EQ(file("", 2), "w.1003.ply");
  EXPECT_EQ(file(" \"integer first\" 0", 0), "w.0000.ply");
  EXPECT_EQ(file(" \"integer first\" 0 \"integer step\" 4", 2), "w.0008.ply");
  EXPECT_EQ(file(" \"integer step\" 4", 2), "w.1009.ply");
}

// Times of keys.

TEST(KeyTimes, LieBetweenFrames) {
  const std::string keys = "Keyframe 2.5 Translate 0 0 0 Keyframe 4.5 Translate 2 0 0 KeyframeEnd";
  EXPECT_DOUBLE_EQ(x(keys, 3), .5);
  EXPECT_DOUBLE_EQ(x(keys, 4), 1.5);
  EXPECT_DOUBLE_EQ(x(keys, 5), 2);
  const SceneDescription scene = good("Frames 9 WorldBegin Material \"m\" \"float f@1.5\" 0 \"float f@3.5\" 4");
  EXPECT_EQ(floats(scene.materials[0].params.at(Moment::numbered(2)), "f"), std::vector<float>{1});
}

TEST(KeyTimes, AreSecondsAfterTheFirstFrame) {
  const std::string keys = "Keyframe 0s Translate 0 0 0 Keyframe 0.5s Translate 4 0 0 KeyframeEnd";
  EXPECT_DOUBLE_EQ(x(keys, 1), 0);
  EXPECT_DOUBLE_EQ(x(keys, 3), 2);
  EXPECT_DOUBLE_EQ(x(keys, 5), 4);
  const SceneDescription scene = good(
      "Frames 9 \"float fps\" 8 \"integer first\" 101 WorldBegin Material \"m\" \"float f@0s\" 0 \"float f@1s\" 4");
  EXPECT_EQ(floats(scene.materials[0].params.at(Moment::numbered(103)), "f"), std::vector<float>{1});
}

// Cubic ways.

constexpr const char* kCubic = " \"string ease\" \"cubic\" ";

std::string through(const std::vector<std::pair<double, double>>& keys, const std::string& end = "KeyframeEnd") {
  std::string text;
  for (const auto& [frame, x] : keys)
    text += "Keyframe " + std::to_string(frame) + kCubic + "Translate " + std::to_string(x) + " 0 0 ";
  return text + end;
}

// A parabola has the slopes of a Catmull-Rom spline everywhere, whatever the distances of the keys.
TEST(Cubic, IsExactForAParabola) {
  const auto parabola = [](double frame) { return (frame - 4) * (frame - 4) / 4; };
  std::vector<std::pair<double, double>> keys;
  for (const double frame : {1., 3., 8., 10.5, 20.}) keys.emplace_back(frame, parabola(frame));
  const Motion thrown = motion(through(keys));
  for (double frame = 1; frame <= 20; frame += .25)
    EXPECT_NEAR(thrown.at(Moment(frame - 1)).m[0][3], parabola(frame), 1e-5) << frame;
}

// [Catmull and Rom 1974]: with even distances, the middle of a section is (-1, 9, 9, -1) / 16 of the keys around it.
TEST(Cubic, IsACatmullRomSpline) {
  const std::string keys = through({{1, 0}, {5, 3}, {9, -2}, {13, 7}});
  EXPECT_NEAR(x(keys, 7), (-1 * 0 + 9 * 3 + 9 * -2 - 1 * 7) / 16., 1e-6);
  EXPECT_NEAR(x(keys, 5), 3, 1e-6);
}

TEST(Cubic, StandsStillBetweenEqualKeys) {
  const Motion m = motion(through({{1, 0}, {5, 3}, {9, 3}, {13, 7}}));
  for (double frame = 5; frame <= 9; frame += .5) EXPECT_EQ(m.at(Moment(frame - 1)), m.at(Moment(4)));
  EXPECT_NEAR((m.at(Moment(8.001)).m[0][3] - 3) / .001, 0, 1e-2) << "it starts gently";
}

TEST(Cubic, ConstantKeysAreOneState) {
  for (const std::string& pose : {std::string("Translate .1 .2 .3 Rotate 31 1 2 3"),
                                  std::string("ConcatTransform [.6 .8 0 0 -.8 .6 0 0 0 0 1 0 .1 .2 .3 1]")}) {
    std::string keys;
    for (const char* frame : {"1", "4", "9"}) keys += std::string("Keyframe ") + frame + kCubic + pose + " ";
    const Motion m = motion(keys + "KeyframeEnd");
    for (int frame = 0; frame < 25; ++frame) EXPECT_EQ(m.at(Moment(frame)), m.at(Moment())) << pose << frame;
  }
}

TEST(Cubic, MatricesAndOtherSequencesGoThroughTheirKeysWithoutAStop) {
  const std::string keys =
      "Keyframe 1 \"string ease\" \"cubic\" Rotate 0 0 0 1 Keyframe 5 \"string ease\" \"cubic\" Translate 1 0 0 Rotate "
      "40 0 0 1 "
      "Keyframe 9 \"string ease\" \"cubic\" Translate 2 0 0 Rotate 80 0 0 1 KeyframeEnd";
  expect_near(at(keys, 5), Matrix4::translate(1, 0, 0) * Matrix4::rotate(40, 0, 0, 1));
  const Matrix4 middle = at(keys, 3);
  EXPECT_NEAR(middle.m[0][3], .5, 1e-12);
  EXPECT_NEAR(std::atan2(middle.m[1][0], middle.m[0][0]) * 180 / M_PI, 20, .5);
  const double before = at(keys, 4.99).m[0][3], after = at(keys, 5.01).m[0][3];
  EXPECT_NEAR((after - before) / .02, .25, 1e-3);
}

TEST(Cubic, TakesTangents) {
  const std::string keys =
      "Keyframe 1 \"float tangent\" [2 0 0] Translate 0 0 0 Keyframe 5 \"float tangentin\" [-1 0 0] \"float "
      "tangentout\" [0 0 0] "
      "Translate 4 0 0 Keyframe 9 \"float tangent\" [0 0 0] Translate 0 0 0 KeyframeEnd";
  // Hermite's curve at its middle: (p0 + p1) / 2 + length (m0 - m1) / 8.
  EXPECT_NEAR(x(keys, 3), 2 + 4 * (2. + 1) / 8, 1e-12);
  EXPECT_NEAR(x(keys, 7), 2, 1e-12);
  EXPECT_NEAR((x(keys, 1.001) - x(keys, 1)) / .001, 2, 1e-2);
}

TEST(Cubic, IsUsualForCamerasWithThreeKeys) {
  const auto camera_x = [](const std::string& ease, const std::string& more, double frame) {
    const SceneDescription scene = good("Frames 25\nKeyframe 1 " + ease + "Translate 0 0 0 Keyframe 5 " + ease +
                                        "Translate 3 0 0 " + more + "KeyframeEnd Camera \"c\" WorldBegin");
    return scene.camera->camera_from_world.at(Moment(frame - 1)).m[0][3];
  };
  const std::string third = "Keyframe 9 \"string ease\" \"linear\" Translate 12 0 0 ";
  EXPECT_DOUBLE_EQ(camera_x("", "", 2), .75) << "two keys";
  EXPECT_DOUBLE_EQ(camera_x("", third, 3), 12 * .25 * .25) << "a parabola";
  EXPECT_DOUBLE_EQ(camera_x("\"string ease\" \"linear\" ", third, 3), 1.5);
  EXPECT_DOUBLE_EQ(
      x("Keyframe 1 Translate 0 0 0 Keyframe 5 Translate 3 0 0 Keyframe 9 Translate 12 0 0 KeyframeEnd", 3), 1.5)
      << "not for other things";
}

// Cycles.

std::string cycle(const std::string& after, const std::string& last = "Translate 4 0 0") {
  return "Keyframe 2 Translate 0 0 0 Keyframe 6 " + last + " KeyframeEnd \"string after\" \"" + after + "\"";
}

TEST(Cycles, RepeatAndGoOn) {
  EXPECT_EQ(x(cycle("hold"), 9), 4);
  EXPECT_EQ(x(cycle("repeat"), 1), 0) << "holds before the first key";
  EXPECT_EQ(x(cycle("repeat"), 6), 4) << "the last key is met";
  EXPECT_EQ(x(cycle("repeat"), 7), 1);
  EXPECT_EQ(x(cycle("repeat"), 10), 4);
  EXPECT_EQ(x(cycle("repeat"), 23), 1);
  EXPECT_EQ(x(cycle("offset"), 7), 5);
  EXPECT_EQ(x(cycle("offset"), 25), 23);
}

TEST(Cycles, AreTheSameStatesAgain) {
  const std::string swing =
      "Keyframe 1 Rotate -20 0 0 1 Keyframe 3.5 Rotate 31 0 0 1 Keyframe 6 Rotate -20 0 0 1 KeyframeEnd ";
  for (const char* ease : {"linear", "smooth", "cubic"}) {
    std::string keys = swing;
    for (std::size_t i = 0; (i = keys.find(" Rotate", i)) != keys.npos; i += 30)
      keys.insert(i, std::string(" \"string ease\" \"") + ease + "\"");
    const Motion m = motion(keys + "\"string after\" \"repeat\"");
    std::set<std::array<std::array<double, 4>, 4>> states;
    for (int frame = 0; frame < 25; ++frame) states.insert(m.at(Moment(frame)).m);
    EXPECT_LE(states.size(), 5u) << ease;
    for (int frame = 6; frame < 25; ++frame) EXPECT_EQ(m.at(Moment(frame)), m.at(Moment(frame - 5))) << ease << frame;
  }
}

TEST(Cycles, OfMatricesGoOnFromWhereTheyEnd) {
  const std::string step =
      "Keyframe 1 Identity Keyframe 5 Identity Translate 1 0 0 Rotate 90 0 0 1 KeyframeEnd \"string after\" \"offset\"";
  const Matrix4 once = Matrix4::translate(1, 0, 0) * Matrix4::rotate(90, 0, 0, 1);
  expect_near(at(step, 9), once * once);
  expect_near(at(step, 17), once * once * once * once);
  expect_near(at(step, 7), once * at(step, 3));
}

TEST(Cycles, MayBeShortAndMany) {
  const std::string before = "Frames 100000\n";
  const Motion m = motion(
      "Keyframe 1 Translate 0 0 0 Keyframe 1.0001 Translate 1e-4 0 0 KeyframeEnd \"string after\" \"offset\"", before);
  EXPECT_TRUE(std::isfinite(m.at(Moment(99999)).m[0][3]));
  const Parsed parsed =
      parse(before +
            "WorldBegin DynamicBegin \"a\" Keyframe 1 ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] "
            "Keyframe 2 ConcatTransform [9 0 0 0 0 9 0 0 0 0 9 0 0 0 0 1] KeyframeEnd \"string after\" "
            "\"offset\" Shape \"s\" DynamicEnd");
  EXPECT_NE(parsed.messages().find("singular at frame"), std::string::npos) << parsed.messages();
}

TEST(Cycles, OfACubicWayCloseSmoothly) {
  // A closed way through equal distances: the slope at the seam is that of the keys beside it.
  const Motion m =
      motion(through({{1, 0}, {3, 1}, {5, 0}, {7, -1}, {9, 0}}, "KeyframeEnd \"string after\" \"repeat\""));
  const auto speed = [&](double frame) {
    return (m.at(Moment(frame - 1 + .001)).m[0][3] - m.at(Moment(frame - 1 - .001)).m[0][3]) / .002;
  };
  EXPECT_NEAR(speed(9), .5, 1e-3);
  EXPECT_NEAR(speed(9.5), speed(17.5), 1e-6);
}

// Turns.

TEST(Turns, AreFullOnesOnTheWay) {
  const auto turned = [](const std::string& turns, double frame) {
    return at("Keyframe 1 \"integer turns\" " + turns + " Identity Keyframe 9 Identity Rotate 40 0 0 1 KeyframeEnd",
              frame);
  };
  for (const double frame : {1., 2., 4.5, 8., 9.}) {
    expect_near(turned("0", frame), Matrix4::rotate(5 * (frame - 1), 0, 0, 1));
    expect_near(turned("2", frame), Matrix4::rotate(95 * (frame - 1), 0, 0, 1));
    expect_near(turned("-1", frame), Matrix4::rotate(-40 * (frame - 1), 0, 0, 1));
  }
}

// Aims.

std::array<double, 3> in_camera(const std::string& view, const std::string& world, int frame) {
  const SceneDescription scene = good("Frames 25\n" + view + " Camera \"c\" WorldBegin\n" + world);
  const Moment moment = Moment::numbered(frame);
  return origin(scene.camera->camera_from_world.at(moment) * scene.shapes.at(0).world_from_object.at(moment));
}

constexpr const char* kBall =
    "DynamicBegin \"ball\" Translate 0 1 0 Keyframe 1 Translate 0 0 0 Keyframe 25 Translate 12 3 5 KeyframeEnd "
    "Shape \"sphere\" DynamicEnd";

void expect_ahead(const std::array<double, 3>& point, double distance) {
  EXPECT_NEAR(point[0], 0, 1e-12);
  EXPECT_NEAR(point[1], 0, 1e-12);
  EXPECT_NEAR(point[2], distance, 1e-9);
}

TEST(Aims, KeepWhatMovesInTheMiddle) {
  for (const int frame : {1, 8, 25}) {
    const double t = (frame - 1) / 24.;
    expect_ahead(in_camera("LookAt 1 2 -5 \"ball\" 0 1 0", kBall, frame),
                 std::hypot(12 * t - 1, 1 + 3 * t - 2, 5 * t + 5));
    const double eye = 1 + 2 * t;
    expect_ahead(
        in_camera("Keyframe 1 LookAt 1 2 -5 \"ball\" 0 1 0 Keyframe 25 LookAt 3 2 -5 \"ball\" 0 1 0 KeyframeEnd", kBall,
                  frame),
        std::hypot(12 * t - eye, 1 + 3 * t - 2, 5 * t + 5));
  }
}

TEST(Aims, GoFromOneThingToAnother) {
  const std::string view = "Keyframe 1 LookAt 0 0 -5 \"ball\" 0 1 0 Keyframe 3 LookAt 0 0 -5 0 0 0 0 1 0 KeyframeEnd";
  const SceneDescription scene =
      good("Frames 3\n" + view +
           " Camera \"c\" WorldBegin Shape \"s\" DynamicBegin \"ball\" Translate 2 0 0 Shape \"s\" DynamicEnd");
  expect_near(scene.camera->camera_from_world.at(Moment(1)), *Matrix4::look_at({0, 0, -5}, {1, 0, 0}, {0, 1, 0}));
  expect_near(scene.camera->camera_from_world.at(Moment(2)), *Matrix4::look_at({0, 0, -5}, {0, 0, 0}, {0, 1, 0}));
}

TEST(Aims, TakeAnEyeThatRidesAlong) {
  const std::string cart =
      std::string(kBall) +
      " DynamicBegin \"cart\" Keyframe 1 Translate 0 0 -9 Keyframe 25 Translate 5 5 -9 KeyframeEnd "
      "AttributeBegin Translate 0 1 0 CoordinateSystem \"seat\" AttributeEnd DynamicEnd";
  expect_ahead(in_camera("LookAt \"seat\" \"ball\" 0 1 0", cart, 13), std::hypot(6 - 2.5, 2.5 - 3.5, 2.5 + 9));
}

TEST(Aims, PlaceThingsThatFaceOthers) {
  // In a turned and moved parent, the z axis of what follows goes through the ball; by nesting, parents carry it along.
  const SceneDescription scene = good(std::string("Frames 25\nWorldBegin\n") + kBall + R"(
    DynamicBegin "head"
      Keyframe 1 Translate 0 0 0 Keyframe 25 Rotate 80 0 1 0 KeyframeEnd
      Translate 3 0 0
      LookAt 0 2 0 "ball" 0 1 0
      Shape "cone"
    DynamicEnd)");
  for (const int frame : {1, 7, 25}) {
    const Moment moment = Moment::numbered(frame);
    const Matrix4 head = scene.shapes.at(1).world_from_object.at(moment);
    const Matrix4 ball = scene.shapes.at(0).world_from_object.at(moment);
    const auto there = origin(*head.inverse() * ball);
    EXPECT_NEAR(there[0], 0, 1e-12);
    EXPECT_NEAR(there[1], 0, 1e-12);
    EXPECT_GT(there[2], 1);
  }
}

TEST(Aims, MakeTheCameraCubicToo) {
  const std::string view =
      "Keyframe 1 LookAt 0 0 -5 \"ball\" 0 1 0 Keyframe 5 LookAt 1 0 -5 \"ball\" 0 1 0 "
      "Keyframe 9 LookAt 4 0 -5 \"ball\" 0 1 0 KeyframeEnd";
  expect_ahead(in_camera(view, kBall, 3), std::hypot(1 - .25, 1.25, 5 + 5 / 12.));
}

TEST(Aims, AreForCamerasOfVariations) {
  const SceneDescription scene =
      good(std::string("Frames 25\nCamera \"c\" WorldBegin\n") + kBall +
           " VariationBegin \"close\" LookAt 1 2 -5 \"ball\" 0 1 0 Camera \"d\" VariationEnd");
  const Moment moment = Moment::numbered(13);
  expect_ahead(origin(scene.axes.at(0).variations.at(0).camera->camera_from_world.at(moment) *
                      scene.shapes.at(0).world_from_object.at(moment)),
               std::hypot(6 - 1, 1 + 1.5 - 2, 2.5 + 5));
}

TEST(Aims, AtTheCameraMakeBillboards) {
  const SceneDescription scene = good(
      "Frames 3\nKeyframe 1 LookAt 0 0 -5  0 0 0  0 1 0 Keyframe 3 LookAt 5 2 -5  0 0 0  0 1 0 KeyframeEnd Camera "
      "\"c\"\n"
      "WorldBegin DynamicBegin \"card\" LookAt 1 0 0 \"camera\" 0 1 0 Shape \"disk\" DynamicEnd");
  const auto eye = origin(*scene.shapes.at(0).world_from_object.at(Moment(2)).inverse() * Matrix4::translate(5, 2, -5));
  EXPECT_NEAR(eye[0], 0, 1e-12);
  EXPECT_NEAR(eye[1], 0, 1e-12);
  EXPECT_GT(eye[2], 0);
}

}  // namespace
}  // namespace dspm::test
