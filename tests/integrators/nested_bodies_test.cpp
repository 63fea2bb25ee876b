// Bodies within bodies and bodies that overlap: by priorities, glasses filled with liquid and ice are the same as their
// boundaries modelled one by one, for every integrator; and slabs let through what the formulas say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace nested_bodies_test {

using test::TestScene;

const std::vector<std::string>& integrators() {
  static const std::vector<std::string> all{
      R"("path" "integer maxdepth" 16)",
      R"("vcm" "integer maxdepth" 16 "integer photons" 1000)",
      R"("dsppm" "integer maxdepth" 16 "integer photons" 1000)",
      R"("dsppm" "integer maxdepth" 16 "integer photons" 1000 "string direct" "photons" "string emission" "power")",
      R"("sppm" "integer maxdepth" 16 "integer photons" 1000 "string estimator" "hj09")",
      R"("photonmap" "integer maxdepth" 16 "integer photons" 2000 "integer causticphotons" 2000)",
  };
  return all;
}

/// Seen from above along z, in parallel rays.
std::string from_above(const std::string& integrator, const std::string& contents, int pixels = 4) {
  return fmt::format("Integrator {}", integrator) +
         fmt::format(R"(
LookAt 0 0 8  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.2 .2 -.2 .2]
PixelFilter "box"
Film "rgb" "integer xresolution" {0} "integer yresolution" {0}
WorldBegin
)",
                     pixels) +
         contents;
}
/// A closed box with outward normals.
std::string box(float bottom, float top, float width = 3) {
  return fmt::format(
      R"(Shape "trianglemesh" "point3 P" [-{2} -{2} {0} {2} -{2} {0} {2} {2} {0} -{2} {2} {0}
 -{2} -{2} {1} {2} -{2} {1} {2} {2} {1} -{2} {2} {1}]
  "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
)",
      bottom, top, width);
}
const std::string kLamp = R"(AttributeBegin Material "diffuse" "rgb reflectance" [0 0 0]
AreaLightSource "diffuse" "bool twosided" true Shape "disk" "float height" -1 "float radius" 20 AttributeEnd
)";
std::string medium(double eta, const std::string& colour, int priority) {
  return fmt::format("Material \"dielectric\" \"float eta\" {} \"rgb attenuationcolor\" [{}] \"integer priority\" {}\n",
                     eta, colour, priority);
}
Rgb mean_of(const std::string& text, int iterations) { return mean(TestScene(text).render(FileFrame(0), iterations)); }

const Rgb kGreen(.7f, .9f, .8f), kAmber(.9f, .6f, .3f), kBlue(.6f, .8f, .95f);
const std::string kGreenText = ".7 .9 .8", kAmberText = ".9 .6 .3", kBlueText = ".6 .8 .95";

/// All paths have the same colour, but roulette ends some.
template <class Expected>
void expect_colour(const Rgb& seen, Expected&& expected, const std::string& what) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(seen[c] / seen.g, expected(c) / expected(1), 1e-4) << what << ", colour " << c;
  EXPECT_NEAR(seen.g / expected(1), 1, 0.1) << what;
}

// Panes of 0 to 1 and 2 to 3.2, liquid between them that overlaps both by 0.1, and in it ice of 1.3 to 1.8. Bodies of index
// 1 bend and mirror nothing.
TEST(NestedBodies, AbsorbByWhatIsThere) {
  const std::string panes = medium(1, kGreenText, 3) + box(0, 1) + box(2, 3.2f),
                    liquid = medium(1, kAmberText, 1) + box(.9f, 2.1f, 2.9f),
                    ice = medium(1, kBlueText, 2) + box(1.3f, 1.8f, 2);
  for (const std::string& integrator : integrators())
    for (const std::string& order : {panes + liquid + ice, ice + liquid + panes})
      expect_colour(
          mean_of(from_above(integrator, kLamp + order, 32), 2),
          [](int c) { return std::pow(kGreen[c], 2.2f) * std::pow(kAmber[c], 0.5f) * std::pow(kBlue[c], 0.5f); },
          integrator);
}

/// What passes a stack of slabs straight on, reflected back and forth: interface by interface, from the lamp up.
struct Stack {
  double passes = 1, mirrors = 0;  // for light from below; `mirrors`: for light from above
  void add_boundary(double below, double above) {
    const double r = std::pow((below - above) / (below + above), 2), again = 1 - mirrors * r;
    passes *= (1 - r) / again;
    mirrors = r + (1 - r) * (1 - r) * mirrors / again;
  }
  void add_length(double left) { passes *= left, mirrors *= left * left; }
};

TEST(NestedBodies, MirrorAndPassAsTheirBoundariesDo) {
  const double glass = 1.5, water = 1.33, ice = 1.31;
  const std::string panes = medium(glass, kGreenText, 3) + box(0, 1) + box(2, 3.2f),
                    liquid = medium(water, kAmberText, 1) + box(.9f, 2.1f, 2.9f),
                    cube = medium(ice, kBlueText, 2) + box(1.3f, 1.8f, 2);
  std::vector<double> expected;
  for (int c = 0; c < 3; ++c) {
    Stack stack;
    const auto length = [&](const Rgb& colour, double d) { stack.add_length(std::pow(double{colour[c]}, d)); };
    stack.add_boundary(1, glass), length(kGreen, 1), stack.add_boundary(glass, water), length(kAmber, .3);
    stack.add_boundary(water, ice), length(kBlue, .5), stack.add_boundary(ice, water), length(kAmber, .2);
    stack.add_boundary(water, glass), length(kGreen, 1.2), stack.add_boundary(glass, 1);
    expected.push_back(stack.passes);
  }
  for (const std::string& integrator : integrators()) {
    const Rgb seen = mean_of(from_above(integrator, kLamp + panes + liquid + cube, 32), 12);
    // 4.5 standard errors of independent paths. Roulette thins them, so that they differ by 0.9 of their mean.
    const double error = 4.5 * .9 / std::sqrt(32. * 32 * 12);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(seen[c] / expected[static_cast<std::size_t>(c)], 1, error) << integrator << ", colour " << c;
  }
}

// What closed bodies that overlap by accident come to: their surfaces mirror as if air lay between them, but the colours
// are there.
TEST(NestedBodies, OfEqualPriorityKeepTheirColours) {
  const std::string panes = R"(Material "dielectric" "float eta" 1 )" + box(0, 1) + box(2, 3.2f),
                    liquid = R"(Material "dielectric" "float eta" 1 "rgb attenuationcolor" [)" + kAmberText + "]" +
                             box(.9f, 2.1f, 2.9f);
  for (const std::string& integrator : integrators())
    expect_colour(
        mean_of(from_above(integrator, kLamp + panes + liquid, 32), 2), [](int c) { return std::pow(kAmber[c], 1.1f); },
        integrator);
}

/// A glass ball with a hollow that is filled with liquid, in which an ice ball swims, on a matte floor.
std::string filled_ball(const std::string& integrator, const std::string& contents, const std::string& lamp) {
  return "Integrator " + integrator + R"(
LookAt 0 -5 3  0 0 0  0 0 1
Camera "perspective" "float fov" 30
PixelFilter "box"
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
WorldBegin
Material "diffuse" "rgb reflectance" [.6 .5 .4]
AttributeBegin Translate 0 0 -1.2 Shape "disk" "float radius" 4 AttributeEnd
)" + lamp +
         contents;
}
const std::string kSky =
    R"(AttributeBegin Translate 1 -1 4 Rotate 180 1 0 0 Material "diffuse" "rgb reflectance" [0 0 0]
AreaLightSource "diffuse" "rgb L" [6 6 6] Shape "disk" "float radius" 1 AttributeEnd
)";
const std::string kLampWithin = R"(AttributeBegin Translate -.4 -.2 .1 Material "diffuse" "rgb reflectance" [0 0 0]
AreaLightSource "diffuse" "rgb L" [40 40 40] Shape "sphere" "float radius" .1 AttributeEnd
)";
std::string ball(double radius, const std::string& place = "Translate 0 0 0") {
  return fmt::format("AttributeBegin {} Shape \"sphere\" \"float radius\" {} AttributeEnd\n", place, radius);
}
const std::string kInTheMiddle = "Translate .2 0 .15";
std::string by_priorities(const std::string& type, const std::string& rough = "") {
  const auto body = [&](double eta, const std::string& colour, int priority) {
    return fmt::format("Material {} {} \"float eta\" {} \"rgb attenuationcolor\" [{}] \"integer priority\" {}\n", type,
                       rough, eta, colour, priority);
  };
  return body(1.5, kGreenText, 3) + ball(1) + "ReverseOrientation\n" + ball(.75) + "ReverseOrientation\n" +
         body(1.33, kAmberText, -1) + ball(.85) + body(1.31, kBlueText, 1) + ball(.4, kInTheMiddle);
}
std::string by_boundaries(const std::string& type, const std::string& rough = "") {
  const auto boundary = [&](double eta, const std::string& colour) {
    return fmt::format("Material {} {} \"float eta\" {} \"rgb attenuationcolor\" [{}]\n", type, rough, eta, colour);
  };
  return boundary(1.5, kGreenText) + ball(1) + boundary(1.33 / 1.5, kAmberText) + ball(.75) +
         boundary(1.31 / 1.33, kBlueText) + ball(.4, kInTheMiddle);
}

/// The same random numbers lead along the same paths, but for rounding at a few surfaces. What is learned multiplies
/// rounding, so nothing is.
void expect_alike(const std::string& a, const std::string& b, int iterations, double error, const std::string& what) {
  const Image seen = TestScene(a).render(FileFrame(0), iterations),
              expected = TestScene(b).render(FileFrame(0), iterations);
  ASSERT_GT(mean(expected).g, 0.01f) << what;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean(seen)[c] / mean(expected)[c], 1, error) << what;
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < seen.pixels.size(); ++i)
    difference += std::abs(double{seen.pixels[i].g} - double{expected.pixels[i].g}),
        sum += double{expected.pixels[i].g};
  EXPECT_LT(difference / sum, 3 * error) << what;
}

TEST(NestedBodies, AreTheSameAsTheirBoundaries) {
  for (const std::string& integrator : integrators()) {
    if (integrator.find("vcm") != std::string::npos) continue;  // it always learns
    const bool learns =
        integrator.find("photons") != std::string::npos && integrator.find("emission") == std::string::npos;
    const std::string unguided = integrator + (learns ? R"( "string emission" "power")" : "");
    for (const std::string& lamp : {kSky, kLampWithin})
      expect_alike(filled_ball(unguided, by_priorities("\"dielectric\""), lamp),
                   filled_ball(unguided, by_boundaries("\"dielectric\""), lamp), 4, 0.01, unguided + lamp);
  }
}

// Rough surfaces scatter in other directions if their normals point the other way.
TEST(NestedBodies, AgreeWithTheirBoundaries) {
  const std::string materials[][2] = {{"\"dielectric\"", ""}, {"\"dielectric\"", "\"float roughness\" .1"}};
  for (const std::string& integrator : {integrators()[0], integrators()[1], integrators()[2]})
    for (const auto& [type, rough] : materials) {
      if (rough.empty() && integrator.find("vcm") == std::string::npos) continue;
      const auto seen = test::rendered(filled_ball(integrator, by_priorities(type, rough), kLampWithin), 4),
                 expected = test::rendered(filled_ball(integrator, by_boundaries(type, rough), kLampWithin), 4);
      const test::Verdict verdict = test::agreement(seen, expected);
      EXPECT_TRUE(verdict.passed) << integrator << rough << verdict.message;
    }
}

// Two bodies in glass of index 1, a lamp and a matte disk, see one another through a surface that is not there.
TEST(NestedBodies, SurfacesThatAreNotThereThrowNoShadow) {
  const auto scene = [](const std::string& integrator, const std::string& hidden) {
    return from_above(integrator, R"(Material "diffuse" Shape "disk" "float radius" 2
AttributeBegin Translate 1.2 0 1.5 Rotate 180 1 0 0 AreaLightSource "diffuse" "rgb L" [200 200 200]
Material "diffuse" "rgb reflectance" [0 0 0] Shape "disk" "float radius" .05 AttributeEnd
)" + medium(1, kGreenText, 1) + box(-1, 2) +
                                      hidden);
  };
  for (const std::string& integrator : integrators())
    expect_alike(scene(integrator, medium(1.4, kAmberText, 0) + box(-.9f, .75f, 2.5f)), scene(integrator, ""), 4, 0.02,
                 integrator);
}

// A lamp in the body of the camera, 3 away from it.
TEST(NestedBodies, AroundTheCameraAreFound) {
  for (const std::string& integrator : integrators()) {
    const Rgb seen = mean_of("Integrator " + integrator + R"(
Camera "perspective" "float fov" 2
Film "rgb" "integer xresolution" 2 "integer yresolution" 2
WorldBegin
AttributeBegin Translate 0 0 3 AreaLightSource "diffuse" "bool twosided" true Shape "disk" AttributeEnd
)" + medium(1.5, kGreenText, 1) + ball(5) +
                                 medium(1.3, kAmberText, 0) + ball(4),
                             1);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], std::pow(kGreen[c], 3), 1e-3) << integrator;
  }
}

// Frames in which priorities, colours, indices or places differ: each is what it would be alone.
TEST(NestedBodies, DifferBetweenFrames) {
  const std::string sharing[] = {R"("integer priority@1" -1 "integer priority@3" 4 )",
                                 R"("rgb attenuationcolor@1" [.9 .6 .3] "rgb attenuationcolor@4" [.3 .6 .9] )",
                                 R"("float eta@1" 1.33 "float eta@4" 1.45 )"};
  for (const std::string& integrator : {integrators()[0], integrators()[1], integrators()[2], integrators()[4]})
    for (int kind = 0; kind < 4; ++kind) {
      std::string liquid = R"(Material "dielectric" )";
      liquid += kind == 0 ? sharing[0] : R"("integer priority" -1 )";
      liquid += kind == 1 ? sharing[1] : R"("rgb attenuationcolor" [.9 .6 .3] )";
      liquid += kind == 2 ? sharing[2] : R"("float eta" 1.33 )";
      const std::string moves =
          "DynamicBegin \"liquid\" Keyframe 1 Translate 0 0 0 Keyframe 4 Translate 0 0 .3 KeyframeEnd\n";
      const std::string place = kind == 3 ? moves + ball(.85) + "DynamicEnd\n" : ball(.85);
      const std::string contents = medium(1.5, kGreenText, 3) + ball(1) + "ReverseOrientation\n" + ball(.75) +
                                   "ReverseOrientation\n" + liquid + place + medium(1.31, kBlueText, 1) +
                                   ball(.4, kInTheMiddle);
      TestScene scene("Frames 4\n" + filled_ball(integrator, contents, kSky));
      const std::vector<Image> joint = scene.render_all(2);
      for (int f = 0; f < 4; ++f) {
        const Image alone = scene.render(FileFrame(f), 2);
        EXPECT_LT(max_difference(joint[static_cast<std::size_t>(f)], alone), 1e-4 * double{mean(alone).g} + 1e-4)
            << integrator << ", kind " << kind << ", frame " << f;
      }
    }
}

}  // namespace nested_bodies_test
}  // namespace dspm
