// Shapes with holes: what rays, shadow rays, photons and connections make of "alpha", in every integrator.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace alpha_test {

constexpr const char* kIntegrators[] = {
    R"("path" "integer maxdepth" 4)",
    R"("dsppm" "integer photons" 6000 "float radius" 0.05)",
    R"("dsppm" "integer photons" 6000 "float radius" 0.05 "string direct" "photons" "string estimator" "hj09")",
    R"("sppm" "integer photons" 6000 "float radius" 0.05)",
    R"("photonmap" "integer photons" 20000 "integer causticphotons" 20000 "float radius" 0.1)",
    R"("vcm" "integer photons" 3000)",
};

constexpr const char* kSquare = R"("integer indices" [0 1 2 0 2 3] "point2 uv" [0 0 1 0 1 1 0 1])";

/// Looks along z, from the origin.
std::string view(const std::string& integrator, const std::string& world) {
  return "Integrator " + integrator +
         R"(
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
)" + world;
}

/// A wall of radiance 1 that fills the view.
constexpr const char* kGlow = R"(
AttributeBegin
  Material "diffuse" "rgb reflectance" [0 0 0]
  AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
  Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-9 -9 5 9 -9 5 9 9 5 -9 9 5]
AttributeEnd
Material "diffuse" "rgb reflectance" [0 0 0]
)";

struct Screen {
  const char* text;
  float open;  // the fraction of rays that pass
};
const Screen kScreens[] = {
    {R"(Shape "trianglemesh" "float alpha" 0.4 "integer indices" [0 1 2 0 2 3] "point3 P" [-9 -9 2 9 -9 2 9 9 2 -9 9 2])",
     0.6f},
    {R"(Shape "bilinearmesh" "float alpha" 0.4 "point3 P" [-9 -9 2 9 -9 3 -9 9 4 9 9 2])", 0.6f},
    {R"(Shape "disk" "float alpha" 0.5 "float radius" 9 "float height" 2)", 0.5f},
    // The view is within the ball, and then before it: rays enter and leave.
    {R"(Shape "sphere" "float alpha" 0.5 "float radius" 2)", 0.5f},
    {R"(Translate 0 0 3 Shape "sphere" "float alpha" 0.5 "float radius" 1.9)", 0.25f},
    {R"(ObjectBegin "two" Shape "trianglemesh" "float alpha" 0.5 "integer indices" [0 1 2 0 2 3]
  "point3 P" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] ObjectEnd
Translate 0 0 2 ObjectInstance "two" Translate 0 0 1 ObjectInstance "two")",
     0.25f},
    {R"(Texture "half" "float" "checkerboard" "float tex1" 0.5 "float tex2" 0.5
Shape "disk" "texture alpha" "half" "float radius" 9 "float height" 2)",
     0.5f},
};

TEST(Alpha, IsTheFractionOfRaysThatAreStopped) {
  for (const Screen& screen : kScreens) {
    std::string text = view(R"("path")", std::string(kGlow) + screen.text);
    if (std::string(screen.text).rfind("Translate 0 0 3", 0) == 0)  // the ball covers the middle of the view
      text.replace(text.find("\"float fov\" 40"), 14, "\"float fov\" 20");
    const Verdict verdict = agreement(rendered(text, 16, seeds(16), 2), Rgb(screen.open), {0.01 / 7});
    EXPECT_TRUE(verdict.passed) << screen.text << ": " << verdict.message;
  }
}

/// A floor under a lamp, with something between them.
std::string floor_under(const std::string& integrator, const std::string& lamp, const std::string& between) {
  return view(integrator, R"(
AttributeBegin
  Rotate -40 1 0 0
  Translate 0 0 3
  Material "diffuse" "rgb reflectance" [.8 .8 .8]
  Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-2 -2 0 2 -2 0 2 2 0 -2 2 0]
  Material "diffuse" "rgb reflectance" [0 0 0]
  AttributeBegin
    Translate 0 0 -1.6
    AreaLightSource "diffuse" )" +
                              lamp + R"(
  AttributeEnd
)" + between + "AttributeEnd\n");
}

constexpr const char* kLamp = R"("rgb L" [8 8 8] Shape "disk" "float radius" 0.3)";
constexpr const char* kDimLamp = R"("rgb L" [4 4 4] Shape "disk" "float radius" 0.3)";

// The lamp and the screen are above the camera's view, so all light comes from the floor.
TEST(Alpha, HalfOfTheLightPassesAScreen) {
  for (const char* integrator : kIntegrators) {
    const std::string screen = R"(
    Shape "trianglemesh" "float alpha" 0.5 "integer indices" [0 1 2 0 2 3]
      "point3 P" [-.45 -.45 -1.5 .45 -.45 -1.5 .45 .45 -1.5 -.45 .45 -1.5]
)";
    const Tiles with = rendered(floor_under(integrator, kLamp, screen), 2, seeds(8), 1);
    const Tiles without = rendered(floor_under(integrator, kDimLamp, ""), 2, seeds(8), 1);
    const Verdict verdict = agreement(with, without, {0.01 / 6, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

TEST(Alpha, ALightShinesAsFarAsItIsThere) {
  for (const char* integrator : kIntegrators) {
    const Tiles holes =
        rendered(floor_under(integrator, R"("rgb L" [8 8 8] Shape "disk" "float radius" 0.3 "float alpha" 0.5)", ""), 2,
                 seeds(8), 1);
    const Tiles dim = rendered(floor_under(integrator, kDimLamp, ""), 2, seeds(8), 1);
    const Verdict verdict = agreement(holes, dim, {0.01 / 6, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

// pbrt's way to have a light that is not seen: alpha 0.
TEST(Alpha, ALightThatIsAHoleShinesAndIsNotSeen) {
  for (const char* integrator : kIntegrators) {
    const Tiles hidden =
        rendered(floor_under(integrator, R"("rgb L" [8 8 8] Shape "disk" "float radius" 0.3 "float alpha" 0)", ""), 2,
                 seeds(8), 1);
    const Tiles seen = rendered(floor_under(integrator, kLamp, ""), 2, seeds(8), 1);
    const Verdict verdict = agreement(hidden, seen, {0.01 / 6, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
  TestScene in_view(view(R"("path")", R"(
AreaLightSource "diffuse" "rgb L" [1 1 1] "bool twosided" true
Shape "disk" "float alpha" 0 "float height" 2)"));
  EXPECT_EQ(max_component(mean(in_view.render(FileFrame(0), 2))), 0);
}

/// A card of 6 x 6 squares over a box's floor, as one square with holes or as the squares that are there.
std::string card(bool cut) {
  if (cut)
    return R"(
Texture "holes" "float" "checkerboard" "float uscale" 6 "float vscale" 6
Shape "trianglemesh" "texture alpha" "holes" )" +
           std::string(kSquare) + R"( "point3 P" [-.6 -.3 -.6 .6 -.3 -.6 .6 -.1 .6 -.6 -.1 .6])";
  std::string indices, points;
  int count = 0;
  for (int y = 0; y < 6; ++y)
    for (int x = y % 2; x < 6; x += 2, count += 4) {
      const auto at = [&](int i, int j) {
        points += fmt::format("{} {} {} ", -0.6 + 0.2 * i, -0.3 + 0.2 / 6 * j, -0.6 + 0.2 * j);
      };
      at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1);
      indices += fmt::format("{} {} {} {} {} {} ", count, count + 1, count + 2, count, count + 2, count + 3);
    }
  return "Shape \"trianglemesh\" \"integer indices\" [" + indices + "] \"point3 P\" [" + points + "]";
}

TEST(Alpha, ACheckerboardIsAMeshWithHoles) {
  for (const char* integrator : kIntegrators) {
    const std::string options = std::string("Integrator ") + integrator + "\n";
    const Tiles cut = rendered(box(options, card(true)), 2, seeds(8), 2);
    const Tiles made = rendered(box(options, card(false)), 2, seeds(8), 2);
    const Verdict verdict = agreement(cut, made, {0.01 / 6, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

// Camera paths draw equal numbers in both, so nearly all pixels are equal.
TEST(Alpha, RaysMeetTheSamePlaces) {
  const std::string options = R"(Integrator "path" "integer maxdepth" 3
)";
  TestScene cut(box(options, card(true))), made(box(options, card(false)));
  const Image a = cut.render(FileFrame(0), 4), b = made.render(FileFrame(0), 4);
  int differ = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Rgb d = a.pixels[i] - b.pixels[i];
    differ += std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)}) > 1e-3f ? 1 : 0;
  }
  EXPECT_LT(differ, 0.03 * static_cast<double>(a.pixels.size()));
}

constexpr const char* kLeaves = R"(
Texture "leaf" "float" "checkerboard" "float uscale" 5 "float vscale" 5 "float tex1" 0.7
DynamicBegin "fading"
  Translate 0.2 -0.3 0
  Shape "sphere" "float radius" 0.4 "float alpha@1" 1 "float alpha@3" 0.3 "float alpha@4" 0
DynamicEnd
DynamicBegin "moving"
  Keyframe 1 Translate -0.4 -0.5 0 Keyframe 4 Translate -0.1 -0.5 0.2 Rotate 40 0 1 0 KeyframeEnd
  Shape "disk" "texture alpha" "leaf" "float radius" 0.4
  Shape "bilinearmesh" "texture alpha" "leaf" "point3 P" [-.4 -.2 -.5 .2 .2 -.4 -.4 .3 .2 .4 .2 .4]
DynamicEnd
DynamicBegin "glowing"
  AreaLightSource "diffuse" "rgb L" [2 3 4] "bool twosided" true
  Translate 0.5 0 -0.2
  Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 .3 0 0 0 .4 .1] "float alpha@1" 0.2 "float alpha@4" 1
DynamicEnd
VariationBegin "green" Texture "leaf" "float" "checkerboard" "float uscale" 3 VariationEnd
VariationBegin "bare" Texture "leaf" "float" "constant" "float value" 0.2 VariationEnd
)";

TEST(Alpha, FramesAreWhatTheyAreAlone) {
  for (const char* integrator : kIntegrators) {
    const std::string text = box(std::string("Frames 4\nIntegrator ") + integrator + "\n", kLeaves);
    for (const Verdict& verdict : {check_joint(text, 2), check_threads(text, 2), check_crop(text, 2)})
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

}  // namespace alpha_test
}  // namespace dspm::test
