// An iteration that is given up has changed nothing: tried again, it gives the same bits.
#include "core/cancellation.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "testing/state_bytes.h"
#include "testing/test_scene.h"

namespace dspm::test {
namespace {

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
bool iterate_for(std::chrono::microseconds time, Integrator& integrator, int iteration) {
  allow_work();
  std::thread impatient([&] {
    std::this_thread::sleep_for(time);
    cancel_work();
  });
  bool cancelled = false;
  try {
    integrator.iterate(iteration);
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
    for (int i = 0; i < 30; ++i) {
      const std::string before = state_of(*given_up);
      if (!iterate_for(std::chrono::microseconds(500 * i), *given_up, iteration)) break;
      ++cancelled;
      ASSERT_EQ(state_of(*given_up), before);
    }
    EXPECT_GT(cancelled, 1);
    if (given_up->statistics().iterations == iteration) given_up->iterate(iteration);
  }
  while (given_up->statistics().iterations < 3) given_up->iterate(given_up->statistics().iterations);
  for (int i = 0; i < 3; ++i) calm->iterate(i);
  for (Frame frame = 0; frame < scene->frame_count(); ++frame)
    EXPECT_EQ(given_up->estimate(frame), calm->estimate(frame));
}

INSTANTIATE_TEST_SUITE_P(Integrators, Cancellation,
                         ::testing::Values(R"("dsppm" "integer photons" 30000)", R"("sppm" "integer photons" 30000)",
                                           R"("path" "integer maxdepth" 20)",
                                           R"("photonmap" "integer photons" 30000 "integer causticphotons" 30000)"));

}  // namespace
}  // namespace dspm::test
