// Vertex connection and merging knows where the guide starts light paths: both ends of a path tell the same densities.
#include "dspm/integrators/methods/vcm/light_densities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/guiding/emission_tree.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace light_densities_test {

constexpr const char* kRoom = R"(
LookAt 0 0 1  0 0 0  0 1 0
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
LightSource "infinite" "rgb L" [1 2 3]
LightSource "point" "rgb I" [3 2 1] "point3 from" [0 0 2]
LightSource "spot" "rgb I" [3 2 1] "point3 from" [1 0 2] "point3 to" [0 0 0] "float coneangle" 40
LightSource "distant" "rgb L" [1 1 1] "point3 from" [1 2 3] "point3 to" [0 0 0]
LightSource "distant" "rgb L" [1 1 1] "point3 from" [1 2 3] "point3 to" [0 0 0] "float angle" 20
AttributeBegin
  Translate 0 1 2 Rotate 180 1 0 0 AreaLightSource "diffuse" "rgb L" [4 4 4] Shape "disk" "float radius" .3
AttributeEnd
AttributeBegin
  Translate 0 -1 2 AreaLightSource "diffuse" "rgb L" [4 4 4] "bool twosided" true
  Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 1 0 .2 0 1 0]
AttributeEnd
Material "diffuse" Shape "disk" "float radius" 2
)";

EmissionGuides some_guides(const Scene& scene) {
  std::vector<EmissionRecord> records;
  for (int i = 0; i < 3000; ++i) {
    const PathRandom random(1, Stream::setup, static_cast<std::uint64_t>(i), 0);
    const Vec2 a = random.pair(0, 0), b = random.pair(0, 1);
    records.push_back({i * static_cast<int>(scene.lights.size()) / 3000, {a.x * a.x, a.y, b.x, b.y * b.y}, 1. + i % 3});
  }
  return {{guide_from(records, scene.light_choices.front().probability())}};
}

// What a light subpath holds for a shadow ray in its place is the inverse of what a shadow ray holds for it, and what
// it holds for a hit is the cosine at the light over the density that the hit holds for it.
TEST(LightDensities, AreTheSameFromBothEnds) {
  const TestScene test(kRoom);
  const auto scene = test.scene({FileFrame(0)});
  const EmissionGuides guides = some_guides(*scene);
  ASSERT_FALSE(guides.are_off());
  const RenderSettings& render = test.job().settings;
  const VcmSettings settings;
  for (const EmissionGuides* used : {static_cast<const EmissionGuides*>(nullptr), &guides}) {
    const VcmPass pass{*scene, render, settings, 0, 0, 0, {}, used};
    int tried = 0, same = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) {
      const PathRandom random(2, Stream::photon, i, 0);
      const EmissionStart chosen = start_of(used, *scene, 0, random);
      const SceneLight& light = scene->lights[static_cast<std::size_t>(chosen.light)];
      const Light& state = *light.states.states.at(0).object;
      const EmissionNumbers& n = chosen.numbers;
      const auto e = state.emit({n[0], n[1]}, {n[2], n[3]});
      if (!e) continue;
      const Vec2 u = random.pair(1, 0);
      const float distance = 0.5f + 3 * u.x;
      SurfacePoint point{};
      point.p = e->ray.at(distance), point.ng = point.ns = normalize(Vec3{u.x, u.y, 0.3f});
      const LightStart start{e->ray, e->normal, e->primitive};
      const Vec3& w = e->ray.direction;
      const float cosine = std::abs(dot(point.ng, w));
      if (cosine < 0.05f || (!light.is_delta && !state.is_infinite() && std::abs(dot(e->normal, w)) < 0.05f)) continue;
      // The numbers that were drawn have one density, and their start tells it, but at the edges of cells. Of a light
      // that does not use all numbers, the start tells the mean over the others.
      const float emitted = emission_density(pass, light, state, start, e->pdf);
      const float drawn = chosen.density * e->pdf.position * e->pdf.direction;
      const EmissionNumbers told = state.emission_numbers(e->ray, e->normal, e->primitive);
      if (used == nullptr || std::find(told.begin(), told.end(), kAnyNumber) == told.end())
        ++tried, same += std::abs(emitted - drawn) <= 1e-3f * drawn;

      Illumination lit{-w, distance, Rgb(1), 0, e->normal, e->primitive};
      if (is_parallel(state, e->pdf)) lit.distance = kInfinity;
      if (!light.is_delta) lit.pdf_w = pdf_w_of(state, start, point.p);
      const float pdf_w = light.is_delta ? 0 : light_samples(*scene, light, receiver_at(point)) * lit.pdf_w;
      const float of_shadow_ray = emission_over_next_event(pass, {light, state, lit, pdf_w}, receiver_at(point),
                                                           std::abs(dot(lit.wi, point.ng)));
      const SubpathWeights sums =
          weights_at_first_vertex(pass, light, state, *e, receiver_at(point), distance * distance, cosine);
      EXPECT_NEAR(sums.vcm * of_shadow_ray, 1, 2e-3f) << "light " << chosen.light << ", " << (used != nullptr);
      const float at_light = light.is_delta ? 0 : state.is_infinite() ? 1 : std::abs(dot(e->normal, w));
      EXPECT_NEAR(sums.vc * emitted * cosine, at_light, 1e-3f);
    }
    EXPECT_GT(tried, 1000);
    EXPECT_GT(same, 0.99 * tried);
  }
}

}  // namespace light_densities_test
}  // namespace dspm::test
