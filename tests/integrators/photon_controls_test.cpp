// What "photons" and "caustics" of lights and shapes do to photons: the one changes no mean, the other takes out what
// comes by way of smooth lobes, and nothing else.
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/testing/promises.h"
#include "tests/integrators/floor.h"

namespace dspm::test {
namespace photon_controls_test {

/// As in caustics_test.cpp: a lamp of radius 0.4, 0.8 above (x, 0), and a mirror at x = 0.9.
std::string lamp(double x, const std::string& words = "") {
  return fmt::format(R"(
AttributeBegin
AreaLightSource "diffuse" "rgb L" [4 4 4] {}
Material "diffuse" "rgb reflectance" [0 0 0]
Translate {} 0 .8
Rotate 180 1 0 0
Shape "disk" "float radius" .4
AttributeEnd
)",
                     words, x);
}
std::string mirror(const std::string& words = "") {
  return R"(
Material "conductor" "rgb reflectance" [1 1 1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [.9 -4 0 .9 4 0 .9 4 3 .9 -4 3] )" +
         words;
}
double from_lamp(double x, double y, double lamp_x) {
  return 4 * kPiExactly * disk_form_factor(std::hypot(x - lamp_x, y), 0.8, 0.4);
}

constexpr const char* kIntegrators[] = {
    R"("sppm" "integer photons" 10000 "float radius" .04)",
    R"("dsppm" "integer photons" 10000 "float radius" .04)",
    R"("dsppm" "integer photons" 10000 "float radius" .04 "string emission" "power" "string estimator" "hj09")",
    R"("dsppm" "integer photons" 10000 "float radius" .04 "string direct" "sampled")",
    R"("photonmap" "integer photons" 1000 "integer causticphotons" 10000 "float causticradius" .04)",
};

void expect_floor(const std::string& world, const Irradiance& irradiance) {
  constexpr int kComparisons = 4 * std::size(kIntegrators);
  const Floor floor{world, 0.8};
  const Tiles exact = tiles_of({{floor_picture(floor, irradiance)}}, 2);
  for (const char* integrator : kIntegrators) {
    const Verdict verdict =
        agreement(rendered(floor.text(integrator), 2, seeds(16), 2), exact, {0.01 / kComparisons, floor.bias});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

TEST(PhotonControls, PhotonsChangeNoMean) {
  expect_floor(lamp(-0.3, "\"float photons\" 10") + lamp(0.2, "\"float photons\" .2") + mirror(),
               [](double x, double y) {
                 double sum = 0;
                 for (const double lamp_x : {-0.3, 2.1, 0.2, 1.6}) sum += from_lamp(x, y, lamp_x);
                 return sum;
               });
}

TEST(PhotonControls, AShapeMakesNoCaustics) {
  expect_floor(lamp(0.2) + mirror("\"bool caustics\" false"), [](double x, double y) { return from_lamp(x, y, 0.2); });
}

// Only the second lamp has an image in the mirror.
TEST(PhotonControls, ALightMakesNoCaustics) {
  expect_floor(lamp(-0.3, "\"bool caustics\" false") + lamp(0.2) + mirror(),
               [](double x, double y) { return from_lamp(x, y, -0.3) + from_lamp(x, y, 0.2) + from_lamp(x, y, 1.6); });
}

// The roughness decides: 0.3 scatters as matte surfaces do, whatever "caustics" says.
TEST(PhotonControls, RoughLobesAreNoCaustics) {
  const auto image = [](const std::string& words) {
    const Floor floor{lamp(0.2) + R"(
Material "conductor" "bool remaproughness" false "float roughness" .3
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [.9 -4 0 .9 4 0 .9 4 3 .9 -4 3] )" +
                      words};
    return TestScene(floor.text(kIntegrators[1])).render_all(2).front();
  };
  const Image with = image(""), without = image("\"bool caustics\" false");
  for (std::size_t i = 0; i < with.pixels.size(); ++i) EXPECT_EQ(with.pixels[i], without.pixels[i]) << i;
}

/// Photons of a kind, and hidden ones, in a room with a spot over a pane over a glossy and a matte floor.
struct Stored {
  std::size_t photons = 0, hidden = 0;
};
Stored stored(unsigned kinds, const std::string& light, const std::string& pane) {
  TestScene test(R"(
Camera "perspective"
WorldBegin
LightSource "spot" "point3 from" [0 0 2] "point3 to" [0 0 0] )" +
                 light + R"(
Material "conductor" "bool remaproughness" false "float roughness" .1
Shape "disk" "float radius" .2
Material "diffuse"
Shape "disk" "float radius" 3 "float innerradius" .2
Shape "disk" "float radius" 3 "float height" 3
Material "thindielectric"
Shape "disk" "float radius" 3 "float height" 1 )" +
                 pane);
  const auto scene = test.scene({FileFrame(0)});
  PhotonSettings settings;
  settings.kinds = kinds, settings.hidden = true;
  Stored sum;
  for (const PhotonTrace& trace : trace_photons(*scene, settings, 0, 0, 4096, {}))
    sum.photons += trace.photons.size(), sum.hidden += trace.hidden.size();
  return sum;
}

// The spot shines through the pane only, so nothing is left, not even what matte surfaces would scatter.
TEST(PhotonControls, NoPhotonPassesThePane) {
  const std::string none = "\"bool caustics\" false";
  const Stored all = stored(kAllPhotons, "", ""), caustic = stored(kCausticPhotons, "", "");
  EXPECT_GT(all.photons, caustic.photons);
  EXPECT_GT(caustic.photons, 100u);
  EXPECT_GT(all.hidden, 100u);
  for (const auto& [light, pane] : {std::pair{none, std::string()}, {std::string(), none}}) {
    const Stored left = stored(kAllPhotons, light, pane);
    EXPECT_EQ(left.photons, 0u);
    EXPECT_EQ(left.hidden, 0u);
  }
}

TEST(PhotonControls, FramesStayWhatTheyAreAlone) {
  for (const char* integrator : {R"("dsppm" "integer photons" 5000)", R"("sppm" "integer photons" 5000)",
                                 R"("photonmap" "integer photons" 5000 "integer causticphotons" 5000)"}) {
    const std::string text =
        "Frames 3\n" + Floor{lamp(-0.3, "\"float photons\" 5 \"bool caustics\" false") + lamp(0.2) + mirror() + R"(
DynamicBegin "ball"
Keyframe 1 Translate 0 0 .2 Keyframe 3 Translate .3 0 .2 KeyframeEnd
Material "dielectric"
Shape "sphere" "float radius" .1
Translate 0 .5 0
Shape "sphere" "float radius" .1 "bool caustics" false
DynamicEnd)"}
                           .text(integrator);
    for (const Verdict& verdict : {check_threads(text, 2), check_resume(text, 2), check_joint(text, 2)})
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

}  // namespace photon_controls_test
}  // namespace dspm::test
