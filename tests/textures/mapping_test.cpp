// Mappings and their derivatives: a footprint must be carried as differences of the mapping itself are.
#include "dspm/textures/mapping.h"

#include <random>

#include "tests/textures/make.h"

namespace dspm {
namespace mapping_test {

TextureMapping mapping_of(std::vector<Param> params, const Transform& placement = {}) {
  Diagnostics diagnostics;
  const ParamList list{std::move(params)};
  ParamReader reader(list, "texture \"t\"", {}, diagnostics);
  const TextureMapping mapping = TextureMapping::read(reader, placement);
  reader.finish();
  EXPECT_EQ(diagnostics.error_count(), 0);
  return mapping;
}

TEST(Mapping, UvIsScaledAndShifted) {
  const TextureMapping m = mapping_of({number_param("uscale", 3), number_param("udelta", .5f)});
  EXPECT_EQ(m.at(at_uv(2, .25f)), (Vec2{6.5f, .25f}));
}

TEST(Mapping, SphericalGoesFromPoleToPoleAndAround) {
  const TextureMapping m = mapping_of({text_param("mapping", "spherical")}, Transform(Matrix4::translate(5, 0, 0)));
  EXPECT_NEAR(m.at(at_point(5, 0, 2)).x, 0, 1e-6f);
  EXPECT_NEAR(m.at(at_point(5, 0, -2)).x, 1, 1e-6f);
  EXPECT_NEAR(m.at(at_point(5, 3, 0)).x, .5f, 1e-6f);
  EXPECT_NEAR(m.at(at_point(5, 3, 0)).y, .25f, 1e-6f);
  EXPECT_NEAR(m.at(at_point(5, -3, 0)).y, .75f, 1e-6f);
  EXPECT_EQ(m.at(at_point(5, 0, 0)), (Vec2{0, 0}));  // the centre has no direction
}

TEST(Mapping, CylindricalGoesAroundAndUp) {
  const TextureMapping m = mapping_of({text_param("mapping", "cylindrical")});
  EXPECT_NEAR(m.at(at_point(1, 0, 7)).x, .5f, 1e-6f);
  EXPECT_NEAR(m.at(at_point(0, 1, 7)).x, .75f, 1e-6f);
  EXPECT_EQ(m.at(at_point(0, 1, 7)).y, 7);
}

TEST(Mapping, PlanarProjectsOntoItsVectors) {
  const TextureMapping m = mapping_of(
      {text_param("mapping", "planar"), number_param("vdelta", 1), triple_param(ParamType::vector3, "v1", 0, 0, 2)});
  EXPECT_EQ(m.at(at_point(1, 2, 3)), (Vec2{6, 3}));
}

TEST(Mapping, APointHasNoFootprint) {
  for (const char* kind : {"uv", "spherical", "cylindrical", "planar"}) {
    const TextureCoordinates c = mapping_of({text_param("mapping", kind)}).map(at_point(1, 2, 3));
    EXPECT_EQ(c.dstdx, Vec2{});
    EXPECT_EQ(c.dstdy, Vec2{});
  }
}

// On the plane p = o + u a + v b, with oblique a and b, steps in p are steps in (u, v).
TEST(Mapping, CarriesFootprintsAsItCarriesPoints) {
  const Vec3 o{1, 2, .5f}, a{.5f, .2f, 3}, b{-1, .7f, .3f};
  const auto on_plane = [&](Vec2 uv) { return TexturePoint{o + a * uv.x + b * uv.y, uv, {}, a, b}; };
  const Transform placement(Matrix4::translate(-3, 1, 0) * Matrix4::rotate(30, 1, 2, 3) * Matrix4::scale(1, 2, .5));
  std::mt19937 random(11);
  std::uniform_real_distribution<float> number(-1, 1);
  for (const char* kind : {"uv", "spherical", "cylindrical", "planar"}) {
    const TextureMapping m =
        mapping_of({text_param("mapping", kind), number_param("uscale", 3), number_param("vscale", -.5f),
                    triple_param(ParamType::vector3, "v1", 1, .5f, 2)},
                   placement);
    for (int i = 0; i < 200; ++i) {
      const Vec2 uv{number(random), number(random)}, step{number(random) * 2e-3f, number(random) * 2e-3f};
      TexturePoint here = on_plane(uv);
      here.dpdx = a * step.x + b * step.y, here.dpdy = here.dpdx * -2;
      const TextureCoordinates c = m.map(here);
      const Vec2 change = m.at(on_plane(uv + step * .5f)) - m.at(on_plane(uv - step * .5f));
      if (std::abs(change.x) > .5f || std::abs(change.y) > .5f) continue;  // across the seam
      EXPECT_NEAR(c.dstdx.x, change.x, 2e-5f) << kind;
      EXPECT_NEAR(c.dstdx.y, change.y, 2e-5f) << kind;
      EXPECT_NEAR(c.dstdy.x, -2 * change.x, 4e-5f) << kind;
      EXPECT_NEAR(c.dstdy.y, -2 * change.y, 4e-5f) << kind;
      EXPECT_EQ(c.st, m.at(here));
    }
  }
}

TEST(Mapping, WhereNothingIsKnownThereIsNoFootprint) {
  TexturePoint at = at_uv(.5f, .5f);
  at.dpdx = {1, 0, 0}, at.dpdu = {1, 0, 0};
  EXPECT_EQ(mapping_of({}).map(at).dstdx, Vec2{});
  at.dpdv = {2, 0, 0};  // parallel
  EXPECT_EQ(mapping_of({}).map(at).dstdx, Vec2{});
  TexturePoint pole = at_point(0, 0, 1);
  pole.dpdx = {1, 0, 0};
  const Vec2 change = mapping_of({text_param("mapping", "spherical")}).map(pole).dstdx;
  EXPECT_TRUE(std::isfinite(change.x) && std::isfinite(change.y));
}

}  // namespace mapping_test
}  // namespace dspm
