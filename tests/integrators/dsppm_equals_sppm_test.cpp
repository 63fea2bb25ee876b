// The main promise: frame j of a K-frame dsppm run is what sppm gives for frame j alone, after every iteration. Counts
// and radii are equal, sums to 1e-5.
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/random_scene.h"
#include "tests/support/seeds.h"

namespace dspm {
namespace dsppm_equals_sppm_test {

using test::RandomScene;
using test::seeds;
using test::TestScene;

constexpr int kIterations = 3;
constexpr float kTolerance = 1e-5f;

bool near(float a, float b, float scale) {
  return std::abs(a - b) <= kTolerance * std::max(scale, std::max(std::abs(a), std::abs(b)));
}

bool same(const Rgb& a, const Rgb& b) {
  const float scale = std::max(max_component(a), max_component(b));
  return near(a.r, b.r, scale) && near(a.g, b.g, scale) && near(a.b, b.b, scale);
}

struct Comparison {
  int pixels = 0, differing = 0, lit = 0, found = 0;
  Statistics together, alone;  // alone: sums over the frames
};

/// What a joint run says that separate ones would do, against what they did.
void expect_counted(const Comparison& c, bool equal_radii) {
  const auto expect_equal = [](const SharedCount& told, const SharedCount& counted) {
    EXPECT_EQ(counted.done, counted.separate);
    EXPECT_EQ(told.separate, counted.done);
  };
  expect_equal(c.together.camera.segments, c.alone.camera.segments);
  expect_equal(c.together.photon.segments, c.alone.photon.segments);
  expect_equal(c.together.photons_stored, c.alone.photons_stored);
  expect_equal(c.together.gathers, c.alone.gathers);
  if (equal_radii)
    expect_equal(c.together.photons_found, c.alone.photons_found);
  else
    EXPECT_GE(c.together.photons_found.separate, c.alone.photons_found.done);
}

/// Every frame of a joint run against the frame's own run, after every iteration.
Comparison compare(TestScene& test) {
  Comparison result;
  const auto together = test.scene(test.all_frames());
  const auto dsppm = test.integrator(*together, "dsppm");
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<std::unique_ptr<Integrator>> sppm;
  for (const FileFrame f : test.all_frames()) {
    scenes.push_back(test.scene({f}));
    sppm.push_back(test.integrator(*scenes.back(), "sppm"));
  }
  for (int i = 0; i < kIterations; ++i) {
    dsppm->iterate({i, *together});
    for (const FileFrame f : test.all_frames()) {
      Integrator& alone = *sppm[f.slot()];
      alone.iterate({i, *scenes[f.slot()]});
      const Image a = dsppm->estimate(f.index()), b = alone.estimate(0);
      const Image found = dsppm->estimate(f.index(), "photons"), found_alone = alone.estimate(0, "photons");
      const Image radius = dsppm->estimate(f.index(), "radius"), radius_alone = alone.estimate(0, "radius");
      for (int p = 0; p < static_cast<int>(a.pixels.size()); ++p) {
        const auto at = static_cast<std::size_t>(p);
        ++result.pixels;
        result.lit += !is_black(b.pixels[at]);
        result.found += !is_black(found.pixels[at]);
        result.differing += !(same(a.pixels[at], b.pixels[at]) && found.pixels[at] == found_alone.pixels[at] &&
                              radius.pixels[at] == radius_alone.pixels[at]);
      }
    }
  }
  result.together = dsppm->statistics();
  for (const auto& each : sppm) {
    const Statistics s = each->statistics();
    result.alone.camera += s.camera, result.alone.photon += s.photon, result.alone.photons_stored += s.photons_stored;
    result.alone.gathers += s.gathers, result.alone.photons_found += s.photons_found;
  }
  return result;
}

class DsppmEqualsSppm : public ::testing::TestWithParam<int> {};

TEST_P(DsppmEqualsSppm, OnRandomScenes) {
  Comparison sum;
  const int frames = GetParam();
  const int scenes = frames > 16 ? 4 : seeds(16);
  for (int i = 0; i < scenes; ++i) {
    const unsigned seed = static_cast<unsigned>(1000 * frames + i);
    const char* estimator = i % 4 == 3 ? "kz11" : "hj09";
    const bool go_on = i % 8 == 7;  // then photons may bring little
    const std::string text =
        RandomScene(seed, frames)
            .text(fmt::format(
                "Integrator \"dsppm\" \"integer photons\" 3000 \"integer maxdepth\" 6 \"string direct\" \"{}\" "
                "\"string estimator\" \"{}\" \"bool sharepaths\" {} \"integer seed\" {} \"string indirect\" \"{}\"",
                i % 3 == 2   ? "sampled"
                : i % 3 == 1 ? "photons"
                             : "both",
                estimator, i % 5 != 4, i, go_on ? "paths" : "photons"));
    SCOPED_TRACE(text);
    Choices choices;
    choices.outputs = {"radius", "photons"};
    TestScene test(text, choices);
    const Comparison one = compare(test);
    EXPECT_EQ(one.differing, 0);
    EXPECT_GT(one.found, go_on ? 0 : one.pixels / 4);
    EXPECT_GT(one.lit, one.pixels / 4);
    expect_counted(one, i % 4 == 3);
    sum.pixels += one.pixels, sum.differing += one.differing;
  }
  RecordProperty("pixels", sum.pixels);
  RecordProperty("differing", sum.differing);
}

TEST(Kz11, FramesEqualTheirOwnRuns) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::string text =
        RandomScene(500 + seed, 6).text(R"(Integrator "dsppm" "integer photons" 3000 "string estimator" "kz11")");
    SCOPED_TRACE(text);
    TestScene test(text);
    const auto scene = test.scene(test.all_frames());
    const auto together = test.integrator(*scene);
    for (int i = 0; i < kIterations; ++i) together->iterate({i, *scene});
    for (const FileFrame f : test.all_frames()) {
      const Image a = together->estimate(f.index()), b = test.render(f, kIterations);
      for (std::size_t p = 0; p < a.pixels.size(); ++p) EXPECT_TRUE(same(a.pixels[p], b.pixels[p]));
    }
  }
}

// Frames of a path tracer, too, are those of their own runs.
TEST(Path, FramesEqualTheirOwnRuns) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const std::string text = RandomScene(700 + seed, 4).text(R"(Integrator "path" "integer maxdepth" 8)");
    SCOPED_TRACE(text);
    TestScene test(text);
    const auto scene = test.scene(test.all_frames());
    const auto together = test.integrator(*scene);
    for (int i = 0; i < kIterations; ++i) together->iterate({i, *scene});
    for (const FileFrame f : test.all_frames()) EXPECT_EQ(together->estimate(f.index()), test.render(f, kIterations));
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, DsppmEqualsSppm, ::testing::Values(1, 2, 5, 8, 33));

}  // namespace dsppm_equals_sppm_test
}  // namespace dspm
