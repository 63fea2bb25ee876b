// Renders that have gone on for very long: counters that start high go beyond 32 bits, and change no pixel.
#include <gtest/gtest.h>

#include <string>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace long_counters_test {

constexpr std::uint64_t kHigh = (std::uint64_t{1} << 32) - 100;

constexpr const char* kScene = R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin
LightSource "point" "point3 from" [0 2 -1] "rgb I" [8 8 8]
AttributeBegin
  Translate 0 0 30
  Shape "sphere" "float radius" 29
AttributeEnd
)";

class LongCounters : public ::testing::TestWithParam<const char*> {};

TEST_P(LongCounters, GoBeyond32Bits) {
  TestScene test(std::string("Integrator ") + GetParam() + kScene);
  const auto scene = test.scene({FileFrame(0)});
  const auto young = test.integrator(*scene), old = test.integrator(*scene);
  young->iterate({0, *scene});

  Statistics few = young->statistics();
  few.steps.pop_back();  // that of the error estimate, which keeps it itself
  Statistics many = few;
  for (std::uint64_t* count : {&many.camera.paths, &many.camera.segments.done, &many.photon.paths,
                               &many.photon.segments.separate, &many.photons_stored.done, &many.photon_tests})
    *count += kHigh;
  const std::string saved = state_of(many) + state_of(*young).substr(state_of(few).size());
  LoadedState state(saved);
  ASSERT_TRUE(old->persist(state));
  young->iterate({1, *scene}), old->iterate({1, *scene});

  EXPECT_EQ(old->estimate(0), young->estimate(0));
  const Statistics now = old->statistics(), then = young->statistics();
  EXPECT_GT(now.camera.paths, std::uint64_t{1} << 32);
  EXPECT_EQ(now.camera.paths, then.camera.paths + kHigh);
  EXPECT_EQ(now.camera.segments.done, then.camera.segments.done + kHigh);
  EXPECT_EQ(now.photon.paths, then.photon.paths + kHigh);
  EXPECT_EQ(now.photon.segments.separate, then.photon.segments.separate + kHigh);
  EXPECT_EQ(now.photons_stored.done, then.photons_stored.done + kHigh);
  EXPECT_EQ(now.photon_tests, then.photon_tests + kHigh);
}

std::string name_of(const ::testing::TestParamInfo<const char*>& info) { return "Case" + std::to_string(info.index); }
INSTANTIATE_TEST_SUITE_P(Integrators, LongCounters,
                         ::testing::Values("\"dsppm\" \"integer photons\" 5000",
                                           "\"dsppm\" \"integer photons\" 5000 \"string estimator\" \"hj09\"",
                                           "\"sppm\" \"integer photons\" 5000",
                                           "\"photonmap\" \"integer photons\" 5000",
                                           "\"photonmap\" \"integer photons\" 5000 \"integer finalgather\" 2",
                                           "\"path\""),
                         name_of);

}  // namespace long_counters_test
}  // namespace dspm::test
