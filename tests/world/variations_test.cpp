// What variations make of parts, lights and looks; and what of the looks is held where variations are many.
#include "dspm/world/objects/variations.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "dspm/base/math/moments.h"
#include "dspm/image/png.h"
#include "dspm/lang/parse.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "dspm/world/world.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace variations_test {

using test::TestScene;

SceneDescription read(const std::string& text, const std::string& name = "scene.dsc") {
  Diagnostics diagnostics;
  SceneDescription scene = parse_text(name, text, {}, diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

std::string variation(const std::string& name, const std::string& contents) {
  return fmt::format("VariationBegin \"{}\" {} VariationEnd\n", name, contents);
}

std::string axis(const std::string& name, const std::string& variations) {
  return fmt::format("AxisBegin \"{}\"\n{}AxisEnd\n", name, variations);
}

/// One character a frame: x where the first block of that name is there.
std::string table(const SceneDescription& scene, const std::string& part) {
  for (std::size_t b = 0; b < scene.dynamic_blocks.size(); ++b) {
    if (scene.dynamic_blocks[b].name != part) continue;
    std::string row;
    for (const bool there : presence(scene, static_cast<int>(b))) row += there ? 'x' : '.';
    return row;
  }
  return "no such part";
}

constexpr const char* kParts = R"(
DynamicBegin "arms" DynamicEnd
DynamicBegin "wheels" DynamicEnd
DynamicBegin "seat" DynamicBegin "cushion" DynamicEnd DynamicEnd
)";

const std::string kAlternatives =
    axis("base", variation("wheels", "Show \"wheels\"") + variation("plain", "Hide \"arms\"") +
                     variation("both", "Show \"wheels\" Show \"arms\""));

TEST(Presence, APartThatOneVariationShowsIsHiddenInTheOthers) {
  const SceneDescription scene = read("WorldBegin" + std::string(kParts) + kAlternatives);
  EXPECT_EQ(table(scene, "wheels"), "x.x");
  EXPECT_EQ(table(scene, "arms"), "..x");
  EXPECT_EQ(table(scene, "seat"), "xxx");
}

TEST(Presence, AHiddenPartIsThereInTheOthers) {
  const SceneDescription scene =
      read("WorldBegin" + std::string(kParts) + variation("a", "Hide \"arms\"") + variation("b", "Show \"wheels\""));
  EXPECT_EQ(table(scene, "arms"), ".x");
}

TEST(Presence, EveryAxisMayHide) {
  const SceneDescription scene =
      read("WorldBegin" + std::string(kParts) + kAlternatives +
           axis("extra", variation("bare", "Hide \"wheels\"") + variation("rich", "Show \"arms\"")));
  EXPECT_EQ(table(scene, "wheels"), ".x...x");
  EXPECT_EQ(table(scene, "arms"), ".....x");
}

TEST(Presence, OfInnerBlocksEndsWithTheOuter) {
  const SceneDescription scene = read("WorldBegin" + std::string(kParts) + variation("a", "Hide \"seat\"") +
                                      variation("b", "Hide \"cushion\"") + variation("c", "Hide \"arms\""));
  EXPECT_EQ(table(scene, "seat"), ".xx");
  EXPECT_EQ(table(scene, "cushion"), "..x");
}

TEST(Presence, GoesWithTheMoments) {
  const SceneDescription scene =
      read("Frames 4 WorldBegin DynamicBegin \"late\" \"integer frames\" [3 4] DynamicEnd\n" +
           variation("a", "Show \"late\"") + variation("b", "Hide \"late\""));
  EXPECT_EQ(table(scene, "late"), "..xx....");
}

TEST(Presence, AHiddenBlockTakesItsLightsAlong) {
  TestScene test(test::box("", R"(DynamicBegin "lamp" LightSource "point" "rgb I" [1 1 1] DynamicEnd
DynamicBegin "panel" AreaLightSource "diffuse" Shape "sphere" "float radius" .1 DynamicEnd
)" + variation("a", R"(Hide "lamp")") +
                                   variation("b", R"(Hide "panel")")));
  const auto scene = test.scene({FileFrame(0), FileFrame(1)});
  ASSERT_EQ(scene->lights.size(), 3u);  // the point, the box's, the panel
  ASSERT_EQ(scene->lights[0].states.states.size(), 1u);
  EXPECT_EQ(scene->lights[0].states.states[0].frames, FrameSet::single(1));
  EXPECT_EQ(scene->lights[2].states.states[0].frames, FrameSet::single(0));
}

float scale(const SceneDescription& scene, int frame) {
  const LightUse& use = scene.lights.front();
  const ParamList params = light_params(scene, use, use.name, FileFrame(frame));
  const Param* const found = params.find("scale");
  return found ? numbers_of(*found).front() : 1;
}

TEST(LightScales, MultiplyAlongAxesAndWithTheLightsOwn) {
  const std::string light = "Frames 3 WorldBegin LightSource \"point\" \"string name\" \"key\" ";
  const std::string axes =
      axis("x", variation("a", R"(Light "key" "float scale" 2)") + variation("b", R"(Light "key" "integer scale" 3)")) +
      axis("y", variation("c", R"(Light "key" "float scale@1" 1 "float scale@3" 3)"));
  const SceneDescription plain = read(light + axes), own = read(light + "\"float scale\" 10\n" + axes);
  EXPECT_EQ(scale(plain, 0), 2);
  EXPECT_EQ(scale(plain, 1), 4);
  EXPECT_EQ(scale(own, 2), 60);
  EXPECT_EQ(scale(own, 5), 90);
}

const std::string kChangingBall = R"(
Texture "inner" "spectrum" "constant" "rgb value" [.1 .2 .3]
Texture "cloth" "spectrum" "scale" "texture tex" "inner" "float scale" .5
MakeNamedMaterial "ball" "string type" "diffuse" "texture reflectance" "cloth"
MakeNamedMaterial "other" "string type" "diffuse"
NamedMaterial "ball"
Shape "sphere" "float radius" .3
NamedMaterial "other"
Shape "sphere" "float radius" .2
)";

TEST(Looks, ChangeWithTheTexturesThatTheyAreMadeOf) {
  const std::string axes = axis("x", variation("a", R"(Texture "inner" "spectrum" "constant" "rgb value" [1 0 0])") +
                                         variation("b", R"(MakeNamedMaterial "other" "string type" "conductor")")) +
                           axis("y", variation("c", R"(MakeNamedMaterial "ball" "string type" "dielectric")") +
                                         variation("d", R"(MakeNamedMaterial "other" "string type" "diffuse")"));
  TestScene test(test::box("", kChangingBall + axes));
  const auto scene = test.scene(test.all_frames());  // a-c, a-d, b-c, b-d
  const auto states = [&](std::size_t material) {
    std::vector<std::uint64_t> bits;
    for (const auto& state : scene->materials[material].states) bits.push_back(state.frames.bits());
    return bits;
  };
  const auto named = scene->materials.size();
  std::set<std::vector<std::uint64_t>> all;
  for (std::size_t m = 0; m < named; ++m) all.insert(states(m));
  // The ball: dielectric in a-c and b-c, red in a-d, its own in b-d. The other: its own but in b-c, as d is the last.
  EXPECT_EQ(all.count({0b0101, 0b0010, 0b1000}), 1u);
  EXPECT_EQ(all.count({0b1011, 0b0100}), 1u);
}

// Without a variation, too: a parameter is keyed, or the place of a texture is.
TEST(Looks, ChangeWithTheMoment) {
  TestScene test(test::box("Frames 3\n", R"(
Material "diffuse" "rgb reflectance@1" [.2 .2 .2] "rgb reflectance@3" [.4 .4 .4]
Shape "sphere" "float radius" .3)"));
  const auto scene = test.scene(test.all_frames());
  std::size_t most = 0;
  for (const auto& material : scene->materials) most = std::max(most, material.states.size());
  EXPECT_EQ(most, 3u);
}

/// `count` fabrics of pictures, of which `scene` can be made.
class Fabrics {
 public:
  explicit Fabrics(int count) {
    write_png(directory_ / "base.png", Image(4, 4));
    std::string axes;
    for (int i = 0; i < count; ++i) {
      const std::string name = fmt::format("{}.png", i);
      write_png(directory_ / name, Image(4, 4));
      axes += variation(std::to_string(i),
                        fmt::format(R"(Texture "cloth" "spectrum" "imagemap" "string filename" "{}")", name));
    }
    text_ = test::box("", R"(
Texture "cloth" "spectrum" "imagemap" "string filename" "base.png"
MakeNamedMaterial "ball" "string type" "diffuse" "texture reflectance" "cloth"
NamedMaterial "ball"
Shape "sphere" "float radius" .3
)" + axis("fabric", axes));
  }
  std::unique_ptr<TestScene> load() const {
    return std::make_unique<TestScene>(text_, (directory_ / "chair.dsc").string());
  }
  const test::TemporaryDirectory& directory() const { return directory_; }

 private:
  test::TemporaryDirectory directory_;
  std::string text_;
};

std::vector<FileFrame> frames(int first, int count) {
  std::vector<FileFrame> list(static_cast<std::size_t>(count));
  std::iota(list.begin(), list.end(), FileFrame(first));
  return list;
}

/// The materials that differ between frames.
std::vector<std::weak_ptr<const Material>> changing(const Scene& scene) {
  std::vector<std::weak_ptr<const Material>> materials;
  for (const auto& material : scene.materials)
    if (material.states.size() > 1)
      for (const auto& state : material.states) materials.emplace_back(state.object);
  return materials;
}

std::ptrdiff_t alive(const std::vector<std::weak_ptr<const Material>>& materials) {
  return std::count_if(materials.begin(), materials.end(), [](const auto& each) { return !each.expired(); });
}

TEST(Looks, OfOtherIntervalsAreNotHeld) {
  const Fabrics fabrics(200);
  const auto test = fabrics.load();
  EXPECT_EQ(test->world().pictures_held(), 0);
  for (int first = 0; first < 200; first += 50) {
    const auto scene = test->scene(frames(first, 50));
    EXPECT_EQ(test->world().pictures_held(), 50);
    const auto materials = changing(*scene);
    EXPECT_EQ(alive(materials), 50);
  }
  EXPECT_EQ(test->world().pictures_held(), 0);
}

TEST(Looks, ThatFitIntoOneIntervalAreMadeOnce) {
  const Fabrics fabrics(20);
  const auto test = fabrics.load();
  EXPECT_EQ(test->world().pictures_held(), 20);
  const auto materials = changing(*test->scene(frames(0, 20)));
  EXPECT_EQ(alive(materials), 20);
}

TEST(Looks, ErrorsOfAllVariationsAreKnownBeforeAnythingIsRendered) {
  const Fabrics fabrics(100);
  test::put_file(fabrics.directory() / "77.png", "no picture");
  test::put_file(fabrics.directory() / "88.png", "no picture either");
  try {
    fabrics.load();
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("77.png"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("88.png"), std::string::npos) << error.what();
  }
}

TEST(Looks, OfAFileThatVanishesMeanwhileAreAnError) {
  const Fabrics fabrics(100);
  const auto test = fabrics.load();
  std::filesystem::remove(fabrics.directory() / "7.png");
  EXPECT_THROW(test->scene({FileFrame(7)}), SceneError);
  EXPECT_NO_THROW(test->scene({FileFrame(8)}));
}

}  // namespace variations_test
}  // namespace dspm
