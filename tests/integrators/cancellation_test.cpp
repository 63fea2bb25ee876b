// An iteration that is given up has changed nothing: tried again, it gives the same bits.
#include "dspm/base/system/cancellation.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/session/revertible.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace cancellation_test {

constexpr const char* kScene = R"(
Frames 2
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 160 "integer yresolution" 120
WorldBegin
LightSource "point" "point3 from" [0 2 -1] "rgb I" [8 8 8]
AttributeBegin
  Translate 0 0 30
  Shape "sphere" "float radius" 29
AttributeEnd
DynamicBegin "ball"
  Keyframe 1  Translate -1 0 0
  Keyframe 2  Translate 1 0 0
  KeyframeEnd
  Material "dielectric"
  Shape "sphere" "float radius" 0.4
DynamicEnd
)";

/// Whether it was given up.
bool iterate_for(std::chrono::microseconds time, Integrator& integrator, int iteration, const Scene& scene) {
  allow_work();
  std::thread impatient([&] {
    std::this_thread::sleep_for(time);
    cancel_work();
  });
  bool cancelled = false;
  try {
    iterate_revertibly(integrator, {iteration, scene});
  } catch (const Cancelled&) {
    cancelled = true;
  }
  impatient.join();
  allow_work();
  return cancelled;
}

class Cancellation : public ::testing::TestWithParam<const char*> {};

TEST_P(Cancellation, ChangesNothing) {
  TestScene test(std::string("Integrator ") + GetParam() + kScene);
  const auto scene = test.scene(test.intervals().front());
  const auto calm = test.integrator(*scene), given_up = test.integrator(*scene);
  for (const int iteration : {0, 1}) {  // the first one makes what the others share
    int cancelled = 0;
    for (int i = 0; i < 15; ++i) {
      const std::string before = state_of(*given_up);
      if (!iterate_for(std::chrono::microseconds(500 * i), *given_up, iteration, *scene)) break;
      ++cancelled;
      ASSERT_EQ(state_of(*given_up), before);
    }
    EXPECT_GT(cancelled, 1);
    if (given_up->statistics().iterations == iteration) given_up->iterate({iteration, *scene});
  }
  while (given_up->statistics().iterations < 3) given_up->iterate({given_up->statistics().iterations, *scene});
  for (int i = 0; i < 3; ++i) calm->iterate({i, *scene});
  for (Frame frame = 0; frame < scene->frame_count(); ++frame)
    EXPECT_EQ(given_up->estimate(frame), calm->estimate(frame));
}

/// What it says that it needs: as many batches of photons as there may be.
std::size_t least_memory(TestScene& test, const Scene& scene) {
  try {
    test.integrator(scene, {}, 1);
  } catch (const NotEnoughMemory& error) {
    return error.least.total();
  }
  return 0;
}

class CancellationBetweenBatches : public ::testing::TestWithParam<const char*> {};

// Photons were gathered by then, but where it was during the first of sixteen batches.
TEST_P(CancellationBetweenBatches, ChangesNothing) {
  TestScene test(std::string("Integrator ") + GetParam() + kScene);
  const auto scene = test.scene(test.intervals().front());
  const std::size_t memory = least_memory(test, *scene);
  const auto calm = test.integrator(*scene, {}, memory), given_up = test.integrator(*scene, {}, memory);
  ASSERT_EQ(given_up->statistics().photon_batches, 16);
  constexpr int kMoments = 12;
  for (const int iteration : {0, 1}) {  // before the first one there is nothing to keep
    const auto begin = std::chrono::steady_clock::now();
    calm->iterate({iteration, *scene});
    const std::chrono::duration<double, std::micro> duration = std::chrono::steady_clock::now() - begin;
    int cancelled = 0;
    const std::string before = state_of(*given_up);
    while (cancelled < kMoments) {
      const auto moment = std::chrono::duration_cast<std::chrono::microseconds>(duration * cancelled / kMoments);
      if (!iterate_for(moment, *given_up, iteration, *scene)) break;
      ++cancelled;
      ASSERT_EQ(state_of(*given_up), before);
    }
    EXPECT_GE(cancelled, kMoments / 4);
    if (given_up->statistics().iterations == iteration) given_up->iterate({iteration, *scene});
  }
  for (Frame frame = 0; frame < scene->frame_count(); ++frame)
    EXPECT_EQ(given_up->estimate(frame), calm->estimate(frame));
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, CancellationBetweenBatches,
    ::testing::Values(
        R"("dsppm" "string emission" "power" "string direct" "photons" "integer photons" 100000)",
        R"("dsppm" "string emission" "power" "string direct" "photons" "integer photons" 100000 "string estimator" "hj09")",
        R"("sppm" "string emission" "power" "string direct" "photons" "integer photons" 100000)",
        R"("sppm" "string emission" "power" "string direct" "photons" "integer photons" 100000 "string estimator" "hj09")"));

INSTANTIATE_TEST_SUITE_P(
    Integrators, Cancellation,
    ::testing::Values(R"("dsppm" "integer photons" 30000)", R"("sppm" "integer photons" 30000)",
                      R"("path" "integer maxdepth" 20)",
                      R"("photonmap" "integer photons" 30000 "integer causticphotons" 30000)",
                      R"("photonmap" "integer photons" 30000 "integer causticphotons" 3000 "integer finalgather" 2)",
                      R"("vcm" "integer photons" 30000)"));

}  // namespace cancellation_test
}  // namespace dspm::test
