// Frames, Dynamic blocks, Keyframes and keyed parameters, against transforms computed by hand.
#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

Matrix4 at_key(const std::string& directives, int key) {
  const SceneDescription scene =
      good("Frames 25\nWorldBegin\nDynamicBegin \"a\"\n" + directives + "\nShape \"s\" DynamicEnd");
  return scene.shapes.at(0).world_from_object.at(Moment::numbered(key));
}

TEST(Animation, CountsFrames) {
  const SceneDescription scene = good("Frames 25 \"float fps\" 12.5\nWorldBegin");
  EXPECT_EQ(scene.moments, 25);
  EXPECT_EQ(scene.fps, 12.5);
  EXPECT_EQ(scene.frames_where.line, 1);
  EXPECT_FALSE(good("Frames 3 WorldBegin").fps);
}

TEST(Animation, DynamicBlocksHoldShapesLightsAndInstances) {
  const SceneDescription scene = good(R"(Frames 10
    WorldBegin
    Shape "static"
    DynamicBegin "a" "integer frames" [3 9]
      Shape "in a"
      DynamicBegin "b" "integer frames" [1 4] Shape "in b" DynamicEnd
      LightSource "point"
      ObjectInstance "leg"
    DynamicEnd
    Shape "static")");
  ASSERT_EQ(scene.dynamic_blocks.size(), 2u);
  EXPECT_EQ(scene.dynamic_blocks[0].name, "a");
  EXPECT_EQ(scene.dynamic_blocks[0].moments, (MomentInterval{Moment(2), Moment(9)}));
  EXPECT_EQ(scene.dynamic_blocks[1].moments, (MomentInterval{Moment(2), Moment(4)}));
  EXPECT_EQ(scene.shapes[0].dynamic_block, -1);
  EXPECT_EQ(scene.shapes[1].dynamic_block, 0);
  EXPECT_EQ(scene.shapes[2].dynamic_block, 1);
  EXPECT_EQ(scene.shapes[3].dynamic_block, -1);
  EXPECT_EQ(scene.lights[0].dynamic_block, 0);
  EXPECT_EQ(scene.instances[0].dynamic_block, 0);
  const SceneDescription late = good(R"(Frames 10
    WorldBegin
    DynamicBegin "a" "integer frames" [3 9] DynamicBegin "b" "integer frames" [8 10] DynamicEnd DynamicEnd)");
  EXPECT_EQ(late.dynamic_blocks[1].moments, (MomentInterval{Moment(7), Moment(9)}))
      << "no longer than the block around it";
  EXPECT_EQ(good("Frames 4 WorldBegin DynamicBegin \"a\" DynamicEnd").dynamic_blocks[0].moments,
            (MomentInterval{Moment(0), Moment(4)}));
}

TEST(Animation, ABlockBeyondTheLastFrameIsAWarning) {
  const Parsed parsed = parse("Frames 4\nWorldBegin\nDynamicBegin \"a\" \"integer frames\" [3 9]\nDynamicEnd");
  EXPECT_EQ(parsed.scene.dynamic_blocks[0].moments, (MomentInterval{Moment(2), Moment(4)}));
  EXPECT_EQ(parsed.messages(),
            "scene.dsc:3:18: warning: this key for frame 9 is out of range: the scene has 4 frames\n"
            "    3 | DynamicBegin \"a\" \"integer frames\" [3 9]\n"
            "      |                  ^~~~~~~~~~~~~~~~\n");
}

TEST(Animation, KeysInterpolateHoldAndMultiplyOn) {
  const std::string keys =
      "Translate 10 0 0  Keyframe 5 Translate 0 1 0  Keyframe 9 Translate 0 3 0  KeyframeEnd  Scale 2 2 2";
  const auto expected = [](double y) { return Matrix4::translate(10, y, 0) * Matrix4::scale(2, 2, 2); };
  expect_near(at_key(keys, 1), expected(1));
  expect_near(at_key(keys, 5), expected(1));
  expect_near(at_key(keys, 6), expected(1.5));
  expect_near(at_key(keys, 9), expected(3));
  expect_near(at_key(keys, 25), expected(3));
}

TEST(Animation, AFullTurnIsAFullTurn) {
  const std::string turn = "Keyframe 1 Rotate 0 0 1 0  Keyframe 17 Rotate 360 0 1 0  KeyframeEnd";
  for (int key = 1; key <= 17; ++key) expect_near(at_key(turn, key), Matrix4::rotate((key - 1) * 22.5, 0, 1, 0));
}

TEST(Animation, KeysAreLeftAsTold) {
  const auto keys = [](const std::string& ease) {
    return "Keyframe 1 \"string ease\" \"" + ease + "\" Translate 0 0 0  Keyframe 5 Translate 1 0 0  KeyframeEnd";
  };
  expect_near(at_key(keys("linear"), 2), Matrix4::translate(.25, 0, 0));
  expect_near(at_key(keys("smooth"), 2), Matrix4::translate(3 * .0625 - 2 * .015625, 0, 0));
  expect_near(at_key(keys("step"), 4), Matrix4{});
  expect_near(at_key(keys("step"), 5), Matrix4::translate(1, 0, 0));
}

TEST(Animation, EveryKeyStartsFromTheTransformBefore) {
  const std::string keys = "Keyframe 1 Translate 1 0 0 Rotate 90 0 0 1  Keyframe 3 Translate 1 0 0  KeyframeEnd";
  expect_near(at_key(keys, 3), Matrix4::translate(1, 0, 0));
  expect_near(at_key(keys, 2), Matrix4::translate(1, 0, 0) * Matrix4::rotate(45, 0, 0, 1));
}

TEST(Animation, TransformInAKeyReplacesWhatStoodBefore) {
  const std::string matrix = "Transform [1 0 0 0  0 1 0 0  0 0 1 0  4 0 0 1]";
  const std::string all = "Translate 9 9 9 Keyframe 1 Identity  Keyframe 3 " + matrix + " Translate 0 1 0 KeyframeEnd";
  expect_near(at_key(all, 1), Matrix4{});
  expect_near(at_key(all, 3), Matrix4::translate(4, 1, 0));
  const std::string one = "Translate 8 0 0 Keyframe 1 Scale 2 2 2  Keyframe 3 " + matrix + " KeyframeEnd";
  expect_near(at_key(one, 1), Matrix4::translate(8, 0, 0) * Matrix4::scale(2, 2, 2));
  expect_near(at_key(one, 2), Matrix4::translate(6, 0, 0) * Matrix4::scale(1.5, 1.5, 1.5));
  expect_near(at_key(one, 3), Matrix4::translate(4, 0, 0));
}

TEST(Animation, BlocksInsideHaveKeysOfTheirOwn) {
  const std::string keys = R"(
    Keyframe 1 Translate 0 0 0  Keyframe 3 Translate 2 0 0  KeyframeEnd
    AttributeBegin
      Keyframe 1 Rotate 0 0 0 1  Keyframe 5 Rotate 40 0 0 1  KeyframeEnd
      Shape "inner"
    AttributeEnd)";
  expect_near(at_key(keys, 2), Matrix4::translate(1, 0, 0) * Matrix4::rotate(10, 0, 0, 1));
}

TEST(Animation, TheCameraMoves) {
  const SceneDescription scene = good(R"(Frames 3
    Keyframe 1 LookAt 0 0 -5  0 0 0  0 1 0
    Keyframe 3 LookAt 0 0 -7  0 0 0  0 1 0
    KeyframeEnd
    Camera "perspective" "float fov@1" 30 "float fov@3" 40
    WorldBegin
    CoordSysTransform "camera"
    LightSource "point")");
  EXPECT_TRUE(scene.camera->camera_from_world.is_keyed());
  expect_near(scene.camera->camera_from_world.at(Moment(1)), Matrix4::translate(0, 0, 6));
  expect_near(scene.lights.at(0).world_from_light.at(Moment(1)), Matrix4::translate(0, 0, -6));
  EXPECT_EQ(floats(scene.camera->params.at(Moment(1)), "fov"), std::vector<float>{35});
}

TEST(Animation, KeyedParametersKeepTheirKeys) {
  const SceneDescription scene = good(R"(Frames 16
    WorldBegin
    Material "diffuse" "rgb reflectance@1" [.8 .1 .1] "rgb reflectance@16" [.1 .1 .8]
    Texture "t" "float" "constant" "float value@2" 1 "float value@3" 2
    AreaLightSource "diffuse" "rgb L@1" [1 1 1]
    DynamicBegin "a" Shape "sphere" "float radius@1" 1 "float radius@16" 2.5 DynamicEnd)");
  EXPECT_EQ(scene.materials[0].params.params[1].name, "reflectance");
  EXPECT_EQ(scene.materials[0].params.params[1].key, Moment::numbered(16));
  EXPECT_EQ(floats(scene.shapes[0].params.at(Moment(5)), "radius"), std::vector<float>{1.5f});
}

TEST(Animation, KeysOutsideAreWarnings) {
  const Parsed parsed = parse(R"(Keyframe 2 Translate 1 0 0 KeyframeEnd
Camera "perspective" "float fov@9" 3
WorldBegin
Material "diffuse" "float sigma@2" 1 "float sigma@3" 1)");
  EXPECT_EQ(parsed.diagnostics.error_count(), 0);
  ASSERT_EQ(parsed.diagnostics.all().size(), 2u);  // the first frame after the last is where a shutter may close
  EXPECT_EQ(parsed.diagnostics.all()[0].message, "this key for frame 9 is out of range: the scene has 1 frame");
  EXPECT_EQ(parsed.diagnostics.all()[1].where.line, 4);
}

}  // namespace
}  // namespace dspm::test
