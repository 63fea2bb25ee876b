// Materials that come with geometry files, and what a scene may do with their names.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/errors.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace file_materials_test {

constexpr const char* kSquare = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

class FileMaterials : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& material) {
    put_file(directory / (name + ".mtl"), "newmtl paint\n" + material);
    put_file(directory / (name + ".obj"),
             fmt::format("mtllib {}.mtl\nusemtl paint\n{}f 1/1 2/2 3/3 4/4\n", name, kSquare));
  }
  /// Of one colour.
  void put_picture(const std::string& name, const Rgb& c) {
    std::string text = "PF\n2 2\n-1.0\n";
    for (int i = 0; i < 4; ++i) text.append(reinterpret_cast<const char*>(&c), 3 * sizeof(float));
    put_file(directory / name, text);
  }
  std::string shape(const std::string& name) const {
    return fmt::format("Shape \"objmesh\" \"string filename\" \"{}\"\n", (directory / (name + ".obj")).string());
  }
  /// What the middle of the image shows of the square z = 0, seen from the light's side, in the file's frames.
  std::vector<Rgb> seen(const std::string& contents, const std::string& lights) const {
    TestScene scene(R"(Integrator "path"
LookAt 0 0 3  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.1 .1 -.1 .1]
Film "rgb" "integer xresolution" 1 "integer yresolution" 1
WorldBegin
)" + lights + contents);
    std::vector<Rgb> seen;
    for (const Image& image : scene.render_all(1)) seen.push_back(image.pixels[0]);
    return seen;
  }

  TemporaryDirectory directory;
  /// Radiance of a white square: 1.
  const std::string light =
      "LightSource \"distant\" \"rgb L\" [3.14159265 3.14159265 3.14159265] \"point3 from\" [0 0 5]\n";
};

void expect_near(const Rgb& a, const Rgb& b) {
  EXPECT_NEAR(a.r, b.r, 1e-4);
  EXPECT_NEAR(a.g, b.g, 1e-4);
  EXPECT_NEAR(a.b, b.b, 1e-4);
}

/// The same everywhere, however the picture lies; but half of the slope is another normal.
TEST_F(FileMaterials, NormalsAndHolesTakeTheOptionsOfPictures) {
  put_picture("tilted.pfm", Rgb(0.65f, 0.5f, 0.95f)), put_picture("half.pfm", Rgb(0.5f));
  const auto radiance = [&](const std::string& statement) {
    put("m", "Kd 1 1 1\n" + statement);
    return seen(shape("m"), light)[0].g;
  };
  const float tilted = radiance("norm tilted.pfm\n");
  EXPECT_NEAR(tilted, 0.9f / std::hypot(0.3f, 0.9f), 1e-4);
  EXPECT_NEAR(radiance("norm -s 2 3 -o .5 tilted.pfm\n"), tilted, 1e-4);
  EXPECT_NEAR(radiance("norm -bm 2 tilted.pfm\n"), 0.9f / std::hypot(0.6f, 0.9f), 1e-4);
  EXPECT_EQ(radiance("map_d -mm 0 0 half.pfm\n"), 0) << "all holes";
  EXPECT_NEAR(radiance("map_d -mm 0 2 half.pfm\n"), 1, 1e-4) << "none";
}

TEST_F(FileMaterials, OfTheSameNameInTwoFilesAreTwo) {
  put("one", "Kd 0.5 0 0\n"), put("two", "Kd 0 0 0.25\n");
  const std::string both = shape("one") + "Translate 9 0 0 " + shape("two");
  expect_near(seen(both, light)[0], Rgb(0.5f, 0, 0));
  expect_near(seen("Translate -9 0 0 " + both, light)[0], Rgb(0, 0, 0.25f));
}

TEST_F(FileMaterials, KeShines) {
  put("lamp", "Kd 0 0 0\nKe 1 2 3\n");
  expect_near(seen(shape("lamp"), "")[0], Rgb(1, 2, 3));
  expect_near(seen("Rotate 180 0 1 0 " + shape("lamp"), "")[0], Rgb(1, 2, 3));
}

TEST_F(FileMaterials, TheScenesOfTheSameNameTakesTheirPlace) {
  put("one", "Kd 0.5 0 0\n");
  const std::string own = "MakeNamedMaterial \"paint\" \"string type\" \"diffuse\" \"rgb reflectance\" [0 .5 0]\n";
  expect_near(seen(own + shape("one"), light)[0], Rgb(0, 0.5f, 0));
}

TEST_F(FileMaterials, VariationsReplaceThem) {
  put("one", "Kd 0.5 0 0\nKe 1 1 1\n");
  const std::string variations = R"(
VariationBegin "as it is" Light "paint" "float scale" 1 VariationEnd
VariationBegin "blue" MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [0 0 .5] VariationEnd
VariationBegin "dark" Light "paint" "float scale" 0 VariationEnd
)";
  const std::vector<Rgb> frames = seen(shape("one") + variations, light);
  ASSERT_EQ(frames.size(), 3u);
  expect_near(frames[0], Rgb(1.5f, 1, 1));
  expect_near(frames[1], Rgb(0, 0, 0.5f));  // the light goes with its material
  expect_near(frames[2], Rgb(0.5f, 0, 0));
}

TEST_F(FileMaterials, PicturesOfLight) {
  put_picture("glow.pfm", Rgb(0.5f, 0.25f, 1));
  put("lamp", "Kd 0 0 0\nKe 4 4 4\nmap_Ke glow.pfm\n"), put("bright", "Kd 0 0 0\nmap_Ke glow.pfm\n");
  expect_near(seen(shape("lamp"), "")[0], Rgb(2, 1, 4));
  expect_near(seen(shape("bright"), "")[0], Rgb(0.5f, 0.25f, 1));
}

TEST_F(FileMaterials, DissolveIsAlpha) {
  put_picture("hole.pfm", Rgb(0));
  const std::string behind = "AttributeBegin Translate 0 0 -1 " + shape("paper") + "AttributeEnd\n";
  put("paper", "Kd 0.5 0.5 0.5\n"), put("gone", "Kd 1 0 0\nd 0\n");
  put("hole", "Kd 1 0 0\nPr 0.5\nmap_d hole.pfm\n");
  for (const char* front : {"gone", "hole"}) expect_near(seen(behind + shape(front), light)[0], Rgb(0.5f));
}

// Where map_Bump names a picture of normals, it is a normal map; a grey one holds heights.
TEST_F(FileMaterials, BumpMapsMayBeNormalMaps) {
  const float slant = std::sqrt(0.5f);
  put_picture("normals.pfm", Rgb(0.5f + 0.5f * slant, 0.5f, 0.5f + 0.5f * slant));
  put_picture("heights.pfm", Rgb(0.8f));
  put("bent", "Kd 1 1 1\nmap_Bump normals.pfm\n"), put("norm", "Kd 1 1 1\nnorm normals.pfm\n");
  put("flat", "Kd 1 1 1\nbump -bm 3 heights.pfm\n");
  expect_near(seen(shape("bent"), light)[0], Rgb(slant));
  expect_near(seen(shape("norm"), light)[0], Rgb(slant));
  expect_near(seen(shape("flat"), light)[0], Rgb(1));
}

// A picture whose left half is black and whose right half is white, of which the square sees a tenth.
TEST_F(FileMaterials, PicturesAreScaledAndMoved) {
  test::put_file(directory / "halves.pgm", "P2\n4 1\n1\n0 0 1 1\n");
  put("left", "map_Kd -s .1 .1 1 -o .2 0 halves.pgm\n"), put("right", "map_Kd -s .1 .1 1 -o .7 0 halves.pgm\n");
  put("dim", "map_Kd -s .1 .1 1 -o .7 0 -mm 0 .5 halves.pgm\n");
  expect_near(seen(shape("left"), light)[0], Rgb(0));
  expect_near(seen(shape("right"), light)[0], Rgb(1));
  expect_near(seen(shape("dim"), light)[0], Rgb(0.5f));
}

TEST_F(FileMaterials, OtherShapesUseThemByName) {
  put("one", "Kd 0.5 0 0\n"), put("two", "Kd 0 0 0.25\n");
  expect_near(seen("AttributeBegin Translate 9 0 0 " + shape("one") +
                       "AttributeEnd NamedMaterial \"paint\" Shape \"disk\" \"float radius\" 1\n",
                   light)[0],
              Rgb(0.5f, 0, 0));
}

TEST_F(FileMaterials, UnknownNamesAreErrorsWithAPlace) {
  put("one", "Kd 0.5 0 0\n");
  for (const char* mistake :
       {"MakeNamedMaterial \"pain\" \"string type\" \"diffuse\"", "Light \"lamp\" \"float scale\" 0"})
    try {
      seen(shape("one") + fmt::format("VariationBegin \"a\" {} VariationEnd\n", mistake), light);
      ADD_FAILURE() << mistake;
    } catch (const SceneError& e) {
      EXPECT_NE(std::string(e.what()).find("neither the scene nor its geometry files have"), std::string::npos)
          << e.what();
    }
}

}  // namespace file_materials_test
}  // namespace dspm::test
