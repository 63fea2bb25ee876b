// Outputs of what the camera sees first, for every integrator and all frames at once, against analytic values.
#include "dspm/integrators/beside/surface_outputs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/image/image.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace surface_outputs_test {

using test::TestScene;

constexpr int kSize = 16;

Choices asking_for(std::vector<std::string> outputs) {
  Choices choices;
  choices.outputs = std::move(outputs);
  return choices;
}

const std::vector<std::string> kAll = {"N",
                                       "P",
                                       "Z",
                                       "albedo",
                                       "uv",
                                       "object",
                                       "material",
                                       "denoisingN",
                                       "denoisingZ",
                                       "denoisingalbedo",
                                       "motion.forward",
                                       "motion.backward"};

/// By output, then by frame, after that many iterations.
std::map<std::string, std::vector<Image>> outputs_of(TestScene& test, int iterations = 4) {
  std::map<std::string, std::vector<Image>> images;
  for (const auto& frames : test.intervals()) {
    const auto scene = test.scene(frames);
    const auto integrator = test.integrator(*scene);
    for (int i = 0; i < iterations; ++i) integrator->iterate({i, *scene});
    for (const std::string& output : test.job().settings.outputs)
      for (Frame f = 0; f < scene->frame_count(); ++f) images[output].push_back(integrator->estimate(f, output));
  }
  return images;
}

/// The camera looks along +x from (-3, 1, 0), up is +z. In frame 2 the ball is behind it.
std::string scene(const std::string& integrator, const std::string& film) {
  return fmt::format(R"(
Frames 2
Option "disablepixeljitter" true
Integrator {}
LookAt -3 1 0  0 1 0  0 0 1
Camera "orthographic"
Film {} "integer xresolution" {} "integer yresolution" {}
WorldBegin
LightSource "point" "point3 from" [-3 1 0]
AttributeBegin
  Translate 2 0 0
  Rotate 90 0 1 0
  Material "diffuse" "rgb reflectance" [.2 .4 .6]
  Shape "disk" "float radius" 50 "string name" "wall"
AttributeEnd
DynamicBegin "ball"
  Keyframe 1 Translate 0 0 0 Keyframe 2 Translate -100 0 0 KeyframeEnd
  MakeNamedMaterial "gold" "string type" "conductor" "rgb reflectance" [.9 .7 .3]
  NamedMaterial "gold"
  Translate 0 1 0
  Shape "sphere" "float radius" 0.5
DynamicEnd
)",
                     integrator, film, kSize, kSize);
}

class SurfaceOutputs : public testing::TestWithParam<const char*> {
 protected:
  std::string text(const std::string& film = R"("rgb")") const { return scene(GetParam(), film); }
};

void expect_near(const Rgb& value, const Rgb& expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], tolerance) << "component " << c;
}

/// Where the middle of a pixel looks: the screen is 2 wide and 2 high.
double across(int pixel) { return (pixel + 0.5) / kSize * 2 - 1; }

TEST_P(SurfaceOutputs, HaveTheAnalyticValues) {
  TestScene test(text(), asking_for(kAll));
  const auto images = outputs_of(test);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      SCOPED_TRACE(fmt::format("pixel {}, {}", x, y));
      const double up = -across(y), side = across(x);  // in camera space
      const double distance2 = up * up + side * side;
      const auto expect = [&](const char* output, Frame frame, double r, double g, double b) {
        const Rgb& value = images.at(output)[static_cast<std::size_t>(frame)].at(x, y);
        SCOPED_TRACE(fmt::format("{}, frame {}", output, frame));
        expect_near(value, Rgb(static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)), 1e-4f);
      };
      const auto expect_wall = [&](Frame frame) {
        const Rgb& p = images.at("P")[static_cast<std::size_t>(frame)].at(x, y);
        EXPECT_NEAR(std::abs(p.g - 1), std::abs(side), 1e-4);
        expect("P", frame, 2, p.g, up);
        expect("N", frame, -1, 0, 0);
        expect("Z", frame, 5, 5, 5);
        expect("albedo", frame, .2, .4, .6);
        EXPECT_EQ(images.at("object")[static_cast<std::size_t>(frame)].at(x, y).r, id_of("wall"));
        EXPECT_EQ(images.at("material")[static_cast<std::size_t>(frame)].at(x, y).r, id_of("diffuse"));
      };
      expect_wall(1);
      if (distance2 > 0.25) {
        expect_wall(0);
        continue;
      }
      const double depth = std::sqrt(0.25 - distance2);  // of the ball's surface before its middle
      const Rgb& p = images.at("P")[0].at(x, y);
      expect("P", 0, -depth, p.g, up);
      expect("N", 0, -2 * depth, 2 * (p.g - 1), 2 * up);
      expect("Z", 0, 3 - depth, 3 - depth, 3 - depth);
      EXPECT_EQ(images.at("object")[0].at(x, y).r, id_of("ball"));
      EXPECT_EQ(images.at("material")[0].at(x, y).r, id_of("gold"));
      if (depth < 0.45) continue;  // towards the rim, metal is brighter
      expect_near(images.at("albedo")[0].at(x, y), Rgb(.9f, .7f, .3f), 0.05f);
    }
}

TEST_P(SurfaceOutputs, LeaveRadianceAsItIs) {
  TestScene with(text(), asking_for(kAll)), without(text());
  EXPECT_EQ(with.render_all(3), without.render_all(3));
}

TEST_P(SurfaceOutputs, OfAllFramesAreThoseOfEachAlone) {
  TestScene test(text(), asking_for(kAll));
  const auto together = outputs_of(test);
  for (const FileFrame f : test.all_frames()) {
    const auto alone = test.scene({f});
    const auto integrator = test.integrator(*alone);
    for (int i = 0; i < 4; ++i) integrator->iterate({i, *alone});
    for (const std::string& output : kAll)
      EXPECT_EQ(together.at(output)[f.slot()], integrator->estimate(0, output)) << output;
  }
}

TEST_P(SurfaceOutputs, HaveTheSameBitsWithAnyNumberOfThreads) {
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    TestScene test(text(), asking_for(kAll));
    return outputs_of(test);
  };
  EXPECT_EQ(with(1), with(5));
}

TEST_P(SurfaceOutputs, OfACropAreThoseOfTheWhole) {
  constexpr int kX = 3, kY = 5;
  Choices choices = asking_for(kAll);
  TestScene whole(text(), choices);
  choices.pixel_bounds = {kX, kSize - 2, kY, kSize - 1};
  TestScene part(text(), choices);
  const auto all = outputs_of(whole), crops = outputs_of(part);
  for (const std::string& output : kAll)
    for (std::size_t f = 0; f < crops.at(output).size(); ++f) {
      const Image& crop = crops.at(output)[f];
      ASSERT_EQ(crop.width, kSize - 2 - kX);
      for (int y = 0; y < crop.height; ++y)
        for (int x = 0; x < crop.width; ++x)
          EXPECT_EQ(crop.at(x, y), all.at(output)[f].at(x + kX, y + kY)) << output << ", " << x << ", " << y;
    }
}

TEST_P(SurfaceOutputs, GoOnFromTheirState) {
  TestScene test(text(), asking_for(kAll));
  const auto scene = test.scene(test.intervals().front());
  const auto calm = test.integrator(*scene), first = test.integrator(*scene), second = test.integrator(*scene);
  for (int i = 0; i < 4; ++i) calm->iterate({i, *scene});
  for (int i = 0; i < 2; ++i) first->iterate({i, *scene});
  const std::string saved = state_of(*first);
  LoadedState state(saved);
  ASSERT_TRUE(second->persist(state));
  for (const std::string& output : kAll) EXPECT_EQ(second->estimate(0, output), first->estimate(0, output)) << output;
  for (int i = 2; i < 4; ++i) second->iterate({i, *scene});
  for (const std::string& output : kAll) EXPECT_EQ(second->estimate(0, output), calm->estimate(0, output)) << output;
}

TEST_P(SurfaceOutputs, OfAGbufferFilmAreInTheSpaceThatItSays) {
  TestScene world(text(R"("gbuffer" "string coordinatesystem" "world")")), asked(text(), asking_for(gbuffer_outputs()));
  EXPECT_EQ(outputs_of(world), outputs_of(asked));
  TestScene camera(text(R"("gbuffer")"));
  const auto images = outputs_of(camera);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Rgb &p = images.at("P")[1].at(x, y), &n = images.at("N")[1].at(x, y);
      EXPECT_NEAR(p.r, across(x), 1e-4);
      EXPECT_NEAR(p.g, -across(y), 1e-4);
      EXPECT_NEAR(p.b, 5, 1e-4);
      EXPECT_NEAR(n.b, -1, 1e-6);
    }
}

TEST_P(SurfaceOutputs, CountAsMemory) {
  TestScene with(text(), asking_for(kAll)), without(text());
  const auto least = [](TestScene& test) -> std::size_t {
    const auto scene = test.scene(test.intervals().front());
    try {
      test.integrator(*scene, {}, 1);
    } catch (const NotEnoughMemory& error) {
      EXPECT_NO_THROW(test.integrator(*scene, {}, error.least.total()));
      EXPECT_THROW(test.integrator(*scene, {}, error.least.total() - 1), NotEnoughMemory);
      return error.least.pixels;
    }
    return 0;
  };
  // Eight means of three floats, two motions with two each, two ids with their votes, and a counter; and a copy of them.
  const std::size_t frames = with.intervals().front().size();
  EXPECT_EQ(least(with) - least(without), 2 * (8 * 12 + 2 * 24 + 2 * 8 + 4) * frames * kSize * kSize);
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, SurfaceOutputs,
    testing::Values(R"("path")", R"("vcm" "string emission" "power" "integer photons" 500)",
                    R"("dsppm" "string emission" "power" "integer photons" 500)",
                    R"("sppm" "string emission" "power" "integer photons" 500)",
                    R"("photonmap" "string emission" "power" "integer photons" 500 "integer causticphotons" 500)"));

TEST(Albedo, IsTheShareOfLightThatComesBack) {
  const auto albedo = [](const std::string& material) {
    TestScene test(fmt::format(R"(
Integrator "path"
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "point"
Material {}
Translate 0 0 3
Shape "disk" "float radius" 50
)",
                               material),
                   asking_for({"albedo"}));
    Rgb sum;
    const Image image = outputs_of(test, 64).at("albedo")[0];
    for (const Rgb& pixel : image.pixels) sum += pixel / static_cast<float>(image.pixels.size());
    return sum;
  };
  EXPECT_NEAR(albedo(R"("diffuse" "rgb reflectance" [.25 .5 .75])").g, .5, 1e-5);
  EXPECT_NEAR(albedo(R"("dielectric" "float eta" 1.5)").g, 1, 1e-5);  // refraction's scale of radiance left out
  const Rgb metal = albedo(R"("conductor" "rgb reflectance" [.25 .5 .75] "float roughness" 0)");
  EXPECT_NEAR(metal.r, .25, 1e-3);
  EXPECT_NEAR(metal.b, .75, 1e-3);
}

// By one field of the pattern, so that light and dark fields change places.
TEST(Albedo, MovesWithItsTexture) {
  TestScene test(R"(
Frames 2
Option "disablepixeljitter" true
Option "disabletexturefiltering" true
Integrator "path"
Camera "orthographic"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "point"
DynamicBegin "wall"
  Keyframe 1 Translate 0 0 0 Keyframe 2 Translate 1 0 0 KeyframeEnd
  Texture "fields" "spectrum" "checkerboard" "string mapping" "planar" "rgb tex1" [.8 .8 .8] "rgb tex2" [.2 .2 .2]
  Material "diffuse" "texture reflectance" "fields"
  Translate 0 0 3
  Shape "disk" "float radius" 50
DynamicEnd
)",
                 asking_for({"albedo"}));
  const auto images = outputs_of(test).at("albedo");
  for (std::size_t p = 0; p < images[0].pixels.size(); ++p) {
    EXPECT_NEAR(images[0].pixels[p].g + images[1].pixels[p].g, 1, 1e-5);
    EXPECT_NEAR(std::abs(images[0].pixels[p].g - images[1].pixels[p].g), 0.6, 1e-5);
  }
}

TEST(Depth, OfNothingIsThatOfBlender) {
  TestScene test(R"(Camera "perspective" Film "rgb" "integer xresolution" 4 "integer yresolution" 4
WorldBegin LightSource "infinite" Translate 0 0 -5 Shape "sphere")",
                 asking_for({"Z", "N", "object"}));
  const auto images = outputs_of(test);
  EXPECT_EQ(images.at("Z")[0].at(1, 1).r, 1e10f);
  EXPECT_EQ(images.at("N")[0].at(1, 1), Rgb());
  EXPECT_EQ(images.at("object")[0].at(1, 1).r, 0);
}

/// A pixel that sees `shapes` where x and y are between 0 and 1.
std::string one_pixel(const std::string& shapes) {
  return R"(
Integrator "path"
Camera "orthographic" "float screenwindow" [0 1 0 1]
Film "rgb" "integer xresolution" 1 "integer yresolution" 1
PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
WorldBegin
LightSource "point"
)" + shapes;
}

// An edge at three quarters of a pixel: means weigh by area, ids say what most of the pixel shows.
TEST(Pixels, AreFilteredAndVotedOn) {
  TestScene test(one_pixel(R"(
Material "diffuse" "rgb reflectance" [.8 .8 .8]
Shape "trianglemesh" "point3 P" [0.75 -9 1  9 -9 1  9 9 1  0.75 9 1] "integer indices" [0 1 2 0 2 3] "string name" "near"
Material "diffuse" "rgb reflectance" [.4 .4 .4]
Shape "trianglemesh" "point3 P" [-9 -9 2  9 -9 2  9 9 2  -9 9 2] "integer indices" [0 1 2 0 2 3] "string name" "far"
)"),
                 asking_for({"Z", "object", "albedo"}));
  const auto images = outputs_of(test, 4000);
  EXPECT_NEAR(images.at("Z")[0].at(0, 0).r, 0.25 * 1 + 0.75 * 2, 0.03);
  EXPECT_NEAR(images.at("albedo")[0].at(0, 0).r, 0.25 * 0.8 + 0.75 * 0.4, 0.02);
  EXPECT_EQ(images.at("object")[0].at(0, 0).r, id_of("far"));
}

TEST(Pixels, MayShowMostlyNothing) {
  TestScene test(one_pixel(R"(
Shape "trianglemesh" "point3 P" [0.75 -9 1  9 -9 1  9 9 1  0.75 9 1] "integer indices" [0 1 2 0 2 3]
)"),
                 asking_for({"Z", "object"}));
  const auto images = outputs_of(test, 400);
  EXPECT_EQ(images.at("object")[0].at(0, 0).r, 0);
  EXPECT_NEAR(images.at("Z")[0].at(0, 0).r, 1, 1e-5);  // of the paths that meet a surface
}

TEST(Objects, HaveDistinctNames) {
  const test::TestScene test(R"(
Frames 2
WorldBegin
LightSource "point"
ObjectBegin "leg" Shape "cylinder" Shape "sphere" ObjectEnd
ObjectInstance "leg"
ObjectInstance "leg"
Shape "sphere"
Shape "sphere"
Shape "sphere" "string name" "eye"
Shape "sphere" "string name" "sphere.2"
DynamicBegin "horse" Keyframe 1 Translate 1 0 0 Keyframe 2 Translate 2 0 0 KeyframeEnd Shape "sphere" Shape "disk" DynamicEnd
MakeNamedMaterial "oak" "string type" "diffuse"
Material "diffuse"
Material "diffuse"
)");
  const auto scene = test.scene(test.all_frames());
  std::map<std::string, int> shapes;
  for (const PlacedShape& shape : scene->shapes) ++shapes[scene->object_names[static_cast<std::size_t>(shape.object)]];
  EXPECT_EQ(
      shapes,
      (std::map<std::string, int>{
          {"sphere", 1}, {"sphere.2", 1}, {"eye", 1}, {"sphere.2.2", 1}, {"horse", 4}, {"leg", 2}, {"leg.2", 2}}));
  EXPECT_EQ(std::vector<std::string>(scene->material_names.begin(), scene->material_names.end()),
            (std::vector<std::string>{"oak", "diffuse", "diffuse.2", "diffuse.3"}));
}

// MurmurHash3_x86_32 of well-known inputs; exponents of 0 and 255 are changed.
TEST(Ids, AreThoseOfCryptomatte) {
  const auto bits = [](const std::string& name) { return std::bit_cast<std::uint32_t>(id_of(name)); };
  EXPECT_EQ(bits("hello"), 0x248bfa47u);
  EXPECT_EQ(bits("hello, world"), 0x149bbb7fu);
  EXPECT_EQ(bits("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
  EXPECT_EQ(bits(""), 1u << 23);
  for (int i = 0; i < 100000; ++i) {
    const float id = id_of(std::to_string(i));
    ASSERT_TRUE(std::isnormal(id)) << i;
  }
}

}  // namespace surface_outputs_test
}  // namespace dspm
