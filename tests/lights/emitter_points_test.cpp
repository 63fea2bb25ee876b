// Points of a shape whose brightness is measured at once, or when the first of them is drawn.
#include "dspm/lights/emitter_points.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/lights/lamps.h"
#include "tests/lights/random.h"

namespace dspm {
namespace {

using namespace dspm::test;
using Measured = EmitterPoints::Measured;

TEST(EmitterPoints, DeferredOnesAreTheSameForASixteenthOfTheSamples) {
  const AreaLamp lamp = make_lamp("mesh", unequal_mesh(), Matrix4());
  std::atomic<int> samples = 0;
  const auto brightness = [&](const SurfacePoint& point) {
    ++samples;
    return Rgb(1, .5f, .1f) * (1 + std::sin(9 * point.p.x) * std::cos(7 * point.p.y));
  };
  const EmitterPoints at_once(*lamp.placed, brightness, Measured::at_once);
  const int of_all = samples.exchange(0);
  const EmitterPoints deferred(*lamp.placed, brightness, Measured::deferred);
  EXPECT_EQ(samples * 16, of_all);
  EXPECT_NEAR(deferred.total().g / at_once.total().g, 1, 0.01f);
  Sequence random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u = random.pair();
    const EmitterPoints::Start a = at_once.sample(u), b = deferred.sample(u);
    EXPECT_EQ(a.point.p, b.point.p);
    EXPECT_EQ(a.pdf_a, b.pdf_a);
    EXPECT_EQ(deferred.pdf_a(b.primitive, b.point.p, b.point.ng), at_once.pdf_a(a.primitive, a.point.p, a.point.ng));
  }
  EXPECT_EQ(samples, of_all / 16 + of_all);  // measured once
}

}  // namespace
}  // namespace dspm
