// What the world makes of "alpha" and "displacement": placed shapes, their holes, and messages.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "dspm/base/params/errors.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace alpha_test {

using test::box;
using test::TestScene;

/// A box with contents, and its scene of all frames.
class Made {
 public:
  explicit Made(const std::string& contents, int frames = 1, const std::string& option = "")
      : test_(box("Frames " + std::to_string(frames) + "\n" + option + "\n", contents)),
        scene_(test_.scene(test_.all_frames())) {}

  std::size_t count() const { return scene_->shapes.size(); }
  /// Its shapes from the last one on.
  const PlacedShape& last(std::size_t before = 0) const { return scene_->shapes[count() - 1 - before]; }

 private:
  TestScene test_;
  std::unique_ptr<Scene> scene_;
};

std::size_t count(const std::string& contents) { return Made(contents).count() - Made("").count(); }

std::string fault(const std::string& contents) {
  try {
    TestScene test(box("", contents));
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(Alpha, ConstantsNeedNoTexture) {
  EXPECT_EQ(Made("Shape \"sphere\" \"float alpha\" 1").last().cutout, nullptr);
  EXPECT_NE(Made("Shape \"sphere\" \"float alpha\" .5").last().cutout, nullptr);
  EXPECT_EQ(count("Shape \"sphere\" \"float alpha\" 1"), 1u);
  EXPECT_EQ(count("Shape \"sphere\" \"float alpha\" 0"), 0u);
  EXPECT_EQ(count("AreaLightSource \"diffuse\" Shape \"sphere\" \"float alpha\" 0"), 0u);
}

// One sphere in three states of alpha: there, half there, and not there.
TEST(Alpha, AnotherAlphaIsAnotherPlacedShapeOfTheSameGeometry) {
  const Made made(R"(DynamicBegin "fading"
    Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "float alpha@1" 1 "float alpha@3" 0 Translate 0 0 0 DynamicEnd)",
                  3);
  const PlacedShape &half = made.last(), &whole = made.last(1);
  EXPECT_EQ(whole.frames, FrameSet::single(0));
  EXPECT_EQ(half.frames, FrameSet::single(1));
  EXPECT_EQ(whole.shape, half.shape);
  EXPECT_EQ(whole.cutout, nullptr);
  ASSERT_NE(half.cutout, nullptr);
  EXPECT_EQ(half.cutout->alpha({}), 0.5f);
  EXPECT_EQ(whole.cutout_key, half.cutout_key);
}

TEST(Alpha, TexturesDifferByVariationsOutsideOfDynamicBlocks) {
  const Made made(R"(
Texture "leaf" "float" "constant" "float value" 0.25
Shape "sphere" "texture alpha" "leaf"
VariationBegin "spring" Texture "leaf" "float" "constant" "float value" 0.25 VariationEnd
VariationBegin "autumn" Texture "leaf" "float" "constant" "float value" 0.75 VariationEnd)");
  EXPECT_EQ(made.last(1).cutout->alpha({}), 0.25f);
  EXPECT_EQ(made.last().cutout->alpha({}), 0.75f);
  EXPECT_EQ(made.last().frames, FrameSet::single(1));
}

TEST(Alpha, FaultsAreErrorsWithTheirPlace) {
  EXPECT_NE(fault("Shape \"sphere\" \"texture alpha\" \"leave\"").find("there is no texture \"leave\""),
            std::string::npos);
  const std::string colour = fault("Shape \"sphere\" \"rgb alpha\" [1 1 1]");
  EXPECT_NE(colour.find("alpha"), std::string::npos) << colour;
  EXPECT_NE(colour.find("shape \"sphere\""), std::string::npos) << colour;
  EXPECT_EQ(colour.find("scale"), std::string::npos) << colour;
}

TEST(Displacement, DependsOnTheTextureAndItsFrames) {
  const auto file = std::filesystem::temp_directory_path() / "dspm_displacement_test.ply";
  std::ofstream(file)
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\n"
         "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
  const std::string mesh = "Shape \"plymesh\" \"string filename\" \"" + file.string() + "\"";
  const Made made(R"(
Texture "height" "float" "constant" "float value@1" 0.25 "float value@2" 0.5
)" + mesh + R"( "texture displacement" "height" "float edgelength" 0.4)",
                  2);
  const PlacedShape &first = made.last(1), &second = made.last();
  EXPECT_GT(first.shape->primitive_count(), 4);
  EXPECT_EQ(first.surface_point(0, {0.3f, 0.3f}).p.z, 0.25f);
  EXPECT_EQ(second.surface_point(0, {0.3f, 0.3f}).p.z, 0.5f);
  const auto triangles = [&](const std::string& option) {
    return Made(mesh + " \"float displacement\" 1 \"float edgelength\" 0.4", 1, option).last().shape->primitive_count();
  };
  EXPECT_EQ(triangles("Option \"displacementedgescale\" 4"), 1);
  EXPECT_GT(triangles(""), 4);
  EXPECT_NE(fault(mesh + " \"float displacement\" 1 \"float edgelength\" 1e-6").find("20 million"), std::string::npos);
  EXPECT_NE(fault(mesh + " \"float displacement\" 1 \"float edgelength\" 0").find("above 0"), std::string::npos);
}

}  // namespace alpha_test
}  // namespace dspm
