// Light groups: one pass gives the light of each group. If every group has a primary colour of its own and nothing else
// is coloured, a group's light is that component of the image.
#include "dspm/integrators/light_groups.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace light_groups_test {

using test::TestScene;

const std::vector<std::string> kGroups = {"light_other", "light_fill", "light_key"};
constexpr int kIterations = 3;

/// The key light is red and brighter in frame 2, the fill light green, a point light and a sky are blue. A glass ball
/// moves between the key light and the ground, a rough mirror stands behind, and the ground is darker in frame 3.
std::string scene(const std::string& integrator) {
  return fmt::format(R"(
Frames 3
Integrator {}
LookAt 0 2 -5  0 .5 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin
LightSource "infinite" "rgb L" [0 0 .1]
LightSource "point" "rgb I" [0 0 9] "point3 from" [2 2 -1]
LightSource "spot" "string group" "key" "rgb I@1" [40 0 0] "rgb I@3" [90 0 0] "point3 from" [-2 4 -1] "point3 to" [0 0 0]
AttributeBegin
  AreaLightSource "diffuse" "string group" "fill" "rgb L" [0 12 0]
  Translate 1.5 2 0
  Shape "sphere" "float radius" .3
AttributeEnd
AttributeBegin
  Material "diffuse" "rgb reflectance@1" [.6 .6 .6] "rgb reflectance@2" [.6 .6 .6] "rgb reflectance@3" [.3 .3 .3]
  Rotate 90 1 0 0
  Shape "disk" "float radius" 9
AttributeEnd
AttributeBegin
  Material "conductor" "rgb reflectance" [.8 .8 .8] "float roughness" .02
  Translate 0 0 2
  Shape "disk" "float radius" 1.2
AttributeEnd
DynamicBegin "ball"
  Keyframe 1 Translate -.8 .7 0 Keyframe 3 Translate .2 .7 0 KeyframeEnd
  Material "dielectric"
  Shape "sphere" "float radius" .5
DynamicEnd
)",
                     integrator);
}

Choices asking_for(std::vector<std::string> outputs) {
  Choices choices;
  choices.outputs = std::move(outputs);
  return choices;
}

std::unique_ptr<Integrator> rendered(TestScene& test, const Scene& scene, std::size_t memory = 0) {
  auto integrator = test.integrator(scene, {}, memory);
  for (int i = 0; i < kIterations; ++i) integrator->iterate({i, scene});
  return integrator;
}

/// By frame, all groups one after the other.
std::vector<Image> groups_of(const Integrator& integrator, const Scene& scene) {
  std::vector<Image> images;
  for (Frame f = 0; f < scene.frame_count(); ++f)
    for (const std::string& output : kGroups) images.push_back(integrator.estimate(f, output));
  return images;
}

void expect_near(const Rgb& value, const Rgb& expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], 2e-5f * std::max(1.f, max_component(expected)));
}

class LightGroupsOf : public testing::TestWithParam<const char*> {
 protected:
  std::string text() const { return scene(GetParam()); }
};

// What a medium gives off, seen directly and brought by photons, is of the lights without a group.
TEST(LightGroups, HaveTheLightOfMediaThatGlow) {
  for (const char* integrator : {R"("path")", R"("dsppm" "integer photons" 4000)", R"("sppm" "integer photons" 4000)",
                                 R"("vcm")", R"("photonmap" "integer photons" 20000 "integer causticphotons" 20000)"}) {
    TestScene test(fmt::format(R"(
Integrator {}
LookAt 0 1 -5  0 1 0  0 1 0
Camera "perspective" "float fov" 50
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin
LightSource "point" "string group" "key" "rgb I" [9 0 0] "point3 from" [2 3 -1]
MakeNamedMedium "flame" "string type" "homogeneous" "rgb sigma_a" [1 1 1] "rgb sigma_s" [.5 .5 .5] "rgb Le" [0 0 4]
AttributeBegin Rotate -90 1 0 0 Shape "disk" "float radius" 6 AttributeEnd
AttributeBegin MediumInterface "flame" "" Material "interface" Translate 0 1 0 Shape "sphere" "float radius" .8 AttributeEnd
)",
                               integrator),
                   asking_for({"lights"}));
    const auto scene = test.scene(test.all_frames());
    const auto made = rendered(test, *scene);
    const Image image = made->estimate(0), other = made->estimate(0, "light_other"),
                key = made->estimate(0, "light_key");
    Rgb total;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      expect_near(key.pixels[i], {image.pixels[i].r, 0, 0});
      expect_near(other.pixels[i], {0, 0, image.pixels[i].b});
      total += image.pixels[i];
    }
    EXPECT_GT(total.r, 1) << integrator;
    EXPECT_GT(total.b, 1) << integrator;
  }
}

TEST_P(LightGroupsOf, AreTheLightOfTheirLights) {
  TestScene test(text(), asking_for({"lights"}));
  EXPECT_EQ(test.job().settings.outputs, kGroups);
  Rgb total;
  for (const auto& frames : test.intervals()) {
    const auto scene = test.scene(frames);
    const auto integrator = rendered(test, *scene);
    for (Frame f = 0; f < scene->frame_count(); ++f) {
      const Image image = integrator->estimate(f), other = integrator->estimate(f, "light_other"),
                  fill = integrator->estimate(f, "light_fill"), key = integrator->estimate(f, "light_key");
      for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        SCOPED_TRACE(fmt::format("pixel {}, frame {}", i, f));
        const Rgb& all = image.pixels[i];
        expect_near(key.pixels[i], {all.r, 0, 0});
        expect_near(fill.pixels[i], {0, all.g, 0});
        expect_near(other.pixels[i], {0, 0, all.b});
        total += all;
      }
    }
  }
  for (int c = 0; c < 3; ++c) EXPECT_GT(total[c], 1) << "all of them shine";
}

TEST_P(LightGroupsOf, LeaveTheImageAsItIs) {
  TestScene with(text(), asking_for({"lights"})), without(text());
  EXPECT_EQ(with.render_all(kIterations), without.render_all(kIterations));
}

TEST_P(LightGroupsOf, OfAllFramesAreThoseOfEachAlone) {
  TestScene test(text(), asking_for({"lights"}));
  if (test.intervals().size() > 1) GTEST_SKIP() << "each is alone";
  const auto together = test.scene(test.all_frames());
  const std::vector<Image> images = groups_of(*rendered(test, *together), *together);
  for (const FileFrame f : test.all_frames()) {
    const auto alone = test.scene({f});
    const std::vector<Image> own = groups_of(*rendered(test, *alone), *alone);
    for (std::size_t g = 0; g < kGroups.size(); ++g)
      for (std::size_t i = 0; i < own[g].pixels.size(); ++i)
        expect_near(images[f.slot() * kGroups.size() + g].pixels[i], own[g].pixels[i]);
  }
}

TEST_P(LightGroupsOf, HaveTheSameBitsWithAnyNumberOfThreads) {
  TestScene test(text(), asking_for({"lights"}));
  const auto scene = test.scene(test.intervals().front());
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return groups_of(*rendered(test, *scene), *scene);
  };
  EXPECT_EQ(with(1), with(5));
}

TEST_P(LightGroupsOf, GoOnFromTheirState) {
  TestScene test(text(), asking_for({"lights"}));
  const auto scene = test.scene(test.intervals().front());
  const auto calm = rendered(test, *scene), first = test.integrator(*scene), second = test.integrator(*scene);
  first->iterate({0, *scene});
  const std::string saved = state_of(*first);
  LoadedState state(saved);
  ASSERT_TRUE(second->persist(state));
  for (int i = 1; i < kIterations; ++i) second->iterate({i, *scene});
  EXPECT_EQ(groups_of(*second, *scene), groups_of(*calm, *scene));
}

TEST_P(LightGroupsOf, CountAsMemory) {
  TestScene with(text(), asking_for({"lights"})), without(text());
  const auto least = [](TestScene& test) {
    const auto scene = test.scene(test.intervals().front());
    try {
      test.integrator(*scene, {}, 1);
    } catch (const NotEnoughMemory& error) {
      EXPECT_NO_THROW(test.integrator(*scene, {}, error.least.total()));
      return error.least.pixels;
    }
    return std::size_t{0};
  };
  const std::size_t image = sizeof(Rgb) * 16 * 12 * with.intervals().front().size();
  EXPECT_GE(least(with) - least(without), kGroups.size() * image);
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, LightGroupsOf,
    testing::Values(
        R"("path" "integer maxdepth" 6)", R"("vcm" "integer photons" 800 "string emission" "power")",
        R"("vcm" "integer photons" 800 "bool connect" false "string emission" "power")",
        R"("dsppm" "integer photons" 3000 "string emission" "power")", R"("dsppm" "integer photons" 3000)",
        R"("dsppm" "integer photons" 3000 "string emission" "power" "string direct" "sampled")",
        R"("dsppm" "integer photons" 3000 "string emission" "power" "string direct" "photons")",
        R"("dsppm" "integer photons" 3000 "string emission" "power" "string indirect" "paths")",
        R"("dsppm" "integer photons" 3000 "string emission" "power" "string estimator" "hj09")",
        R"("sppm" "integer photons" 3000 "string emission" "power")",
        R"("sppm" "integer photons" 3000 "string emission" "power" "string estimator" "hj09" "string direct" "photons")",
        R"("photonmap" "integer photons" 500 "integer causticphotons" 500 "integer nearest" 5 "float radius" 1
           "float causticradius" 1)",
        R"("photonmap" "integer photons" 500 "integer causticphotons" 500 "string emission" "power"
           "integer finalgather" 2)"));

class LightGroupsInBatches : public testing::TestWithParam<const char*> {};

TEST_P(LightGroupsInBatches, AreTheSame) {
  TestScene test(
      scene(fmt::format(
          R"("dsppm" "string indirect" "photons" "integer photons" 20000 "string emission" "power" "string estimator" "{}")",
          GetParam())),
      asking_for({"lights"}));
  const auto scene = test.scene(test.all_frames());
  std::size_t least = 0;
  try {
    test.integrator(*scene, {}, 1);
  } catch (const NotEnoughMemory& error) {
    least = error.least.total();
  }
  const auto whole = rendered(test, *scene), batches = rendered(test, *scene, least);
  EXPECT_GT(batches->statistics().photon_batches, 1);
  EXPECT_LE(batches->statistics().bytes, least);
  const std::vector<Image> one = groups_of(*whole, *scene), other = groups_of(*batches, *scene);
  for (std::size_t g = 0; g < one.size(); ++g)
    for (std::size_t i = 0; i < one[g].pixels.size(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(one[g].pixels[i][c], other[g].pixels[i][c], 1e-4f * std::max(1.f, one[g].pixels[i][c]));
}

INSTANTIATE_TEST_SUITE_P(Estimators, LightGroupsInBatches, testing::Values("kz11", "hj09"));

class PixelSinks : public testing::TestWithParam<const char*> {};

// The image, groups and counts are sinks of one loop: each is the same whoever else listens.
TEST_P(PixelSinks, ChangeNothingForOneAnother) {
  const std::string text = scene(
      fmt::format(R"("dsppm" "integer photons" 3000 "string emission" "power" "string estimator" "{}")", GetParam()));
  TestScene all(text, asking_for({"lights", "radius", "photons"}));
  const auto scene = all.scene(all.all_frames());
  const auto together = rendered(all, *scene);
  for (const std::string output : {"radiance", "light_key", "radius", "photons"}) {
    TestScene one(text, output == kRadiance ? Choices() : asking_for({output}));
    const auto alone = rendered(one, *scene);
    for (Frame f = 0; f < scene->frame_count(); ++f)
      EXPECT_EQ(together->estimate(f, output), alone->estimate(f, output)) << output << ", frame " << f;
  }
}

INSTANTIATE_TEST_SUITE_P(Estimators, PixelSinks, testing::Values("kz11", "hj09"));

std::string error_of(const std::string& text, const std::string& output) {
  try {
    TestScene test(text, asking_for({output}));
    const auto made = test.scene(test.intervals().front());
    test.integrator(*made);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(LightGroups, ThatCannotBeGivenAreErrors) {
  const std::string occlusion = error_of(scene(R"("ambientocclusion")"), "light_key");
  EXPECT_NE(occlusion.find("integrator \"ambientocclusion\" has no output \"light_key\""), occlusion.npos) << occlusion;
  const std::string unknown = error_of(scene(R"("path")"), "light_kye");
  EXPECT_NE(unknown.find("did you mean \"light_key\"?"), unknown.npos) << unknown;
  std::string text = scene(R"("path")");
  text.replace(text.find("\"fill\""), 6, "\"a.b\"");
  const std::string dot = error_of(text, "lights");
  EXPECT_NE(dot.find("letters, digits, - and _"), dot.npos) << dot;
  text = scene(R"("path")");
  text.replace(text.find("\"string group\" \"key\""), 20, "\"string group@2\" \"key\"");
  const std::string keyed = error_of(text, "lights");
  EXPECT_NE(keyed.find("must be the same in all frames"), keyed.npos) << keyed;
}

}  // namespace light_groups_test
}  // namespace dspm
