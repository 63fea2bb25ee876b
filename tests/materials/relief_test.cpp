// Normals of normal maps and bumps, against what they must be: those of the shape, of the picture, of the raised surface.
#include "dspm/materials/relief.h"

#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/image/write_floats.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/testing/test_scene.h"
#include "tests/materials/materials.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

/// A height or anything else that depends on the place.
template <class Value>
class Field final : public FloatTexture {
 public:
  explicit Field(Value value) : value_(std::move(value)) {}
  float evaluate(const TexturePoint& at) const override { return value_(at); }

 private:
  Value value_;
};

/// Of the texture "a".
std::shared_ptr<const Relief> relief_of(const std::string& parameter, const TextureSet& textures) {
  ImageCache images;
  const ParamList list{{{ParamType::texture, parameter, {}, std::vector<std::string>{"a"}, {}, {}}}};
  Diagnostics diagnostics;
  ParamReader reader(list, "material \"diffuse\"", {}, diagnostics);
  return read_relief(reader, {textures, {}, images});
}

template <class Value>
std::shared_ptr<const Relief> bump(Value value) {
  TextureSet textures;
  textures.add<float>("a", std::make_shared<Field<Value>>(value));
  return relief_of("displacement", textures);
}

/// Of a texture, whose y is on the side to which v grows.
std::shared_ptr<const Relief> normal_texture(const Rgb& everywhere) {
  TextureSet textures;
  textures.add<Rgb>("a", std::make_shared<ConstantTexture<Rgb>>(everywhere));
  return relief_of("normaltexture", textures);
}

std::shared_ptr<const Relief> normal_map(const Rgb& everywhere, float scale = 1) {
  const TemporaryDirectory directory;
  Image image(4, 4);
  for (Rgb& pixel : image.pixels) pixel = everywhere;
  write_pfm(directory / "normals.pfm", image);
  const TextureSet textures;
  ImageCache images;
  const ParamList list{{{ParamType::text, "normalmap", {}, std::vector{(directory / "normals.pfm").string()}, {}, {}},
                        number("normalscale", scale)}};
  Diagnostics diagnostics;
  ParamReader reader(list, "material \"diffuse\"", {}, diagnostics);
  const auto relief = read_relief(reader, {textures, {}, images});
  EXPECT_TRUE(diagnostics.all().empty()) << to_string(diagnostics.all().front());
  return relief;
}

/// The scene of one shape, placed as the words say.
struct Placed {
  explicit Placed(const std::string& words)
      : test("WorldBegin\nLightSource \"infinite\"\n" + words), scene(test.scene({FileFrame(0)})) {}
  const PlacedShape& shape() const { return scene->shapes[0]; }
  Vec3 normal(const Relief& relief, int primitive, Vec2 uv) const {
    const SurfacePoint point = shape().surface_point(primitive, uv);
    return relief.bent(point, shape(), primitive, uv).ns;
  }
  TestScene test;
  std::unique_ptr<Scene> scene;
};

// A square of side 2 in the plane y = 0 whose u runs along x, v along z: from 0 to 1.
constexpr const char* kSquare = R"(Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point2 uv" [0 0 1 0 1 1 0 1]
  "point3 P" [0 0 0 2 0 0 2 0 2 0 0 2])";

void expect_near(const Vec3& a, const Vec3& b, float tolerance) { EXPECT_LE(length(a - b), tolerance); }

TEST(NormalMap, ScaleTurnsItsSlopes) {
  const Placed square(kSquare);
  const auto steep = normal_map({0.65f, 0.5f, 0.9f}, 2), plain = normal_map({0.8f, 0.5f, 0.9f});  // .6 over .8
  expect_near(square.normal(*steep, 0, {0.3f, 0.3f}), square.normal(*plain, 0, {0.3f, 0.3f}), 1e-6f);
}

TEST(NormalMap, AFlatOneChangesNoBit) {
  const auto flat = normal_map({0.5f, 0.5f, 1});
  const Placed ball("Rotate 30 1 2 0 Shape \"sphere\"");
  for (const Vec2 uv : {Vec2{0.1f, 0.3f}, Vec2{0.7f, 0.9f}, Vec2{0.5f, 0.01f}})
    EXPECT_EQ(ball.normal(*flat, 0, uv), ball.shape().surface_point(0, uv).ns);
}

// The picture says (0.6, 0, 0.8): along the tangent of u, and up.
TEST(NormalMap, LeansAlongTheTangents) {
  const Placed square(kSquare);
  const SurfacePoint point = square.shape().surface_point(0, {0.3f, 0.2f});
  const Vec3 up = point.ng, along = {1, 0, 0}, across = cross(up, along);
  expect_near(square.normal(*normal_map({0.8f, 0.5f, 0.9f}), 0, {0.3f, 0.2f}), along * 0.6f + up * 0.8f, 1e-6f);
  expect_near(square.normal(*normal_map({0.5f, 0.2f, 0.9f}), 0, {0.3f, 0.2f}), across * -0.6f + up * 0.8f, 1e-6f);
}

// Where u or v runs the other way, the picture is mirrored, and so are the normals that it shows.
TEST(NormalMap, MirroredCoordinatesMirrorNormals) {
  const auto lean_u = normal_texture({0.8f, 0.5f, 0.9f}), lean_v = normal_texture({0.5f, 0.8f, 0.9f});
  for (const float u : {1.f, -1.f})
    for (const float v : {1.f, -1.f})
      for (const char* placed : {"", "Scale -1 1 1 "}) {
        const std::string low_u = u > 0 ? "0 " : "1 ", high_u = u > 0 ? "1 " : "0 ", low_v = v > 0 ? "0 " : "1 ",
                          high_v = v > 0 ? "1 " : "0 ";
        const Placed square(std::string(placed) +
                            R"(Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [0 0 0 2 0 0 2 0 2 0 0 2]
                               "point2 uv" [)" +
                            low_u + low_v + high_u + low_v + high_u + high_v + low_u + high_v + "]");
        const Vec3 up = square.shape().surface_point(0, {0.3f, 0.2f}).ng, along_u{*placed ? -u : u, 0, 0},
                   along_v{0, 0, v};
        for (const int triangle : {0, 1}) {
          expect_near(square.normal(*lean_u, triangle, {0.3f, 0.2f}), along_u * 0.6f + up * 0.8f, 1e-6f);
          expect_near(square.normal(*lean_v, triangle, {0.3f, 0.2f}), along_v * 0.6f + up * 0.8f, 1e-6f);
        }
      }
}

TEST(NormalMap, StaysAboveTheSurface) {
  const Placed square(kSquare);
  const Vec3 n = square.normal(*normal_map({1, 0.5f, 0.1f}), 0, {0.3f, 0.2f});
  EXPECT_GT(dot(n, square.shape().surface_point(0, {0.3f, 0.2f}).ng), 0);
  EXPECT_NEAR(length(n), 1, 1e-6f);
  EXPECT_NEAR(n.x, 1, 1e-3f);
}

// Height 0.3 u rises by 0.15 a unit of length along x.
TEST(Bump, ARampTiltsThePlane) {
  const auto ramp = bump([](const TexturePoint& at) { return 0.3f * at.uv.x; });
  for (const char* reversed : {"", "ReverseOrientation\n"}) {
    const Placed square(std::string(reversed) + kSquare);
    for (const int triangle : {0, 1}) {
      const Vec3 up = square.shape().surface_point(triangle, {0.3f, 0.2f}).ng;
      expect_near(square.normal(*ramp, triangle, {0.3f, 0.2f}), normalize(up - Vec3{0.15f, 0, 0}), 1e-3f);
    }
  }
}

TEST(Bump, AHeightThatIsTheSameEverywhereIsNone) {
  TextureSet textures;
  textures.add<float>("a", std::make_shared<ConstantTexture<float>>(0.5f));
  EXPECT_EQ(relief_of("displacement", textures), nullptr);
}

// A sphere raised by h = 0.2 sin(3 y): the normal of r(y) = 1 + h is n - grad h / r, the gradient along the unit sphere.
TEST(Bump, WavesOnASphere) {
  const auto waves = bump([](const TexturePoint& at) { return 0.2f * std::sin(3 * at.p.y); });
  const Placed ball("Rotate 30 1 2 0 Shape \"sphere\"");
  for (const Vec2 uv : {Vec2{0.1f, 0.3f}, Vec2{0.7f, 0.6f}, Vec2{0.5f, 0.9f}}) {
    const SurfacePoint point = ball.shape().surface_point(0, uv);
    const Vec3 up{0, 1, 0}, n = point.ng;
    const Vec3 gradient = (up - n * dot(up, n)) * (0.6f * std::cos(3 * point.p.y));
    const float r = 1 + 0.2f * std::sin(3 * point.p.y);
    expect_near(ball.normal(*waves, 0, uv), normalize(n - gradient / r), 2e-3f);
  }
}

// The corners' normals lean apart, as on a sphere: without a rise they stay what they are.
TEST(Bump, StartsFromSmoothNormals) {
  const auto waves = bump([](const TexturePoint& at) { return 1e-6f * at.uv.x; });
  const Placed face(R"(Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [1 0 0 0 1 0 0 0 1]
    "normal N" [1 0 0 0 1 0 0 0 1])");
  for (const Vec2 uv : {Vec2{0.2f, 0.3f}, Vec2{0.6f, 0.1f}})
    expect_near(face.normal(*waves, 0, uv), face.shape().surface_point(0, uv).ns, 1e-4f);
}

}  // namespace
}  // namespace dspm::test
