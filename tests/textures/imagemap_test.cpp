// Lookups in pictures of a few pixels, whose values follow from the definition of bilinear interpolation: pixel centres
// hold the pixels' values.
#include <filesystem>
#include <fstream>
#include <limits>

#include "dspm/base/math/moments.h"
#include "dspm/image/exr.h"
#include "tests/textures/make.h"

namespace dspm {
namespace imagemap_test {

class Imagemap : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(directory); }
  void TearDown() override { std::filesystem::remove_all(directory); }

  std::string picture(const std::string& name, int width, int height, std::vector<Rgb> pixels) const {
    Image image(width, height);
    image.pixels = std::move(pixels);
    write_exr(directory / name, image, {}, ExrPixels::single);
    return (directory / name).string();
  }
  /// A row of black, one half, one.
  std::string ramp() const { return picture("ramp.exr", 3, 1, {Rgb(0), Rgb(.5f), Rgb(1)}); }

  TexturePtr<float> make(std::vector<Param> params) {
    params.push_back(text_param("filename", ramp()));
    return workshop.make<float>("imagemap", std::move(params));
  }
  float at(const TexturePtr<float>& texture, float u) const { return texture->evaluate(at_uv(u, .5f)); }

  const std::filesystem::path directory =
      std::filesystem::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  Workshop workshop;
};

constexpr float kTight = 1e-5f;

TEST_F(Imagemap, IsExactAtPixelCentresAndLinearBetween) {
  const auto t = make({});
  EXPECT_EQ(workshop.message(), "");
  EXPECT_NEAR(at(t, .5f / 3), 0, kTight);
  EXPECT_NEAR(at(t, 1.5f / 3), .5f, kTight);
  EXPECT_NEAR(at(t, 2.5f / 3), 1, kTight);
  EXPECT_NEAR(at(t, 1.f / 3), .25f, kTight);
  EXPECT_NEAR(at(t, 2.f / 3), .75f, kTight);
}

TEST_F(Imagemap, WrapsAround) {
  const auto repeat = make({}), clamp = make({text_param("wrap", "clamp")}),
             black = make({text_param("wrap", "black")});
  EXPECT_NEAR(at(repeat, 0), .5f, kTight);  // between the last and the first pixel
  EXPECT_NEAR(at(repeat, 5.5f), .5f, kTight);
  EXPECT_NEAR(at(repeat, -1 + 2.5f / 3), 1, kTight);
  EXPECT_NEAR(at(clamp, 1), 1, kTight);
  EXPECT_NEAR(at(clamp, 1e20f), 1, kTight);
  EXPECT_NEAR(at(clamp, -3), 0, kTight);
  EXPECT_NEAR(at(black, 1), .5f, kTight);  // half way from the last centre to the black outside
  EXPECT_NEAR(at(black, 1.5f), 0, kTight);
  EXPECT_NEAR(at(black, -kInfinity), 0, kTight);
}

TEST_F(Imagemap, AnyCoordinateIsFinite) {
  for (const char* wrap : {"repeat", "clamp", "black"})
    for (const float odd : {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN(), 3e38f, -3e38f})
      EXPECT_TRUE(std::isfinite(at(make({text_param("wrap", wrap)}), odd))) << wrap << odd;
}

TEST_F(Imagemap, PointFilterTakesThePixelItIsIn) {
  const auto t = make({text_param("filter", "point")});
  EXPECT_NEAR(at(t, .32f), 0, kTight);
  EXPECT_NEAR(at(t, .34f), .5f, kTight);
  EXPECT_NEAR(at(t, .99f), 1, kTight);
  EXPECT_NEAR(at(t, 1.01f), 0, kTight);
}

TEST_F(Imagemap, ScaleComesBeforeInvertAndNothingIsNegative) {
  const auto t = make({number_param("scale", 2), flag_param("invert", true)});
  EXPECT_NEAR(at(t, .5f / 3), 1, kTight);
  EXPECT_NEAR(at(t, 1.5f / 3), 0, kTight);
  EXPECT_EQ(at(t, 2.5f / 3), 0);
}

TEST_F(Imagemap, VPointsUpAndColoursStayApart) {
  const std::string flag = picture("flag.exr", 1, 2, {Rgb(1, 0, 0), Rgb(0, .5f, 1)});
  const auto t = workshop.make<Rgb>("imagemap", {text_param("filename", flag), text_param("wrap", "clamp")});
  EXPECT_GT(t->evaluate(at_uv(.5f, 1)).r, .9f);
  EXPECT_LT(t->evaluate(at_uv(.5f, 1)).b, .1f);
  EXPECT_GT(t->evaluate(at_uv(.5f, 0)).b, .9f);
  const auto mean = workshop.make<float>("imagemap", {text_param("filename", flag), text_param("wrap", "clamp")});
  EXPECT_NEAR(mean->evaluate(at_uv(.5f, 0)), .5f, kTight);
}

TEST_F(Imagemap, AFileIsReadOnce) {
  const std::filesystem::path path = ramp();
  ImageCache cache;
  const auto once = cache.read(path, {});
  EXPECT_EQ(cache.read(path.parent_path() / "." / path.filename(), {}), once);
  EXPECT_NE(cache.read(path, {ColorEncoding::Kind::gamma, 2.2f}), once);
}

TEST_F(Imagemap, OneFileAFrame) {
  picture("w.001.exr", 1, 1, {Rgb(.5f)});
  picture("w.002.exr", 1, 1, {Rgb(1)});
  const ParamList keyed{{text_param("filename", (directory / "w.%03d.exr").string())}};
  EXPECT_NEAR(at(workshop.make<float>("imagemap", keyed.at(Moment(0)).params), 0), .5f, kTight);
  EXPECT_NEAR(at(workshop.make<float>("imagemap", keyed.at(Moment(1)).params), 0), 1, kTight);
}

TEST_F(Imagemap, WhatIsWrongIsSaid) {
  const auto message = [&](std::vector<Param> params) {
    Workshop w;
    EXPECT_NE(w.make<Rgb>("imagemap", std::move(params)), nullptr);
    EXPECT_EQ(w.diagnostics.all().size(), 1u);
    return w.message();
  };
  EXPECT_EQ(message({}), "texture \"imagemap\" needs a file: \"string filename\"");
  EXPECT_EQ(message({text_param("filename", "nowhere.png")}), "there is no file \"nowhere.png\"");
  EXPECT_EQ(message({text_param("filename", ramp()), text_param("encoding", "rgb")}), "unknown encoding \"rgb\"");
  EXPECT_EQ(message({text_param("filename", ramp()), number_param("maxanisotropy", 0.5f)}),
            "\"maxanisotropy\" must be from 1 to 64");
  std::ofstream(directory / "torn.png") << "no picture";
  EXPECT_NE(message({text_param("filename", (directory / "torn.png").string())}).find("torn.png"), std::string::npos);
}

/// Four times as wide as high, grey from left to right; seen by a footprint as wide as it.
TEST_F(Imagemap, FootprintsChooseTheSize) {
  const std::string wide = picture("wide.exr", 4, 1, {Rgb(0), Rgb(.2f), Rgb(.4f), Rgb(1)});
  for (const char* filter : {"point", "bilinear", "trilinear", "ewa", "EWA"}) {
    const auto t = workshop.make<float>("imagemap", {text_param("filename", wide), text_param("filter", filter),
                                                     number_param("uscale", 2), flag_param("invert", true)});
    const TexturePoint far{{}, {.1f, .5f}, {}, {1, 0, 0}, {0, 1, 0}, {.5f, 0, 0}, {0, 1, 0}};
    EXPECT_NEAR(t->evaluate(far), 1 - .4f, kTight) << filter;
    TexturePoint near = far;
    near.uv = {.5f * 1.5f / 4, .5f}, near.dpdx = near.dpdx * 1e-3f, near.dpdy = near.dpdy * 1e-3f;
    EXPECT_NEAR(t->evaluate(near), 1 - .2f, filter[0] == 'e' || filter[0] == 'E' ? .1f : kTight) << filter;
  }
  EXPECT_EQ(workshop.message(), "");
}

TEST_F(Imagemap, WithoutFilteringThereIsNothingButThePicture) {
  EXPECT_EQ(ImageCache(false).read(ramp(), {})->levels(), 1);
  EXPECT_EQ(ImageCache().read(ramp(), {})->levels(), 3);
}

}  // namespace imagemap_test
}  // namespace dspm
