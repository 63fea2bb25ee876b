// What rays are compared on: those of a render, and Embree that answers as dspm's trees do.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/measure/bare_embree.h"
#include "bench/measure/recorded_rays.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace rays_test {

// A whole sphere, a part of one, two meshes of which a transform places one.
const char* const kScene = R"(
LookAt 0 1 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 50
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
WorldBegin
LightSource "point" "point3 from" [1 4 -2]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-3 -1 -3  -3 -1 3  3 -1 3  3 -1 -3]
AttributeBegin Translate -1 0 0 Shape "sphere" "float radius" 0.5 AttributeEnd
AttributeBegin Translate 1 0 0 Shape "sphere" "float radius" 0.7 "float zmax" 0.2 AttributeEnd
ObjectBegin "roof" Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [-1 0 0  1 0 0  0 0.3 1] ObjectEnd
AttributeBegin Translate 0 0.5 1 ObjectInstance "roof" AttributeEnd
AttributeBegin Translate 0 1.5 1 Rotate 40 1 0 0 ObjectInstance "roof" AttributeEnd
)";

struct Recorded {
  test::TestScene test;
  Run run;
  RecordedRays rays;

  explicit Recorded(const std::string& integrator, std::size_t most = 100'000)
      : test("Integrator " + integrator + kScene) {
    run.scene = test.scene(test.all_frames());
    run.integrator = test.integrator(*run.scene);
    rays = record(run, 0, most);
  }
};

TEST(RecordedRays, AreThoseOfAnIteration) {
  const Recorded recorded(
      R"("sppm" "string emission" "power" "integer photons" 500 "string direct" "sampled" "string indirect" "photons")");
  const Statistics s = recorded.run.integrator->statistics();
  EXPECT_EQ(recorded.rays.nearest.size(), s.camera.segments.done + s.photon.segments.done);
  EXPECT_EQ(recorded.rays.shadow.size(), s.camera.shadow_rays);
  EXPECT_GE(recorded.rays.nearest.size(), 24u * 16u);
  EXPECT_EQ(Recorded(R"("path")", 100).rays.nearest.size(), 100u);
}

TEST(BareEmbree, MeetsWhatTheTreesMeet) {
  const Recorded recorded(R"("path")");
  const BareEmbree embree(recorded.run.scene->shapes);
  const Accel& accel = *recorded.run.scene->accel;
  int hits = 0, blocked = 0, apart = 0;
  for (const AskedRay& asked : recorded.rays.nearest) {
    const float ours = accel.partition(asked.ray, asked.frames)[0].hit.t, theirs = embree.nearest(asked.ray);
    hits += ours < kInfinity;
    apart += ours != theirs && !(std::abs(ours - theirs) <= 1e-4f * theirs);
  }
  for (const AskedRay& asked : recorded.rays.shadow) {
    const bool ours = !accel.occluded(asked.ray, asked.frames).empty();
    blocked += ours;
    apart += ours != embree.occluded(asked.ray);
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(blocked, 10);
  EXPECT_LE(apart, 2);  // rays along edges
}

}  // namespace rays_test
}  // namespace dspm
