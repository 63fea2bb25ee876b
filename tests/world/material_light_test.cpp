// Materials that have holes and emit light: "alpha", "emission" and "emissionstrength" of principled.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/errors.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace material_light_test {

/// What lies around the middle of the square z = 0, seen straight on, in each frame: the mean of all pixels.
std::vector<Rgb> seen(const std::string& contents, int iterations = 1, const std::string& integrator = "\"path\"") {
  TestScene scene(fmt::format(R"(Integrator {}
LookAt 0 0 3  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.1 .1 -.1 .1]
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
{})",
                              integrator, contents));
  std::vector<Rgb> seen;
  for (const Image& image : scene.render_all(iterations)) {
    Rgb& mean = seen.emplace_back();
    for (const Rgb& c : image.pixels) mean += c / static_cast<float>(image.pixels.size());
  }
  return seen;
}
std::string said(const std::string& contents) {
  try {
    const TestScene scene("WorldBegin\n" + contents);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}
void expect_near(const Rgb& a, const Rgb& b, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

const std::string kDisk = "Shape \"disk\" \"float radius\" 1\n";
std::string glowing(const std::string& more) {
  return "Material \"principled\" \"rgb basecolor\" [0 0 0] \"float specular\" 0 " + more + "\n" + kDisk;
}
const std::string kGlow = "\"rgb emission\" [1 .5 .25] \"float emissionstrength\" 4";

TEST(MaterialLight, ShinesOnBothSides) {
  expect_near(seen(glowing(kGlow))[0], Rgb(4, 2, 1), 1e-4);
  expect_near(seen("Rotate 180 0 1 0 " + glowing(kGlow))[0], Rgb(4, 2, 1), 1e-4);
}

TEST(MaterialLight, IsNoLightWithoutEmission) {
  const TestScene scene("WorldBegin\nLightSource \"point\"\n" + glowing("\"rgb emission\" [0 0 0]") +
                        glowing("\"float emissionstrength\" 5"));
  EXPECT_EQ(scene.scene(scene.all_frames())->lights.size(), 1u);
}

// Over a disk of radius r at distance d, a point gets pi r^2 / (r^2 + d^2) of the radiance; a pattern that is white in
// half of each ring, the half of it.
TEST(MaterialLight, TexturesAreFoundByShadowRays) {
  const auto floor = [](const std::string& emission) {
    return "Texture \"halves\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 1 1] \"rgb tex2\" [0 0 0] "
           "\"float uscale\" 8 \"float vscale\" .001\n"
           "AttributeBegin Translate 0 0 4 Material \"principled\" " +
           emission + " Shape \"disk\" \"float radius\" 2 AttributeEnd\n" +
           "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\n" + kDisk;
  };
  for (const char* integrator : {R"("path")", R"("vcm" "integer photons" 4000)", R"("dsppm" "integer photons" 4000)"}) {
    const Rgb pattern = seen(floor(R"("texture emission" "halves" "float emissionstrength" 2)"), 64, integrator)[0];
    expect_near(pattern, Rgb(0.5f * 4 / 20), 0.004);
  }
}

TEST(MaterialLight, IsDimmedByItsNameAndReplacedWithItsMaterial) {
  const std::vector<Rgb> frames =
      seen("MakeNamedMaterial \"lamp\" \"string type\" \"principled\" \"rgb basecolor\" [0 0 0] \"float specular\" 0 " +
           kGlow + "\nNamedMaterial \"lamp\"\n" + kDisk + R"(
VariationBegin "as it is" Light "lamp" "float scale" 1 VariationEnd
VariationBegin "half" Light "lamp" "float scale" .5 VariationEnd
VariationBegin "off" MakeNamedMaterial "lamp" "string type" "diffuse" VariationEnd
)");
  ASSERT_EQ(frames.size(), 3u);
  expect_near(frames[0], Rgb(4, 2, 1), 1e-4);
  expect_near(frames[1], Rgb(2, 1, 0.5f), 1e-4);
  expect_near(frames[2], Rgb(0), 1e-6);
}

TEST(MaterialLight, KeysChangeIt) {
  const TestScene test("Frames 3\nWorldBegin\nLightSource \"point\"\n" +
                       glowing("\"rgb emission@1\" [0 0 0] \"rgb emission@3\" [2 2 2]"));
  const auto scene = test.scene(test.all_frames());
  ASSERT_EQ(scene->lights.size(), 2u);
  std::vector<float> powers(3, 0.f);
  for (const auto& state : scene->lights[1].states.states)
    for (Frame f = 0; f < 3; ++f)
      if (state.frames.contains(f)) powers[static_cast<std::size_t>(f)] = state.object->power().g;
  EXPECT_EQ(powers[0], 0);
  EXPECT_GT(powers[1], 0);
  EXPECT_NEAR(powers[2], 2 * powers[1], 1e-4f * powers[2]);
}

TEST(MaterialLight, TheShapesOwnLightTakesItsPlace) {
  expect_near(seen("AreaLightSource \"diffuse\" \"rgb L\" [3 3 3] \"bool twosided\" true\n" + glowing(kGlow))[0],
              Rgb(3), 1e-4);
}

TEST(MaterialHoles, LetCameraRaysThrough) {
  const std::string behind =
      "AttributeBegin Translate 0 0 -1 " + glowing("\"rgb emission\" [1 1 1]") + "AttributeEnd\n";
  const auto front = [&](const std::string& material, const std::string& shape = "") {
    return seen(behind + "Material \"principled\" \"rgb basecolor\" [0 0 0] \"float specular\" 0 " + material +
                    "\nShape \"disk\" \"float radius\" 1 " + shape + "\n",
                64)[0];
  };
  constexpr double kTolerance = 0.03;  // five deviations of 4096 rays
  expect_near(front(""), Rgb(0), 1e-6);
  expect_near(front("\"float alpha\" 0"), Rgb(1), 1e-4);
  expect_near(front("\"float alpha\" .25"), Rgb(0.75f), kTolerance);
  expect_near(front("\"float alpha\" .5", "\"float alpha\" .5"), Rgb(0.75f), kTolerance);
  expect_near(front("\"float alpha\" .25 \"rgb emission\" [2 2 2]"), Rgb(1.25f), 2 * kTolerance);
  expect_near(front("\"float alpha\" 0 \"rgb emission\" [2 2 2]"), Rgb(1), 1e-4);
}

// Parts a and b of a mix, b at a quarter of the points, in front of a radiance of 1.
TEST(MaterialHoles, AreThoseOfBothPartsOfAMix) {
  const auto front = [](const std::string& a, const std::string& b) {
    const std::string black = "\"string type\" \"principled\" \"rgb basecolor\" [0 0 0] \"float specular\" 0 ";
    return seen("AttributeBegin Translate 0 0 -1 " + glowing("\"rgb emission\" [1 1 1]") + "AttributeEnd\n" +
                    "MakeNamedMaterial \"a\" " + (a == "air" ? "\"string type\" \"interface\"" : black + a) +
                    "\nMakeNamedMaterial \"b\" " + (b == "air" ? "\"string type\" \"interface\"" : black + b) +
                    "\nMaterial \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" .25\n" + kDisk,
                64)[0];
  };
  constexpr double kTolerance = 0.03;  // five deviations of 4096 rays
  expect_near(front("", ""), Rgb(0), 1e-6);
  expect_near(front("", "air"), Rgb(0.25f), kTolerance);
  expect_near(front("air", ""), Rgb(0.75f), kTolerance);
  expect_near(front("\"float alpha\" .5", "air"), Rgb(0.625f), kTolerance);
  expect_near(front("", "\"rgb emission\" [4 2 0]"), Rgb(1, 0.5f, 0), 1e-4);
  expect_near(front("air", "\"rgb emission\" [4 4 4] \"float alpha\" .5"), Rgb(0.875f + 0.5f), 3 * kTolerance);
}

TEST(MaterialHoles, LetShadowRaysAndPhotonsThrough) {
  const std::string contents = R"(
LightSource "distant" "rgb L" [3.14159265 3.14159265 3.14159265] "point3 from" [5 0 5] "point3 to" [0 0 0]
AttributeBegin Translate 2 0 2 Rotate 45 0 1 0
Texture "holes" "float" "constant" "float value" .25
Material "principled" "texture alpha" "holes" "rgb basecolor" [0 0 0] "float specular" 0
Shape "disk" "float radius" 1 AttributeEnd
Material "diffuse" "rgb reflectance" [1 1 1]
)" + kDisk;
  const float lit = 0.75f * std::sqrt(0.5f);
  expect_near(seen(contents, 64)[0], Rgb(lit), 0.03);
  const char* photons = R"("dsppm" "string direct" "photons" "integer photons" 20000 "float radius" .3)";
  expect_near(seen(contents, 32, photons)[0], Rgb(lit), 0.04);
}

TEST(MaterialHoles, DifferBetweenFrames) {
  const TestScene test(R"(Frames 3
WorldBegin
LightSource "point"
MakeNamedMaterial "veil" "string type" "principled" "float alpha@1" 1 "float alpha@3" 0 "rgb basecolor@1" [1 0 0]
NamedMaterial "veil"
Shape "disk"
)");
  const auto scene = test.scene(test.all_frames());
  ASSERT_EQ(scene->shapes.size(), 2u);
  EXPECT_EQ(scene->shapes[0].cutout, nullptr);
  ASSERT_NE(scene->shapes[1].cutout, nullptr);
  EXPECT_EQ(scene->shapes[1].cutout->alpha({}), 0.5f);
}

// Frames whose material differs in other ways share the shape.
TEST(MaterialHoles, OfOneAlphaAreOneShape) {
  const TestScene test(R"(Frames 3
WorldBegin
LightSource "point"
Material "principled" "float alpha" .5 "rgb basecolor@1" [1 0 0] "rgb basecolor@3" [0 0 1]
Shape "disk"
)");
  EXPECT_EQ(test.scene(test.all_frames())->shapes.size(), 1u);
}

TEST(MaterialLight, FaultsHaveAWayOut) {
  const std::string curve =
      said(glowing(kGlow) + "Shape \"curve\" \"point3 P\" [0 0 0  1 0 0  2 0 0  3 1 0] \"float width\" .1");
  EXPECT_NE(curve.find("area light on shape \"curve\""), std::string::npos) << curve;
  EXPECT_NE(said("LightSource \"point\"\n" + glowing("\"texture emission\" \"nothing\"")).find("\"nothing\""),
            std::string::npos);
}

}  // namespace material_light_test
}  // namespace dspm::test
