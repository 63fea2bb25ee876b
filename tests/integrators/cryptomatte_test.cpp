// Cryptomattes and alpha: shares of a pixel's camera paths, which are the same for every integrator.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/beside/coverage_ranks.h"
#include "dspm/integrators/beside/surface_outputs.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace cryptomatte_test {

using test::TestScene;

constexpr int kSize = 12, kIterations = 16;

/// Balls of several sizes before a wall that fills two thirds of the picture; the first ball moves.
std::string scene(const std::string& more = "", const std::string& integrator = R"("path" "integer maxdepth" 0)",
                  const std::string& film = "") {
  std::string balls;
  for (int i = 0; i < 6; ++i)
    balls += fmt::format(R"(
AttributeBegin
Material "diffuse"
{}
Translate {} {} {}
Shape "sphere" "float radius" {} "string name" "ball-{}"
AttributeEnd
)",
                         more == fmt::format("ball-{}", i) ? R"(AreaLightSource "diffuse" "rgb L" [1 1 1])" : "",
                         0.55 * (i % 3) - 0.6, 0.7 * (i / 3) - 0.3, 2 + 0.3 * i, 0.12 + 0.06 * i, i);
  return fmt::format(R"(
Frames 2
Integrator {}
Camera "orthographic"
Film "rgb" "integer xresolution" {} "integer yresolution" {} {}
WorldBegin
{}
DynamicBegin "block" Keyframe 1 Translate 0 0 0 Keyframe 2 Translate .15 0 0 KeyframeEnd
{}
DynamicEnd
Shape "trianglemesh" "point3 P" [-9 -9 5  .4 -9 5  .4 9 5  -9 9 5] "integer indices" [0 1 2 0 2 3] "string name" "wall"
)",
                     integrator, kSize, kSize, film, R"(LightSource "infinite" "rgb L" [.2 .3 .4])", balls);
}

Choices asking_for(std::vector<std::string> outputs) {
  Choices choices;
  choices.outputs = std::move(outputs);
  return choices;
}

/// By output; the radiance as "".
std::map<std::string, Image> outputs_of(TestScene& test, Frame frame, const std::vector<std::string>& also = {""}) {
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  for (int i = 0; i < kIterations; ++i) integrator->iterate({i, *scene});
  std::map<std::string, Image> images;
  for (const std::string& output : test.job().settings.outputs) images[output] = integrator->estimate(frame, output);
  for (const std::string& output : also) images[output] = integrator->estimate(frame);
  return images;
}

/// The specification's way: the sum of the shares of all ranks that hold the name's id.
float matte(const std::map<std::string, Image>& images, const std::string& name, int x, int y) {
  float sum = 0;
  for (const std::string& rank : parts_of_output("cryptoobject"))
    if (const Rgb& pair = images.at(rank).at(x, y); pair.r == id_of(name)) sum += pair.g;
  return sum;
}

TEST(Cryptomatte, RanksDescendAndAddUpToAlpha) {
  TestScene test(scene(), asking_for({"cryptoobject", "alpha"}));
  EXPECT_EQ(test.job().settings.outputs.size(), CoverageRanks::kRanks + 1);
  const auto images = outputs_of(test, 1);
  int edges = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      float before = 1, sum = 0;
      for (const std::string& rank : parts_of_output("cryptoobject")) {
        const Rgb& pair = images.at(rank).at(x, y);
        EXPECT_LE(pair.g, before);
        EXPECT_EQ(pair.g == 0, pair.r == 0) << "no share without an id";
        before = pair.g, sum += pair.g;
      }
      EXPECT_NEAR(sum, images.at("alpha").at(x, y).r, 1e-6f);
      EXPECT_LE(sum, 1);
      edges += images.at("cryptoobject.1").at(x, y).g > 0;
    }
  EXPECT_GT(edges, kSize);
}

// An object alone that shines with radiance 1, seen directly: the image is its matte.
TEST(Cryptomatte, MattesAreRendersOfTheObjectAlone) {
  TestScene test(scene(), asking_for({"cryptoobject"}));
  const auto images = outputs_of(test, 1);
  for (const char* name : {"ball-0", "ball-3", "ball-5"}) {
    std::string text = scene(name);
    text.replace(text.find("[.2 .3 .4]"), 10, "[0 0 0]");
    TestScene shining(text);
    const Image alone = outputs_of(shining, 1).at("");
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) EXPECT_NEAR(matte(images, name, x, y), alone.at(x, y).g, 1e-6f) << name;
  }
}

TEST(Cryptomatte, OfMaterialsJoinsObjects) {
  TestScene test(scene(), asking_for({"cryptomaterial", "alpha"}));
  const auto images = outputs_of(test, 0);
  std::map<float, int> ids;
  for (const std::string& rank : parts_of_output("cryptomaterial"))
    for (const Rgb& pair : images.at(rank).pixels)
      if (pair.r != 0) ++ids[pair.r];
  EXPECT_GT(ids.size(), 1U);
  for (const auto& [id, count] : ids) EXPECT_GT(count, 0);
}

TEST(Cryptomatte, GoesOnFromItsState) {
  TestScene test(scene(), asking_for({"cryptoobject", "alpha"}));
  const auto made = test.scene(test.all_frames());
  const auto calm = test.integrator(*made), first = test.integrator(*made), second = test.integrator(*made);
  for (int i = 0; i < 6; ++i) calm->iterate({i, *made});
  for (int i = 0; i < 3; ++i) first->iterate({i, *made});
  const std::string saved = state_of(*first);
  LoadedState state(saved);
  ASSERT_TRUE(second->persist(state));
  for (int i = 3; i < 6; ++i) second->iterate({i, *made});
  for (const std::string& output : test.job().settings.outputs)
    EXPECT_EQ(second->estimate(1, output), calm->estimate(1, output)) << output;
}

TEST(CoverageRanks, KeepTheLargest) {
  CoverageRanks ranks;
  std::map<int, std::uint32_t> counts;
  // Thing 0 comes in half of the paths, 1 in a quarter, and so on; 32 others once each.
  for (int i = 1; i <= 1024; ++i) {
    int thing = 0;
    while (thing < 5 && (i >> thing) % 2 == 0) ++thing;
    if (thing == 5) thing = 100 + i;
    ranks.add(thing), ++counts[thing];
  }
  const auto sorted = ranks.sorted();
  std::uint32_t sum = 0;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(sorted[static_cast<std::size_t>(i)].thing, i);
  EXPECT_EQ(sorted[0].paths, counts[0]);
  for (const CoverageRanks::Share& share : sorted) {
    EXPECT_LE(share.paths, counts[share.thing]);
    sum += share.paths;
  }
  EXPECT_LE(sum, 1024U);
}

constexpr const char* kIntegrators[] = {R"("path")", R"("vcm" "integer photons" 200 "string emission" "power")",
                                        R"("dsppm" "integer photons" 200 "string emission" "power")",
                                        R"("photonmap" "integer photons" 200 "integer causticphotons" 20)"};

// What is transparent lacks the sky where nothing is, and only there: over that sky again, the image is the usual one.
TEST(Transparent, OverItsBackgroundIsTheUsualImage) {
  for (const char* integrator : kIntegrators) {
    SCOPED_TRACE(integrator);
    TestScene usual(scene("", integrator)), clear(scene("", integrator, R"("bool transparent" true)"));
    EXPECT_EQ(clear.job().settings.outputs, std::vector<std::string>{"alpha"});
    const Image with = outputs_of(usual, 0).at("");
    const auto images = outputs_of(clear, 0);
    const Rgb sky(.2f, .3f, .4f);
    int partly = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) {
      const float alpha = images.at("alpha").pixels[i].r;
      // At an edge, vcm may send light to a pixel whose few camera paths have all passed the thing.
      if (alpha == 0) {
        EXPECT_LT(max_component(images.at("").pixels[i]), std::string(integrator).find("vcm") == 1 ? 1e-2f : 1e-9f);
      }
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(images.at("").pixels[i][c] + (1 - alpha) * sky[c], with.pixels[i][c], 1e-5f);
      partly += alpha > 0 && alpha < 1;
    }
    EXPECT_GT(partly, 5);
  }
}

}  // namespace cryptomatte_test
}  // namespace dspm
