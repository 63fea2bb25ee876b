// Materials that come with geometry files, and what a scene may do with their names.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/colour/rgb.h"
#include "dspm/params/errors.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

constexpr const char* kSquare = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";

class FileMaterials : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& material) {
    put_file(directory / (name + ".mtl"), "newmtl paint\n" + material);
    put_file(directory / (name + ".obj"), fmt::format("mtllib {}.mtl\nusemtl paint\n{}f 1 2 3 4\n", name, kSquare));
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
  expect_near(frames[1], Rgb(1, 1, 1.5f));
  expect_near(frames[2], Rgb(0.5f, 0, 0));
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

}  // namespace
}  // namespace dspm::test
