// Mixes of materials: which material a point is made of, how often, in which frames; and what scenes may say about them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/testing/scattering_cases.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace mixes_test {

constexpr const char* kPaints = R"(
MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [1 0 0]
MakeNamedMaterial "green" "string type" "diffuse" "rgb reflectance" [0 1 0]
MakeNamedMaterial "blue" "string type" "diffuse" "rgb reflectance" [0 0 1]
)";

std::string text(const std::string& looks, int frames = 1) {
  return fmt::format("Frames {}\nWorldBegin\nLightSource \"infinite\"\n{}\nShape \"disk\"\n", frames, looks);
}

SurfacePoint point_at(int i) {
  SurfacePoint point = surface();
  point.p = {std::sin(static_cast<float>(i)), 0.01f * static_cast<float>(i), 1};
  return point;
}

/// What the point reflects in a frame.
Rgb paint(const Scene& scene, Frame frame, const SurfacePoint& point) {
  Rgb colour;
  scene.materials[static_cast<std::size_t>(scene.shapes[0].material)].for_each(
      FrameSet::single(frame), [&](FrameSet, const Material& material) {
        BsdfSlot slot;
        colour = scene.palette->seen(*material.at(point).bsdf(point, slot).lambertian(1) * kPi);
      });
  return colour;
}

/// The mean over points.
Rgb mean_paint(const std::string& looks) {
  const TestScene test(text(looks));
  const auto scene = test.scene({FileFrame(0)});
  constexpr int kPoints = 20'000;
  Rgb sum;
  for (int i = 0; i < kPoints; ++i) sum += paint(*scene, 0, point_at(i)) / kPoints;
  return sum;
}

/// What is said about the scene.
std::string error_of(const std::string& looks) {
  try {
    const TestScene test(text(looks));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Five standard deviations of a mean of 20,000 are 0.018 at most.
void expect_colour(const Rgb& a, const Rgb& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 0.018f) << c;
}

TEST(Mix, TheAmountIsTheShareOfTheSecond) {
  for (const float amount : {0.25f, 0.5f, 0.9f})
    expect_colour(
        mean_paint(kPaints +
                   fmt::format(R"(Material "mix" "string materials" ["red" "green"] "float amount" {})", amount)),
        {1 - amount, amount, 0});
}

TEST(Mix, NothingAndAllAreExact) {
  for (const float amount : {-1.f, 0.f, 1.f, 2.f})
    EXPECT_EQ(mean_paint(kPaints +
                         fmt::format(R"(Material "mix" "string materials" ["red" "green"] "float amount" {})", amount))
                      .r > 0.5f,
              amount <= 0);
  EXPECT_EQ(
      mean_paint(std::string(kPaints) + R"(Material "mix" "string materials" ["red" "green"] "float amount" 1)").r, 0);
}

// If both chose by the same number, one of the inner mix's materials would never show.
TEST(Mix, MixesOfMixesChooseIndependently) {
  expect_colour(mean_paint(std::string(kPaints) +
                           R"(MakeNamedMaterial "inner" "string type" "mix" "string materials" ["green" "blue"]
                            Material "mix" "string materials" ["red" "inner"])"),
                {0.5f, 0.25f, 0.25f});
}

TEST(Mix, NamesMayBeDefinedLater) {
  expect_colour(mean_paint(R"(Material "mix" "string materials" ["outer" "sand"] "float amount" .5
    MakeNamedMaterial "outer" "string type" "mix" "string materials" ["sand" "snow"] "float amount" .5
    MakeNamedMaterial "snow" "string type" "diffuse" "rgb reflectance" [0 1 0]
    MakeNamedMaterial "sand" "string type" "diffuse" "rgb reflectance" [1 0 0])"),
                {0.75f, 0.25f, 0});
}

// From frame to frame points only change to the second material, and a frame alone is what it is among all.
TEST(Mix, AKeyedAmountChangesPointsOneByOne) {
  constexpr int kFrames = 5;
  const TestScene test(text(std::string(kPaints) + R"(Material "mix" "string materials" ["red" "green"]
    "float amount@1" 0 "float amount@5" 1)",
                            kFrames));
  const auto all = test.scene(test.all_frames());
  for (int i = 0; i < 200; ++i) {
    float before = 0;
    for (Frame f = 0; f < kFrames; ++f) {
      const Rgb colour = paint(*all, f, point_at(i));
      EXPECT_GE(colour.g, before);
      before = colour.g;
      EXPECT_EQ(colour, paint(*test.scene({FileFrame(f)}), 0, point_at(i)));
    }
    EXPECT_EQ(before, 1);
  }
}

TEST(Mix, VariationsReplaceWhatItIsMadeOf) {
  const TestScene test(text(std::string(kPaints) + R"(Material "mix" "string materials" ["red" "green"] "float amount" 0
    VariationBegin "a" MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [0 0 1] VariationEnd
    VariationBegin "b" MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [1 0 0] VariationEnd)"));
  const auto scene = test.scene(test.all_frames());
  EXPECT_EQ(paint(*scene, 0, point_at(1)), Rgb(0, 0, 1));
  EXPECT_EQ(paint(*scene, 1, point_at(1)), Rgb(1, 0, 0));
}

TEST(Mix, FaultsAreNamed) {
  const auto with = [](const std::string& looks) { return error_of(kPaints + looks); };
  EXPECT_TRUE(contains(with(R"(Material "mix" "string materials" ["red" "gren"])"), "no material named \"gren\""));
  EXPECT_TRUE(contains(with(R"(Material "mix" "string materials" ["red" "gren"])"), "did you mean \"green\""));
  EXPECT_TRUE(contains(with(R"(Material "mix")"), "takes the names of two materials"));
  EXPECT_TRUE(contains(with(R"(Material "mix" "string materials" "red")"), "takes the names of two materials"));
  EXPECT_TRUE(contains(with(R"(Material "mix" "string materials" ["red" "green"] "float displacement" 1)"),
                       "unknown parameter \"displacement\""));
  EXPECT_TRUE(contains(with(R"(MakeNamedMaterial "a" "string type" "mix" "string materials" ["red" "b"]
    MakeNamedMaterial "b" "string type" "mix" "string materials" ["a" "green"] NamedMaterial "a")"),
                       "is made of itself"));
}

// The inner mix is there at half of its points, so a stop is red twice as often as green.
TEST(Mix, WhatIsThereIsSharedByWhatStopsTheRay) {
  const std::string looks = std::string(kPaints) + R"(MakeNamedMaterial "air" "string type" "interface"
    MakeNamedMaterial "net" "string type" "mix" "string materials" ["green" "air"])";
  expect_colour(mean_paint(looks + R"(Material "mix" "string materials" ["red" "net"])"), {2 / 3.f, 1 / 3.f, 0});
  expect_colour(mean_paint(looks + R"(Material "mix" "string materials" ["air" "net"])"), {0, 1, 0});
}

TEST(Mix, HolesFollowVariationsAndKeys) {
  const TestScene test(text(std::string(kPaints) + R"(MakeNamedMaterial "air" "string type" "interface"
    MakeNamedMaterial "net" "string type" "mix" "string materials" ["red" "air"] "float amount" .25
    NamedMaterial "net"
    VariationBegin "net" MakeNamedMaterial "red" "string type" "diffuse" VariationEnd
    VariationBegin "wide net" MakeNamedMaterial "net" "string type" "mix" "string materials" ["red" "air"]
      "float amount" .75 VariationEnd
    VariationBegin "closed" MakeNamedMaterial "net" "string type" "diffuse" VariationEnd
    VariationBegin "gone" MakeNamedMaterial "net" "string type" "mix" "string materials" ["air" "air"] VariationEnd)"));
  const auto scene = test.scene(test.all_frames());
  ASSERT_EQ(scene->shapes.size(), 3u);
  EXPECT_EQ(scene->shapes[0].cutout->alpha({}), 0.75f);
  EXPECT_EQ(scene->shapes[1].cutout->alpha({}), 0.25f);
  EXPECT_EQ(scene->shapes[2].cutout, nullptr);
  EXPECT_EQ(scene->shapes[2].frames, FrameSet::single(2));
}

// Rust on amber leaves the inside amber; two colours of glass would have two insides.
TEST(Mix, ABodyHasOneInside) {
  const auto glass = [](const std::string& name, const std::string& colour) {
    return fmt::format("MakeNamedMaterial \"{}\" \"string type\" \"dielectric\" \"rgb attenuationcolor\" {}\n", name,
                       colour);
  };
  const std::string looks =
      kPaints + glass("amber", "[.9 .5 .1]") + glass("honey", "[.9 .5 .1]") + glass("lime", "[.5 .9 .1]");
  for (const char* parts : {"\"amber\" \"red\"", "\"red\" \"amber\"", "\"amber\" \"honey\""}) {
    const TestScene test(text(looks + fmt::format("Material \"mix\" \"string materials\" [{}]", parts)));
    const auto scene = test.scene({FileFrame(0)});
    EXPECT_FALSE(scene->bounds_bodies.empty());
    scene->materials[static_cast<std::size_t>(scene->shapes[0].material)].for_each(
        FrameSet::single(0), [&](FrameSet, const Material& material) {
          EXPECT_TRUE(material.bounds_a_body());
          EXPECT_NEAR(material.absorption(Palette::rgb())[1], -std::log(0.5f), 1e-5f) << parts;
        });
  }
  EXPECT_TRUE(contains(error_of(looks + "Material \"mix\" \"string materials\" [\"amber\" \"lime\"]"),
                       "a body has one inside"));
}

TEST(Mix, DeepNestingIsAnError) {
  std::string looks = kPaints;
  std::string inner = "red";
  for (int i = 0; i < 100; ++i) {
    const std::string name = fmt::format("m{}", 100 - i);
    looks += fmt::format("MakeNamedMaterial \"{}\" \"string type\" \"mix\" \"string materials\" [\"{}\" \"green\"]\n",
                         name, i == 99 ? "red" : fmt::format("m{}", 99 - i));
    inner = name;
  }
  EXPECT_TRUE(contains(error_of(looks), "nested more than 64 deep"));
}

}  // namespace mixes_test
}  // namespace dspm::test
