// Photons, shadow rays and scattered rays share direct light: their weights add up to 1, and rays are traced only where
// they pay.
#include "dspm/integrators/photons/direct_balance.h"

#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/guiding/emission_tree.h"
#include "dspm/integrators/guiding/learn_direct.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace direct_balance_test {

constexpr const char* kLamps = R"(
LightSource "point" "rgb I" [3 2 1] "point3 from" [0 0 2]
LightSource "spot" "rgb I" [3 2 1] "point3 from" [1 0 2] "point3 to" [0 0 0] "float coneangle" 40
LightSource "distant" "rgb L" [1 1 1] "point3 from" [1 2 3] "point3 to" [0 0 0]
AttributeBegin
  Translate 0 1 2 Rotate 180 1 0 0 AreaLightSource "diffuse" "rgb L" [4 4 4] Shape "disk" "float radius" .3
AttributeEnd
AttributeBegin
  Translate 0 -1 2 AreaLightSource "diffuse" "rgb L" [4 4 4] "bool twosided" true
  Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 1 0 .2 0 1 0]
AttributeEnd
)";

std::string room(const char* lights) {
  return std::string(R"(
Integrator "dsppm"
LookAt 0 0 1  0 0 0  0 1 0
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
)") + lights +
         "Material \"diffuse\" Shape \"disk\" \"float radius\" 2\n";
}

EmissionGuides some_guides(const Scene& scene) {
  std::vector<EmissionRecord> records;
  for (int i = 0; i < 3000; ++i) {
    const PathRandom random(1, Stream::setup, static_cast<std::uint64_t>(i), 0);
    const Vec2 a = random.pair(0, 0), b = random.pair(0, 1);
    records.push_back({i * static_cast<int>(scene.lights.size()) / 3000, {a.x * a.x, a.y, b.x, b.y * b.y}, 1. + i % 3});
  }
  return {{guide_from(records, scene.light_choices.front().probability())}};
}

/// The weights of the light that starts like that and arrives at the place, or a negative number if its light is black
/// there.
float sum_of_weights(const DirectBalance& balance, const SceneLight& light, const Light& state, const LightStart& start,
                     const DirectBalance::Place& place) {
  Illumination lit{-start.ray.direction, length(place.p - start.ray.origin), Rgb(1), 0, start.normal, start.primitive};
  if (state.is_infinite()) {
    lit.distance = kInfinity, lit.pdf_w = state.escaped_pdf_w({place.p, lit.wi});
  } else if (!light.is_delta) {
    SurfacePoint point{};
    point.p = start.ray.origin, point.ng = point.ns = start.normal;
    lit.pdf_w = state.pdf_w(place.p, point, start.primitive);
  } else if (state.pdf_emit(start.ray, start.normal, start.primitive).delta_direction) {
    lit.distance = kInfinity;
  }
  float sum = balance.weight_of_photon(light, state, start, place) +
              balance.weight_of_sample({light, state, lit, lit.pdf_w}, place);
  if (!light.is_delta) sum += balance.weight_of_scattered(light, state, start, place);
  return sum;
}

TEST(DirectBalance, WeightsAddUpToOne) {
  for (const std::string& sky : {std::string(), std::string("LightSource \"infinite\" \"rgb L\" [1 2 3]\n")}) {
    const TestScene test(room((sky + kLamps).c_str()));
    const auto scene = test.scene({FileFrame(0)});
    const EmissionGuides guides = some_guides(*scene);
    for (const DirectWays& ways :
         {DirectWays{}, DirectWays{20'000, nullptr, 0.05f, 3}, DirectWays{30'000, &guides, 0.05f, 2}}) {
      const DirectBalance balance(*scene, ways);
      EXPECT_EQ(balance.scatters(), !sky.empty());
      int shared = 0;
      for (const SceneLight& light : scene->lights)
        for (int i = 0; i < 300; ++i) {
          const PathRandom random(2, Stream::setup, static_cast<std::uint64_t>(i), 0);
          const Light& state = *light.states.states.at(0).object;
          const auto e = state.emit(random.pair(0, 0), random.pair(0, 1));
          if (!e) continue;
          const Vec2 u = random.pair(0, 2);
          const DirectBalance::Place place{e->ray.at(0.5f + 3 * u.x), normalize(Vec3{u.x, u.y, 0.3f})};
          const LightStart start{e->ray, e->normal, e->primitive};
          EXPECT_NEAR(sum_of_weights(balance, light, state, start, place), 1, 1e-4f)
              << "light " << &light - scene->lights.data();
          const float weight = balance.weight_of_photon(light, state, start, place);
          EXPECT_TRUE(weight >= 0 && weight <= 1);
          EXPECT_TRUE(ways.photons > 0 || weight == 0);
          shared += weight > 0.05f && weight < 0.95f ? 1 : 0;
        }
      EXPECT_TRUE(ways.photons == 0 || shared > 100) << shared;
    }
  }
}

/// A lamp that is nearly a point.
std::string lamp(const char* z) {
  return std::string("AttributeBegin Translate .1 0 ") + z +
         " Rotate 180 1 0 0 AreaLightSource \"diffuse\" Shape \"disk\" \"float radius\" .003 AttributeEnd\n";
}

LearnedDirect learned(const std::string& text, int photons) {
  const TestScene test(text);
  const auto scene = test.scene({FileFrame(0)});
  const RenderSettings render = test.job().settings;
  HitPointSettings settings;
  settings.sample_direct = true;
  std::size_t bytes = 0;
  return learn_direct(*scene, render, settings, photons, EmissionGuides(), bytes);
}

// With nothing in its way, a shadow ray finds all of its light.
TEST(LearnedDirect, OneLampIsFoundByRays) {
  const std::string text = room(lamp("1").c_str());
  EXPECT_GT(learned(text, 1000).photons_a_ray, 20);
  EXPECT_TRUE(learned(text, 1000).by_rays);
  EXPECT_FALSE(learned(text, 10'000'000).by_rays);
}

// However many photons there are, they would only blur its shadows.
TEST(LearnedDirect, APointIsLeftToRays) {
  EXPECT_TRUE(learned(room("LightSource \"point\" \"point3 from\" [0 0 1]\n"), 10'000'000).by_rays);
}

// Of two equal lamps, one is hidden, and every other ray goes to it: of two samples that are not both 0, a third are
// both 2, and the others are 2 and 0, with a relative variance of 2.
TEST(LearnedDirect, LampsBehindAWallTakeMoreRays) {
  const std::string lamps = lamp("1") + lamp("1.02") + R"(
Translate 0 0 1.01 Material "diffuse" Shape "disk" "float radius" 50
Translate 0 0 -1.01
)";
  EXPECT_NEAR(learned(room(lamps.c_str()), 1000).photons_a_ray, 0.75, 0.1);
}

}  // namespace direct_balance_test
}  // namespace dspm::test
