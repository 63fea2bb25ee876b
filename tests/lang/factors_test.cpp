// Which of an animation's changes move paths, and which change only what they carry.
#include "dspm/lang/factors.h"

#include <gtest/gtest.h>

#include "dspm/lang/parse.h"

namespace dspm {
namespace {

bool moments_move_paths(const std::string& contents, const std::string& options = {}) {
  Diagnostics diagnostics;
  const SceneDescription scene =
      parse_text("scene.dsc", "Frames 5\n" + options + "\nWorldBegin\n" + contents, {}, diagnostics);
  diagnostics.throw_if_errors();
  return factors_of(scene).front().moves_paths;
}

TEST(Factors, MomentsMovePathsWherePlacesOrShapesChange) {
  const std::string keys = "Keyframe 1 Translate 0 0 0 Keyframe 5 Translate 1 0 0 KeyframeEnd\n";
  EXPECT_TRUE(moments_move_paths("DynamicBegin \"b\" " + keys + "Shape \"sphere\" DynamicEnd"));
  EXPECT_TRUE(moments_move_paths("DynamicBegin \"b\" " + keys + "LightSource \"point\" DynamicEnd"));
  EXPECT_TRUE(
      moments_move_paths("DynamicBegin \"b\" Shape \"sphere\" \"float radius@1\" 1 \"float radius@5\" 2 DynamicEnd"));
  EXPECT_TRUE(moments_move_paths("DynamicBegin \"b\" \"integer frames\" [2 5] Shape \"sphere\" DynamicEnd"));
  EXPECT_TRUE(moments_move_paths("ObjectBegin \"o\" Shape \"sphere\" ObjectEnd\nDynamicBegin \"b\" " + keys +
                                 "ObjectInstance \"o\" DynamicEnd"));
  EXPECT_TRUE(moments_move_paths("", keys + "Camera \"perspective\""));
  EXPECT_TRUE(moments_move_paths("", "Camera \"perspective\" \"float fov@1\" 40 \"float fov@5\" 50"));
  for (const char* end : {"from", "to"})
    EXPECT_TRUE(moments_move_paths(std::string("LightSource \"spot\" \"point3 ") + end + "@1\" [0 0 1] \"point3 " +
                                   end + "@5\" [0 1 1]"))
        << end;
}

TEST(Factors, MomentsMoveNoPathsWhereLooksAndStrengthsChange) {
  EXPECT_FALSE(moments_move_paths("DynamicBegin \"b\" Shape \"sphere\" DynamicEnd LightSource \"point\""));
  EXPECT_FALSE(
      moments_move_paths("LightSource \"point\" \"point3 from\" [0 0 1] \"float scale@1\" 1 \"float scale@5\" 2"));
  EXPECT_FALSE(moments_move_paths("Material \"diffuse\" \"rgb reflectance@1\" [0 0 0] \"rgb reflectance@5\" [1 1 1]"));
}

}  // namespace
}  // namespace dspm
