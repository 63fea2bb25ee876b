// What variations replace besides looks: camera, light, contents of a Dynamic block, settings of the integrator. Each
// image is that of a plain scene with the variation's definitions written in.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/session/frame_intervals.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/session/stage.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace replacements_test {

struct Plain {
  std::string camera = R"(LookAt 0 .5 -4  0 .3 0  0 1 0 Camera "perspective" "float fov" 40)";
  std::string light = R"(LightSource "point" "rgb I" [9 8 7] "string name" "key")";
  std::string block = R"(Translate 0 .2 0 Shape "sphere" "float radius" .5)";
  std::string integrator = R"(Integrator "path" "integer maxdepth" 4)";
  std::string variations = "";

  std::string text() const {
    return fmt::format(R"(Frames 3
{}
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
{}
WorldBegin
AttributeBegin Translate 0 2 -1 {} AttributeEnd
Material "diffuse" "rgb reflectance" [.6 .5 .4]
AttributeBegin Translate 0 0 8 Shape "sphere" "float radius" 29 AttributeEnd
AttributeBegin
  Material "diffuse" "rgb reflectance" [.2 .3 .8]
  Rotate 20 0 0 1
  DynamicBegin "part" {} DynamicEnd
AttributeEnd
Translate 5 5 5
{}
)",
                       camera, integrator, light, block, variations);
  }
};

void expect_variation(const std::string& variation, const Plain& plain, const Plain& own = {}) {
  Plain product = own;
  product.variations = fmt::format(
      "AxisBegin \"a\" VariationBegin \"as it is\" VariationEnd VariationBegin \"other\" {} "
      "VariationEnd AxisEnd",
      variation);
  TestScene together(product.text()), before(own.text()), after(plain.text());
  ASSERT_EQ(together.frame_count(), 6);
  const std::vector<Image> images = together.render_all(2);
  for (int moment = 0; moment < 3; ++moment) {
    const auto m = static_cast<std::size_t>(moment);
    EXPECT_EQ(images[m], before.render(FileFrame(moment), 2)) << moment;
    EXPECT_EQ(images[m + 3], after.render(FileFrame(moment), 2)) << moment;
    EXPECT_EQ(images[m + 3], together.render(FileFrame(moment + 3), 2)) << moment;
    EXPECT_NE(images[m], images[m + 3]);
  }
}

TEST(Replacements, OfTheCamera) {
  const std::string still = R"(LookAt 1 .5 -3  0 .3 0  0 1 0 Camera "perspective" "float fov" 60)";
  const std::string moving = R"(Keyframe 1 LookAt 1 .5 -3  0 .3 0  0 1 0 Keyframe 3 LookAt -1 .5 -3  0 .3 0  0 1 0
    KeyframeEnd Camera "spherical")";
  for (const std::string& camera : {still, moving}) {
    Plain plain;
    plain.camera = camera;
    expect_variation(camera, plain);
  }
}

TEST(Replacements, OfALightStandWhereItStood) {
  Plain plain;
  plain.light = R"(Translate -1 0 0 LightSource "point" "rgb I" [2 9 2] "float scale@3" 2 "string name" "key")";
  expect_variation(plain.light, plain);
}

TEST(Replacements, OfAnAreaLightStayOnItsShapes) {
  const auto light = [](const std::string& directive) {
    Plain plain;
    plain.light = directive + R"( Shape "sphere" "float radius" .2 Translate 1 0 0 Shape "sphere" "float radius" .2)";
    return plain;
  };
  const std::string warm = R"(AreaLightSource "diffuse" "rgb L" [20 9 4] "float scale@3" 2 "string name" "lamp")";
  expect_variation(warm, light(warm), light(R"(AreaLightSource "diffuse" "rgb L" [9 9 9] "string name" "lamp")"));
}

/// Of all pixels.
double mean(const Image& image) {
  double sum = 0;
  for (const Rgb& pixel : image.pixels) sum += static_cast<double>(pixel.r + pixel.g + pixel.b);
  return sum / static_cast<double>(image.pixels.size());
}

// Two lights that are never there together: each is chosen half of the time, so only the expectation is that of one.
TEST(Replacements, OfALightMayBeOfAnotherType) {
  Plain plain, product;
  plain.light = R"(LightSource "spot" "rgb I" [9 9 9] "point3 to" [0 -1 .5] "float coneangle" 60 "string name" "key")";
  product.variations = "VariationBegin \"lamp\" VariationEnd VariationBegin \"spot\" " + plain.light + "VariationEnd";
  TestScene together(product.text()), before(Plain().text()), after(plain.text());
  EXPECT_NEAR(mean(together.render(FileFrame(0), 200)) / mean(before.render(FileFrame(0), 200)), 1, 0.03);
  EXPECT_NEAR(mean(together.render(FileFrame(3), 200)) / mean(after.render(FileFrame(0), 200)), 1, 0.03);
}

TEST(Replacements, OfABlockHaveItsSurroundings) {
  Plain plain;
  plain.block = R"(Keyframe 1 Translate .2 .4 0 Keyframe 3 Translate 0 0 0 KeyframeEnd Shape "disk" "float radius" .7
    Material "diffuse" "rgb reflectance" [.8 .1 .1] Translate 0 .3 -.3 Shape "cylinder" "float radius" .2)";
  expect_variation("DynamicBegin \"part\" " + plain.block + " DynamicEnd", plain);
}

TEST(Replacements, OfTheIntegratorsSettings) {
  Plain plain;
  plain.integrator = R"(Integrator "path" "integer maxdepth" 1)";
  Plain product;
  product.variations = "VariationBegin \"a\" VariationEnd VariationBegin \"b\" " + plain.integrator + " VariationEnd";
  TestScene together(product.text()), before(Plain().text()), after(plain.text());
  const std::vector<FrameList> intervals =
      FrameIntervals(*together.job().description, together.all_frames()).cut(kMaxFrames);
  ASSERT_EQ(intervals.size(), 2u);
  for (const FrameList& interval : intervals) {
    const std::unique_ptr<Scene> scene = together.scene(interval);
    Diagnostics diagnostics;
    const std::unique_ptr<Integrator> made = make_integrator(together.job(), *scene, diagnostics);
    for (int i = 0; i < 2; ++i) made->iterate({i, *scene});
    for (std::size_t j = 0; j < interval.size(); ++j) {
      const int frame = interval[j].index();
      EXPECT_EQ(made->estimate(static_cast<Frame>(j)), (frame < 3 ? before : after).render(FileFrame(frame % 3), 2));
    }
  }
}

std::string refusal(const std::string& variation) {
  Plain product;
  product.variations = "VariationBegin \"b\" VariationEnd VariationBegin \"a\" " + variation + " VariationEnd";
  try {
    const TestScene scene(product.text());
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(Replacements, ThatAreWrong) {
  const auto expect = [](const std::string& variation, const std::string& told) {
    const std::string error = refusal(variation);
    EXPECT_NE(error.find(told), std::string::npos) << told << "\n" << error;
  };
  expect(R"(LightSource "point")", "a LightSource in a variation replaces one of the same name");
  expect(R"(LightSource "point" "string name" "kye")", "the scene has no LightSource named \"kye\"");
  expect(R"(AreaLightSource "diffuse")", "an AreaLightSource in a variation replaces one of the same name");
  expect(R"(AreaLightSource "diffuse" "string name" "key")",
         "the scene's light \"key\" is of the directive LightSource");
  expect(R"(LightSource "point" "string name" "key" LightSource "point" "string name" "key")", "appears twice");
  expect(R"(LightSource "point" "string name" "key" "float photons" 2)", "must be those of the light that it replaces");
  expect(R"(DynamicBegin "prat" DynamicEnd)", "there is no Dynamic block \"prat\" before this variation");
  expect(R"(Camera "perspective" Camera "perspective")", "a second Camera in this variation");
  expect(R"(Integrator "dsppm")", "the integrator's type is the same for all variations");
  expect(R"(Integrator "path" "integer seed" 3)", "the seed is the same for all variations");
  expect(R"(Integrator "path" "integer maxdpeth" 3)", "maxdpeth");
  expect(R"(Film "rgb")", "Film must come before WorldBegin");
}

}  // namespace replacements_test
}  // namespace dspm::test
