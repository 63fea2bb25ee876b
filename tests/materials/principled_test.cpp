// The principled material against what its layers are known to be: its pure forms are those of the materials for glass
// and metal. What white ones give back is in white_test.cpp.
#include <gtest/gtest.h>

#include "dspm/materials/fresnel.h"
#include "dspm/testing/scattering.h"
#include "tests/materials/materials.h"

namespace dspm::test {
namespace {

/// The surface of a normal map that leans by `degrees`.
SurfacePoint leaning(float degrees) {
  SurfacePoint point = surface(direction(std::cos(degrees * kPi / 180), 0.4f));
  point.smooth_ns = {0, 0, 1};
  return point;
}

// Seen straight on, a mirror that leans by more than 45 degrees would show the surface itself.
TEST(Principled, SteepMirrorsAreNotBlack) {
  for (const float roughness : {0.f, 0.5f}) {
    const auto metal =
        make("principled", {number("metallic", 1), rgb("basecolor", Rgb(1)), number("roughness", roughness)});
    for (const float degrees : {30.f, 46.f, 60.f, 80.f}) {
      BsdfSlot slot;
      const Bsdf& bsdf = metal->bsdf(leaning(degrees), slot);
      const PathRandom random(11, Stream::setup, 0, 0);
      const float albedo = test::albedo(bsdf, {0, 0, 1}, Transport::radiance, random, 20'000).mean[0];
      EXPECT_GE(albedo, roughness == 0 ? 0.999f : 0.6f) << roughness << " " << degrees;
      EXPECT_LE(albedo, 1.01f) << roughness << " " << degrees;
      const auto drawn = bsdf.sample({0, 0, 1}, {0.5f, 0.5f, 0}, Transport::radiance, 1);
      if (roughness > 0) continue;
      ASSERT_TRUE(drawn && drawn->specular);
      const float expected = degrees < 45 ? std::cos(2 * degrees * kPi / 180) : 0.005f;
      EXPECT_NEAR(drawn->wi.z, expected, 1e-3f) << degrees;
      EXPECT_NEAR(drawn->wi.y, drawn->wi.x * std::tan(0.4f), 1e-3f) << degrees;  // to the side it leans to
    }
  }
}

// Varnish runs smoothly over the relief of the wood.
TEST(Principled, CoatsFollowTheShape) {
  const auto varnish = make("principled", {number("coat", 1), number("specular", 0), rgb("basecolor", Rgb(0.5f))});
  BsdfSlot slot;
  const Bsdf& bsdf = varnish->bsdf(leaning(20), slot);
  for (const Vec3& wo : {direction(1, 0), direction(0.6f, 2)}) {
    const auto drawn = bsdf.sample(wo, {0.5f, 0.5f, 0}, Transport::radiance, 8);
    ASSERT_TRUE(drawn && drawn->specular);
    EXPECT_NEAR(length(drawn->wi - Vec3{-wo.x, -wo.y, wo.z}), 0, 3e-4f);
    EXPECT_NEAR(drawn->weight[1], fresnel_dielectric(wo.z, 1.5f), 1e-4f);
    const auto back = bsdf.sample(drawn->wi, {0.5f, 0.5f, 0}, Transport::flux, 8);
    ASSERT_TRUE(back);
    // Veach's correction for shading normals, which integrators apply, makes them the same.
    const Vec3 ns = leaning(20).ns;
    EXPECT_NEAR(back->weight[1] * dot(drawn->wi, ns) / dot(wo, ns), drawn->weight[1], 1e-4f);
  }
}

TEST(Principled, LeaningLobesAreSampledAsTheyAre) {
  const auto metal = make("principled", {number("metallic", 1), number("roughness", 0.6f), number("coat", 0.5f),
                                         number("coatroughness", 0.5f)});
  BsdfSlot slot;
  const Bsdf& bsdf = metal->bsdf(leaning(55), slot);
  const PathRandom random(5, Stream::setup, 15, 0);
  for (const Transport transport : {Transport::radiance, Transport::flux})
    for (int n = 0; n < 500; ++n) {
      const Vec3 wo = direction(0.3f + 0.001f * static_cast<float>(n), 0.5f);
      const auto drawn = bsdf.sample(wo, three_numbers(random, n), transport, bsdf.all_lobes());
      if (!drawn) continue;
      EXPECT_NEAR(bsdf.pdf_w(wo, drawn->wi, transport, bsdf.all_lobes()) / drawn->pdf_w, 1, 1e-3f);
      const Spectrum f = bsdf.evaluate(wo, drawn->wi, transport, bsdf.all_lobes());
      const Transport other = transport == Transport::radiance ? Transport::flux : Transport::radiance;
      const Spectrum exchanged = bsdf.evaluate(drawn->wi, wo, other, bsdf.all_lobes());
      EXPECT_NEAR(exchanged[1], f[1], 1e-3f * f[1] + 1e-6f);
    }
}

TEST(Principled, PureGlassIsDielectric) {
  const Param eta = number("eta", 1.4f);
  const auto principled = make(
      "principled", {number("transmission", 1), eta, number("roughness", 0.6f), rgb("basecolor", {0.25f, 0.5f, 1})});
  const auto dielectric = make("dielectric", {eta, alpha(0.36f)});
  BsdfSlot slots[2];
  const Bsdf &ours = principled->bsdf(surface(), slots[0]), &known = dielectric->bsdf(surface(), slots[1]);
  const PathRandom random(5, Stream::setup, 12, 0);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 wo = any_direction(random, n), wi = any_direction(random, 5000 + n);
    const Spectrum f = ours.evaluate(wo, wi, Transport::radiance, 3),
                   expected = known.evaluate(wo, wi, Transport::radiance, 3);
    const Spectrum tint = wo.z * wi.z > 0 ? Spectrum(1) : Spectrum(0.5f, std::sqrt(0.5f), 1);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[c], expected[c] * tint[c], 2e-3f * expected[c] + 1e-5f);
  }
}

TEST(Principled, SmoothGlassIsDielectric) {
  const auto principled =
      make("principled", {number("transmission", 1), number("roughness", 0), rgb("basecolor", Rgb(1))});
  const auto dielectric = make("dielectric", {});
  BsdfSlot slots[2];
  const Bsdf &ours = principled->bsdf(surface(), slots[0]), &known = dielectric->bsdf(surface(), slots[1]);
  for (const Vec3& wo : directions())
    for (const float u : {0.001f, 0.999f}) {
      const auto drawn = ours.sample(wo, {0.5f, 0.5f, u}, Transport::radiance, 3),
                 expected = known.sample(wo, {0.5f, 0.5f, u}, Transport::radiance, 3);
      ASSERT_EQ(drawn.has_value(), expected.has_value()) << wo.z;
      if (!drawn) continue;
      EXPECT_NEAR(dot(drawn->wi, expected->wi), 1, 1e-5f);
      EXPECT_NEAR(drawn->weight[1], expected->weight[1], 1e-3f);
      EXPECT_EQ(drawn->eta_scale, expected->eta_scale);
    }
}

// What a thin wall lets through goes straight on where it is smooth; rough, it is what it mirrors on the other side.
TEST(Principled, ThinWallsDoNotBendLight) {
  const Spectrum tint(0.9f, 0.5f, 0.2f);
  const auto pane = make("principled", {number("transmission", 1), number("roughness", 0), flag("thin", true),
                                        number("eta", 1.4f), rgb("basecolor", tint)});
  EXPECT_FALSE(pane->bounds_a_body());
  BsdfSlot slot;
  const Bsdf& smooth = pane->bsdf(surface(), slot);
  for (const float cos : {1.f, 0.5f, 0.2f, -0.5f}) {
    const Vec3 wo = direction(cos, 1);
    const auto drawn = smooth.sample(wo, {0.5f, 0.5f, 0.999f}, Transport::radiance, 3);
    ASSERT_TRUE(drawn && drawn->specular);
    EXPECT_NEAR(dot(drawn->wi, wo), -1, 1e-6f);
    EXPECT_EQ(drawn->eta_scale, 1);
    const float passes = 1 - fresnel_dielectric(std::abs(cos), 1.4f), chance = smooth.lobe_probability(wo, 2);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(drawn->weight[c], tint[c] * passes / chance, 1e-3f) << cos;
  }
}

TEST(Principled, RoughThinWallsPassAsTheyMirror) {
  const Param rough = number("roughness", 0.5f);
  const auto pane =
                 make("principled", {number("transmission", 1), rough, flag("thin", true), rgb("basecolor", Rgb(1))}),
             mirror = make("principled", {number("metallic", 1), rough, rgb("basecolor", Rgb(1))});
  BsdfSlot slots[2];
  const Bsdf &ours = pane->bsdf(surface(), slots[0]), &white = mirror->bsdf(surface(), slots[1]);
  const PathRandom random(5, Stream::setup, 14, 0);
  for (int n = 0; n < 500; ++n) {
    Vec3 wo = any_direction(random, n), wi = any_direction(random, 5000 + n);
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    const Spectrum both =
        ours.evaluate(wo, wi, Transport::radiance, 1) + ours.evaluate(wo, {wi.x, wi.y, -wi.z}, Transport::radiance, 2);
    const float expected = white.evaluate(wo, wi, Transport::radiance, 1)[0];
    EXPECT_NEAR(both[0], expected, 1e-4f * expected + 1e-5f);
  }
}

// f of diffuse light on the other side over f on this one.
TEST(Principled, LeavesDiffuseOnBothSides) {
  const auto leaf = make("principled", {number("diffusetransmission", 0.25f), rgb("basecolor", {0.8f, 0.4f, 0.2f}),
                                        rgb("diffusetransmissioncolor", {0.2f, 0.4f, 0.8f}), number("specular", 0)});
  BsdfSlot slot;
  const Bsdf& bsdf = leaf->bsdf(surface(), slot);
  EXPECT_TRUE(bsdf.transmits(4));
  for (const float side : {1.f, -1.f}) {
    const Vec3 wo = direction(0.6f * side, 1), here = direction(0.4f * side, 4), beyond = direction(-0.4f * side, 4);
    const Spectrum mirrored = bsdf.evaluate(wo, here, Transport::radiance, 4),
                   passed = bsdf.evaluate(wo, beyond, Transport::radiance, 4);
    const Spectrum base(0.8f, 0.4f, 0.2f), other(0.2f, 0.4f, 0.8f);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mirrored[c] * kPi, 0.75f * base[c], 1e-4f);
      EXPECT_NEAR(passed[c] * kPi, 0.25f * other[c], 1e-4f);
    }
  }
}

// Straight on, the dielectric mirrors F0 times the colour, but no more than all light; at grazing angles it is white.
// Between, it is Schlick's term of that, to within the error of Schlick's term itself.
// [glTF 2.0, KHR_materials_specular: F0 = min(F0 x specularColor, 1) x specular, F90 = specular]
TEST(Principled, SpecularColourIsThatStraightOn) {
  for (const float specular : {1.f, 0.4f})
    for (const Spectrum& colour : {Spectrum(1, 0.5f, 0), Spectrum(1.184f, 5.441f, 13.276f), Spectrum(25, 100, 1e6f)}) {
      const auto paint =
          make("principled", {number("roughness", 0), rgb("specularcolor", colour), number("specular", specular)});
      BsdfSlot slot;
      const Bsdf& bsdf = paint->bsdf(surface(), slot);
      for (const float cos : {1.f, 0.6f, 0.3f, 0.01f}) {
        const auto drawn = bsdf.sample(direction(cos, 1), {}, Transport::radiance, 1);
        ASSERT_TRUE(drawn && drawn->specular);
        for (int c = 0; c < 3; ++c) {
          const float straight = std::min(0.04f * colour[c], 1.f);
          const auto schlick = [&](float f0) { return f0 + (1 - f0) * std::pow(1 - cos, 5.f); };
          const float error = std::abs(fresnel_dielectric(cos, 1.5f) - schlick(0.04f));
          EXPECT_NEAR(drawn->weight[c] / specular, schlick(straight), 1.05f * error + 1e-3f) << colour[c] << " " << cos;
        }
      }
    }
}

// Rough facets, too: what they mirror straight on grows as F0 x colour, up to a mirror.
TEST(Principled, RoughFacetsMirrorTheSpecularColour) {
  const auto mirrored = [](float colour) {
    const auto paint =
        make("principled", {number("roughness", 0.2f), rgb("basecolor", Rgb(0)), rgb("specularcolor", Rgb(colour))});
    BsdfSlot slot;
    return paint->bsdf(surface(), slot).evaluate({0, 0, 1}, {0, 0, 1}, Transport::radiance, 1)[0];
  };
  const float usual = mirrored(1);
  EXPECT_NEAR(mirrored(5.441f) / usual, 5.441f, 0.01f);
  EXPECT_NEAR(mirrored(25) / usual, 25, 0.02f);
  EXPECT_NEAR(mirrored(300) / usual, 25, 0.02f);
}

// A highlight that is turned by 90 degrees is that of exchanged axes.
TEST(Principled, RotationTurnsHighlights) {
  const std::vector<Param> brushed{number("metallic", 1), number("roughness", 0.6f), number("anisotropy", 0.9f)};
  std::vector<Param> turned = brushed;
  turned.push_back(number("anisotropyrotation", 90));
  const auto a = make("principled", brushed), b = make("principled", turned);
  BsdfSlot slots[2];
  const Bsdf &along = a->bsdf(surface(), slots[0]), &across = b->bsdf(surface(), slots[1]);
  const auto quarter = [](const Vec3& w) { return Vec3{-w.y, w.x, w.z}; };
  const PathRandom random(5, Stream::setup, 15, 0);
  for (int n = 0; n < 200; ++n) {
    Vec3 wo = any_direction(random, n), wi = any_direction(random, 5000 + n);
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    const float expected = along.evaluate(wo, wi, Transport::radiance, 1)[1];
    EXPECT_NEAR(across.evaluate(quarter(wo), quarter(wi), Transport::radiance, 1)[1], expected,
                1e-3f * expected + 1e-5f);
  }
}

// Towards the side to which v grows, whatever the handedness of the coordinates.
TEST(Principled, RotationGoesTowardsTheSecondTangent) {
  const auto brushed = make("principled", {number("metallic", 1), number("roughness", 0.6f), number("anisotropy", 0.9f),
                                           number("anisotropyrotation", 45)});
  SurfacePoint point = surface(), mirrored = point;
  const Basis basis = Basis::around(point.ns, point.dpdu);
  point.dpdv = basis.y, mirrored.dpdv = -basis.y;
  BsdfSlot slots[2];
  const Bsdf &one = brushed->bsdf(point, slots[0]), &other = brushed->bsdf(mirrored, slots[1]);
  const auto f = [&](const Bsdf& bsdf, float y) {
    const Vec3 across = normalize(basis.x + basis.y * y);
    return bsdf.evaluate(normalize(point.ns + across * 0.8f), point.ns, Transport::radiance, 1)[1];
  };
  EXPECT_GT(f(one, 1), 1.5f * f(one, -1));
  EXPECT_NEAR(f(other, -1), f(one, 1), 1e-3f * f(one, 1));
}

// Facets of metal reflect the base colour straight on and white light at grazing angles.
TEST(Principled, MetalHasSchlicksFresnelTerm) {
  const auto metal =
      make("principled", {number("metallic", 1), number("roughness", 0), rgb("basecolor", {0.9f, 0.5f, 0.1f})});
  BsdfSlot slot;
  const Bsdf& bsdf = metal->bsdf(surface(), slot);
  EXPECT_EQ(static_cast<int>(bsdf.all_lobes()), 1);
  for (const float cos : {1.f, 0.5f, 0.05f}) {
    const float edge = std::pow(1 - cos, 5.f);
    const auto drawn = bsdf.sample(direction(cos, 1), {}, Transport::flux, 1);
    ASSERT_TRUE(drawn && drawn->specular);
    EXPECT_NEAR(drawn->weight[0], 0.9f + 0.1f * edge, 1e-3f);
    EXPECT_NEAR(drawn->weight[2], 0.1f + 0.9f * edge, 1e-3f);
  }
}

TEST(Principled, LobesByRoughness) {
  const auto lobes = [](std::vector<Param> params, float least_alpha) {
    BsdfSlot slot;
    return static_cast<int>(make("principled", std::move(params))->bsdf(surface(), slot).lobes(least_alpha));
  };
  EXPECT_EQ(lobes({}, 0), 5);
  EXPECT_EQ(lobes({number("roughness", 0.6f)}, 0.35f), 5);
  EXPECT_EQ(lobes({number("roughness", 0.6f)}, 0.37f), 4);
  EXPECT_EQ(lobes({number("transmission", 1), number("roughness", 0)}, 0), 3);
  EXPECT_EQ(lobes({number("transmission", 1), number("roughness", 0)}, 1e-3f), 0);
  EXPECT_EQ(lobes({number("coat", 1), number("coatroughness", 0.5f)}, 0.2f), 13);
}

// Frames with other colours stay one path: they draw the same directions with the same densities.
TEST(Principled, ColoursDrawAlike) {
  const auto plastic = [](Spectrum base) { return make("principled", {rgb("basecolor", base), number("coat", 0.5f)}); };
  const auto red = plastic({0.8f, 0.1f, 0.1f}), blue = plastic({0.1f, 0.2f, 0.7f});
  BsdfSlot slots[2];
  const Bsdf &a = red->bsdf(surface(), slots[0]), &b = blue->bsdf(surface(), slots[1]);
  const PathRandom random(5, Stream::setup, 13, 0);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 wo = direction(0.1f + 0.0009f * static_cast<float>(n), 2), u = three_numbers(random, n);
    const auto first = a.sample(wo, u, Transport::radiance, a.all_lobes()),
               second = b.sample(wo, u, Transport::radiance, b.all_lobes());
    ASSERT_EQ(first.has_value(), second.has_value());
    if (!first) continue;
    EXPECT_EQ(first->wi, second->wi);
    EXPECT_EQ(first->pdf_w, second->pdf_w);
  }
  const auto ratio = a.ratio_to(b, 4);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio.value()[1], 0.5f, 1e-3f);
  EXPECT_FALSE(a.ratio_to(b, 5));
}

}  // namespace
}  // namespace dspm::test
