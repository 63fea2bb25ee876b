// Photons are traced for what they are worth: none where camera paths find all light with less noise, a few for caustics.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/session/job/choices.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace light_ways_test {

constexpr const char* kSky = R"(LightSource "infinite" "rgb L" [.4 .5 .6])";
constexpr const char* kLamp = R"(
AttributeBegin
  Translate 1 3 1 Rotate 90 1 0 0 AreaLightSource "diffuse" "rgb L" [6 5 4] "bool twosided" true Shape "disk" "float radius" 1
AttributeEnd
)";
constexpr const char* kPoint = R"(LightSource "point" "rgb I" [9 9 9] "point3 from" [1 3 1])";
constexpr const char* kGlassBall = R"(
AttributeBegin Translate 1 .5 .2 Material "dielectric" "float eta" 1.5 Shape "sphere" "float radius" .5 AttributeEnd
)";

/// A wide ground with plastic and metal on it, one of which moves and changes its colour.
std::string open_ground(const std::string& integrator, const std::string& things) {
  return fmt::format(R"(Frames 2
Integrator {}
LookAt 0 1 4  0 .6 0  0 1 0
Camera "perspective" "float fov" 50
PixelFilter "box"
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
Material "diffuse" "rgb reflectance" [.7 .6 .5]
AttributeBegin Rotate 90 1 0 0 Shape "disk" "float radius" 20 AttributeEnd
AttributeBegin
  Translate -1.1 .5 .2 Material "conductor" "float roughness" .3 "bool remaproughness" false Shape "sphere" "float radius" .5
AttributeEnd
DynamicBegin "ball"
  Keyframe 1 Translate -.1 .5 .3 Keyframe 2 Translate .2 .6 .3 KeyframeEnd
  Material "coateddiffuse" "rgb reflectance@1" [.2 .6 .3] "rgb reflectance@2" [.6 .2 .3] "float roughness" .1
  Shape "sphere" "float radius" .45
DynamicEnd
{}
)",
                     integrator, things);
}

/// The work of the first iteration.
Statistics first_iteration(const std::string& text) {
  TestScene test(text);
  const auto scene = test.scene(test.all_frames());
  const auto made = test.integrator(*scene);
  made->iterate({0, *scene});
  return made->statistics();
}
EmissionReport report(const std::string& text) { return *first_iteration(text).emission.begin(); }

constexpr const char* kChooses = R"("dsppm" "integer maxdepth" 12)";

TEST(LightWays, NoPhotonsWhereCameraPathsFindAllLight) {
  const std::string text = open_ground(kChooses, std::string(kSky) + kLamp);
  const Statistics of = first_iteration(text);
  EXPECT_EQ(of.photon.paths, 0u);
  EXPECT_EQ(of.gathers.done, 0u);
  EXPECT_EQ(report(text).bring, PhotonsBring::nothing);
  const Verdict verdict =
      agreement(rendered(text, 64, 16, 2),
                rendered(open_ground(R"("path" "integer maxdepth" 12)", std::string(kSky) + kLamp), 64, 16, 2));
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

TEST(LightWays, WithoutPhotonsThePromisesHold) {
  const std::string text = open_ground(kChooses, std::string(kSky) + kLamp);
  for (const Verdict& verdict :
       {check_threads(text, 2), check_resume(text, 3), check_joint(text, 2), check_crop(text, 2)})
    EXPECT_TRUE(verdict.passed) << verdict.message;
}

// No ray finds what a point light sends through glass; nothing but the glass differs from a scene without photons.
TEST(LightWays, PhotonsBringWhatNoCameraPathFinds) {
  const std::string things = std::string(kSky) + kPoint;
  EXPECT_EQ(first_iteration(open_ground(R"("dsppm" "float gatheralpha" .05)", things)).photon.paths, 0u);
  const std::string text = open_ground(R"("dsppm" "float gatheralpha" .05)", things + kGlassBall);
  EXPECT_NE(report(text).bring, PhotonsBring::nothing);
  EXPECT_GT(first_iteration(text).photons_stored.done, 0u);
}

TEST(LightWays, FewPhotonsForCausticsKeepThePromises) {
  const std::string text = open_ground(R"("dsppm" "integer maxdepth" 12)", std::string(kSky) + kPoint + kGlassBall);
  EXPECT_EQ(report(text).bring, PhotonsBring::caustics);
  EXPECT_LT(report(text).traced, 300'000);
  for (const Verdict& verdict :
       {check_threads(text, 2), check_resume(text, 3), check_joint(text, 2), check_crop(text, 2)})
    EXPECT_TRUE(verdict.passed) << verdict.message;
}

/// Few photons bring as much light as many do.
TEST(LightWays, FewPhotonsBringAllOfTheCaustic) {
  const std::string things = std::string(kSky) + kPoint + kGlassBall;
  const std::string settings = R"("dsppm" "integer photons" 40000 "integer maxdepth" 12 "float radius" .04)";
  ASSERT_LT(report(open_ground(settings, things)).traced, 20000);
  const Tiles few = rendered(open_ground(settings, things), 16, 16, 2);
  const Tiles all = rendered(open_ground(settings + R"( "string indirect" "photons")", things), 8, 16, 2);
  const Verdict verdict = agreement(few, all, {0.01, 0.01});
  EXPECT_TRUE(verdict.passed) << verdict.message;
}

// Camera paths would show them.
TEST(LightWays, CausticsThatTheSceneSwitchesOffStayOff) {
  const std::string dark = R"(Attribute "light" "bool caustics" false )";
  const std::string text = open_ground(kChooses, dark + kSky + kLamp + kGlassBall);
  EXPECT_NE(report(text).bring, PhotonsBring::nothing);
}

// The smaller and brighter a lamp, the more a camera path sees at once of what glass throws, and the more seldom.
TEST(LightWays, ASmallLampsCausticsAreLeftToPhotons) {
  const auto lamp = [](double radius, double radiance) {
    return fmt::format(
        "AttributeBegin Translate 1 3 1 Rotate 90 1 0 0 AreaLightSource \"diffuse\" \"rgb L\" [{1} {1} {1}] "
        "\"bool twosided\" true Shape \"disk\" \"float radius\" {0} AttributeEnd\n",
        radius, radiance);
  };
  EXPECT_EQ(report(open_ground(kChooses, kSky + lamp(1, 6) + kGlassBall)).bring, PhotonsBring::nothing);
  EXPECT_NE(report(open_ground(kChooses, kSky + lamp(.01, 60'000) + kGlassBall)).bring, PhotonsBring::nothing);
}

TEST(LightWays, ExplicitWordsAreKept) {
  const std::string things = std::string(kSky) + kLamp;
  for (const char* words : {R"("string indirect" "photons")", R"("string indirect" "paths")",
                            R"("string direct" "photons")", R"("string estimator" "hj09")"})
    EXPECT_EQ(
        first_iteration(open_ground(fmt::format(R"("dsppm" "integer photons" 5000 {})", words), things)).photon.paths,
        5000u)
        << words;
  EXPECT_GT(first_iteration(open_ground(R"("sppm")", things)).photon.paths, 0u);
}

}  // namespace light_ways_test
}  // namespace dspm::test
