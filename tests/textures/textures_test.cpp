#include <array>
#include <cmath>
#include <limits>

#include "tests/textures/make.h"

namespace dspm {
namespace textures_test {

TEST(Texture, ConstantsKnowThatTheyAre) {
  Workshop w;
  EXPECT_EQ(w.make<float>("constant", {number_param("value", .3f)})->evaluate({}), .3f);
  const auto grey = w.make<Rgb>("constant", {triple_param(ParamType::rgb, "value", .1f, .2f, .3f)});
  EXPECT_EQ(grey->evaluate(at_uv(7, 8)), Rgb(.1f, .2f, .3f));
  EXPECT_EQ(grey->constant(), Rgb(.1f, .2f, .3f));
  EXPECT_EQ(w.make<Rgb>("constant", {})->constant(), Rgb(1));
}

TEST(Texture, ParametersBecomeTextures) {
  Workshop w;
  const auto wood = w.make<Rgb>("checkerboard", {});
  w.textures.add("wood", wood);
  EXPECT_EQ(texture_of(ValueOrTexture<Rgb>{Rgb(.2f), "", {}}, w.textures, w.diagnostics)->constant(), Rgb(.2f));
  EXPECT_EQ(texture_of(ValueOrTexture<Rgb>{Rgb(.2f), "wood", {}}, w.textures, w.diagnostics), wood);
  EXPECT_EQ(w.message(), "");

  EXPECT_EQ(texture_of(ValueOrTexture<Rgb>{Rgb(.2f), "wod", {}}, w.textures, w.diagnostics)->constant(), Rgb(.2f));
  EXPECT_EQ(w.diagnostics.all().back().message, "there is no texture \"wod\" before this line");
  EXPECT_EQ(w.diagnostics.all().back().hint, "did you mean \"wood\"?");
  EXPECT_EQ(texture_of(ValueOrTexture<float>{1, "wood", {}}, w.textures, w.diagnostics)->constant(), 1);
  EXPECT_EQ(w.diagnostics.all().back().hint, "\"wood\" is a spectrum texture, but a float texture is needed");
}

TEST(Texture, ANewTextureOfTheSameNameReplaces) {
  Workshop w;
  w.textures.add("t", w.make<float>("constant", {number_param("value", 1)}));
  w.textures.add("t", w.make<Rgb>("constant", {}));  // of another kind: no matter
  const auto holder = w.make<float>("scale", {texture_param("tex", "t")});
  w.textures.add("t", w.make<float>("constant", {number_param("value", 2)}));
  EXPECT_EQ(w.textures.find<float>("t")->constant(), 2);
  EXPECT_EQ(w.textures.find<Rgb>("t")->constant(), Rgb(1));
  EXPECT_EQ(holder->constant(), 1);
}

TEST(Texture, AnglesOfDirections) {
  Workshop w;
  const auto angle = [&](float red, float green, float rotation) {
    return w
        .make<float>("angle", {triple_param(ParamType::rgb, "tex", red, green, 0), number_param("rotation", rotation)})
        ->evaluate({});
  };
  EXPECT_EQ(angle(1, .5f, 0), 0);
  EXPECT_NEAR(angle(.5f, 1, 0), 90, 1e-4f);
  EXPECT_NEAR(angle(.75f, .75f, 30), 75, 1e-4f);
  EXPECT_NEAR(angle(.5f, .25f, 0), -90, 1e-4f);
  EXPECT_EQ(w.make<float>("angle", {})->constant(), 0);
}

TEST(Texture, ScaleAndMix) {
  Workshop w;
  w.textures.add("squares", w.make<float>("checkerboard", {}));  // 1 and 0
  const auto scaled =
      w.make<Rgb>("scale", {triple_param(ParamType::rgb, "tex", .2f, .4f, .8f), texture_param("scale", "squares")});
  EXPECT_EQ(scaled->evaluate(at_uv(.5f, .5f)), Rgb(.2f, .4f, .8f));
  EXPECT_EQ(scaled->evaluate(at_uv(1.5f, .5f)), Rgb(0));
  EXPECT_FALSE(scaled->constant());
  EXPECT_EQ(w.make<float>("scale", {number_param("tex", 3), number_param("scale", 2)})->constant(), 6);

  const auto mixed =
      w.make<float>("mix", {number_param("tex1", 2), number_param("tex2", 6), texture_param("amount", "squares")});
  EXPECT_EQ(mixed->evaluate(at_uv(1.5f, .5f)), 2);
  EXPECT_EQ(mixed->evaluate(at_uv(.5f, .5f)), 6);
  EXPECT_EQ(w.make<float>("mix", {number_param("amount", .25f)})->constant(), .25f);
  EXPECT_EQ(w.message(), "");
}

TEST(Checkerboard, SquaresAlternateOnBothSidesOfTheOrigin) {
  Workshop w;
  const auto board = w.make<float>("checkerboard", {number_param("uscale", 2), number_param("vdelta", 1)});
  for (int x = -3; x < 3; ++x)
    for (int y = -3; y < 3; ++y) {
      const float u = (static_cast<float>(x) + .5f) / 2, v = static_cast<float>(y) + .5f;
      EXPECT_EQ(board->evaluate(at_uv(u, v)), (x + y + 1) % 2 == 0 ? 1 : 0) << x << ' ' << y;
    }
}

TEST(Checkerboard, CubesLieInTheTexturesSpace) {
  Workshop w;
  const Transform placement(Matrix4::translate(10, 0, 0) * Matrix4::scale(2, 2, 2));
  const auto cubes = w.make<float>("checkerboard", {integer_param("dimension", 3)}, placement);
  EXPECT_EQ(cubes->evaluate(at_point(11, 1, 1)), 1);
  EXPECT_EQ(cubes->evaluate(at_point(13, 1, 1)), 0);
  EXPECT_EQ(cubes->evaluate(at_point(13, 1, 3)), 1);
  EXPECT_EQ(cubes->evaluate(at_point(9, 1, 1)), 0);
  w.make<float>("checkerboard", {integer_param("dimension", 4)});
  EXPECT_EQ(w.message(), "the dimension of a checkerboard must be 2 or 3");
}

// By sums over 20001 points of the triangle filter, whose radius is one and a half footprints, as in pbrt.
TEST(Checkerboard, FootprintsAverage) {
  Workshop w;
  const auto board = w.make<float>("checkerboard", {number_param("uscale", 2)});
  const auto cubes = w.make<float>("checkerboard", {integer_param("dimension", 3)});
  const auto sign = [](double x, double radius) {
    double sum = 0, weights = 0;
    for (int i = -10000; i <= 10000; ++i) {
      const double weight = 1 - std::abs(i) / 10000., cell = std::floor(x + radius * i / 10000.);
      sum += std::fmod(std::abs(cell), 2) == 0 ? weight : -weight, weights += weight;
    }
    return sum / weights;
  };
  for (const float size : {.01f, .3f, 1.f, 7.f})
    for (const float u : {-3.3f, .1f, .999f, 300.26f}) {
      const TexturePoint at{{u, .4f, 2.3f}, {u, .4f}, {}, {1, 0, 0}, {0, 1, 0}, {size / 2, 0, 0}, {0, -size, 0}};
      EXPECT_NEAR(board->evaluate(at), .5 + sign(2. * u, 1.5 * size) * sign(.4f, 1.5 * size) / 2, 1e-3);
      EXPECT_NEAR(cubes->evaluate(at), .5 + sign(u, .75 * size) * sign(.4f, 1.5 * size) / 2, 1e-3);
    }
}

TEST(Checkerboard, AnyCoordinateHasAnAnswer) {
  Workshop w;
  const auto board = w.make<float>("checkerboard", {});
  for (const float huge : {1e30f, -1e30f, kInfinity, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_TRUE(board->evaluate(at_uv(huge, 0)) == 0 || board->evaluate(at_uv(huge, 0)) == 1);
  for (const float huge : {1e30f, kInfinity}) {
    const float value = board->evaluate({{}, {huge, 0}, {}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, huge, 0}});
    EXPECT_TRUE(0 <= value && value <= 1) << value;
  }
  EXPECT_EQ(w.make<float>("checkerboard", {number_param("tex1", .5f), number_param("tex2", .5f)})->constant(), .5f);
}

TEST(TexturePlugins, WhatIsNotBuiltIsAnErrorOrGrey) {
  for (const bool lenient : {false, true}) {
    Workshop w(lenient);
    const auto grey = w.make<Rgb>("ptex", {text_param("filename", "teapot.ptx")});
    EXPECT_EQ(grey->constant(), Rgb(.5f));
    EXPECT_EQ(w.diagnostics.error_count(), lenient ? 0 : 1);
    EXPECT_EQ(w.diagnostics.all().size(), 1u);
    EXPECT_EQ(w.message().find("texture \"ptex\" is not supported by dspm"), 0u);
  }
  Workshop w;
  EXPECT_NE(w.make<float>("imgemap", {}), nullptr);
  EXPECT_EQ(w.message(), "unknown texture \"imgemap\"");
}

TEST(TexturePlugins, DescribeThemselves) {
  const TextureSet none;
  ImageCache images;
  const TextureContext context{none, {}, images};
  const auto check = [&](const auto& plugin) {
    EXPECT_EQ(describe(plugin, context).empty(), plugin.name == "windy") << plugin.name;
  };
  for (const auto& plugin : texture_plugins<Rgb>()) check(plugin);
  for (const auto& plugin : texture_plugins<float>()) check(plugin);
  const std::vector<ParamInfo> mix = describe(*texture_plugins<Rgb>().find("mix"), context);
  EXPECT_EQ(mix[0].name, "tex1");
  EXPECT_EQ(mix[0].type, "float, rgb, spectrum, blackbody or texture");
  EXPECT_EQ(mix[2].type, "float or texture");
}

/// A mesh of which only the vertices are known.
struct KnownVertices final : VertexData {
  std::array<float, 4> vertex_colour(int triangle, Vec2 at) const override {
    return {0.1f * static_cast<float>(triangle), at.x, at.y, 0.25f};
  }
  SecondUv second_uv(int, Vec2 at) const override { return {at, {0, 1}, {1, 0}}; }
};

TEST(Texture, ColoursOfVertices) {
  Workshop w;
  const KnownVertices mesh;
  TexturePoint point = at_uv(7, 8);
  const auto paint = w.make<Rgb>("vertexcolor", {});
  const auto alpha = w.make<float>("vertexcolor", {}),
             blue = w.make<float>("vertexcolor", {text_param("channel", "blue")});
  EXPECT_EQ(paint->evaluate(point), Rgb(1));
  EXPECT_EQ(alpha->evaluate(point), 1);
  point.vertices = {&mesh, 2, {0.5f, 0.75f}};
  EXPECT_EQ(paint->evaluate(point), Rgb(0.2f, 0.5f, 0.75f));
  EXPECT_EQ(alpha->evaluate(point), 0.25f);
  EXPECT_EQ(blue->evaluate(point), 0.75f);
  EXPECT_EQ(w.message(), "");
}

// The second coordinates are the first, exchanged: what they give is what an exchanged point gives, footprint and all.
TEST(Texture, SecondCoordinates) {
  Workshop w;
  const KnownVertices mesh;
  const std::vector<Param> fine{number_param("uscale", 8), number_param("vscale", 2)};
  std::vector<Param> second = fine;
  second.push_back(integer_param("uvset", 2));
  const auto first = w.make<Rgb>("checkerboard", fine), other = w.make<Rgb>("checkerboard", second);
  for (int i = 0; i < 100; ++i) {
    const float u = 0.0173f * static_cast<float>(i), v = 0.37f * u * u;
    TexturePoint point{{u, v, 0}, {u, v}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0.05f, 0, 0}, {0, 0.02f, 0}};
    TexturePoint exchanged{{v, u, 0}, {v, u}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0.05f, 0}, {0.02f, 0, 0}};
    EXPECT_EQ(other->evaluate(point), first->evaluate(point));  // without vertices
    point.vertices = {&mesh, 0, {v, u}};
    EXPECT_NEAR(other->evaluate(point).r, first->evaluate(exchanged).r, 1e-5f);
  }
  w.make<Rgb>("checkerboard", {integer_param("uvset", 3)});
  EXPECT_EQ(w.message(), "\"uvset\" must be 1 or 2");
}

}  // namespace textures_test
}  // namespace dspm
