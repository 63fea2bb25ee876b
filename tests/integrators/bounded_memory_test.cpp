// What an integrator does with less memory than it would take: the same in smaller batches of photons, as long as that
// helps; then it says what it needs.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/methods/pixel_statistics.h"
#include "dspm/integrators/photons/memory_needs.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/random_scene.h"

namespace dspm {
namespace bounded_memory_test {

using test::RandomScene;
using test::TestScene;

constexpr int kFrames = 3, kIterations = 3;
constexpr std::size_t kPlenty = std::size_t{1} << 40;

/// What the integrator says it needs at least, where `memory` does not do.
std::optional<MemoryNeeds> needs_within(TestScene& test, const Scene& scene, std::size_t memory) {
  try {
    test.integrator(scene, {}, memory);
  } catch (const NotEnoughMemory& error) {
    return error.least;
  }
  return {};
}

/// An integrator with the least memory that does.
std::unique_ptr<Integrator> with_least_memory(TestScene& test, const Scene& scene) {
  return test.integrator(scene, {}, needs_within(test, scene, 1)->total());
}

bool near(const Rgb& a, const Rgb& b) {
  const float scale = std::max(max_component(a), max_component(b));
  for (int c = 0; c < 3; ++c)
    if (std::abs(a[c] - b[c]) > 1e-4f * scale) return false;
  return true;
}

void expect_equal(const Integrator& a, const Integrator& b, int frames) {
  for (Frame f = 0; f < frames; ++f) {
    const Image one = a.estimate(f), other = b.estimate(f);
    for (int p = 0; p < static_cast<int>(one.pixels.size()); ++p) {
      EXPECT_TRUE(near(one.pixels[static_cast<std::size_t>(p)], other.pixels[static_cast<std::size_t>(p)]));
    }
    for (const char* output : {"photons", "radius"}) EXPECT_EQ(a.estimate(f, output), b.estimate(f, output));
  }
}

void expect_equal_counts(const Statistics& a, const Statistics& b) {
  EXPECT_EQ(a.photon.paths, b.photon.paths);
  EXPECT_EQ(a.photon.segments.done, b.photon.segments.done);
  EXPECT_EQ(a.photons_stored.separate, b.photons_stored.separate);
  EXPECT_EQ(a.photons_found.separate, b.photons_found.separate);
  EXPECT_EQ(a.camera.paths, b.camera.paths);
  for (std::size_t f = 0; f < a.energy.size(); ++f) EXPECT_NEAR(a.energy[f].emitted, b.energy[f].emitted, 1e-3);
}

class Progressive : public ::testing::TestWithParam<const char*> {};

TEST_P(Progressive, BatchesOfPhotonsChangeNothing) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const std::string text =
        RandomScene(2000 + seed, kFrames).text(fmt::format(R"(Integrator {} "integer photons" 20000)", GetParam()));
    SCOPED_TRACE(text);
    Choices choices;
    choices.outputs = {"photons", "radius"};
    TestScene test(text, choices);
    const bool alone = test.job().plugin->frames_together == 1;
    const auto scene = test.scene(alone ? std::vector{FileFrame(1)} : test.all_frames());
    const auto whole = test.integrator(*scene), batches = with_least_memory(test, *scene);
    EXPECT_EQ(whole->statistics().photon_batches, 1);
    EXPECT_GT(batches->statistics().photon_batches, 1);
    for (int i = 0; i < kIterations; ++i) whole->iterate({i, *scene}), batches->iterate({i, *scene});
    expect_equal(*whole, *batches, scene->frame_count());
    expect_equal_counts(whole->statistics(), batches->statistics());
    EXPECT_LT(batches->statistics().bytes, whole->statistics().bytes);
  }
}

TEST_P(Progressive, BatchesHaveTheSameBitsWithAnyNumberOfThreads) {
  TestScene test(RandomScene(77, kFrames).text(fmt::format(R"(Integrator {} "integer photons" 20000)", GetParam())));
  const bool alone = test.job().plugin->frames_together == 1;
  const auto scene = test.scene(alone ? std::vector{FileFrame(1)} : test.all_frames());
  std::vector<Image> images;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const auto batches = with_least_memory(test, *scene);
    EXPECT_GT(batches->statistics().photon_batches, 1);
    for (int i = 0; i < kIterations; ++i) batches->iterate({i, *scene});
    images.push_back(batches->estimate(0));
  }
  EXPECT_EQ(images[0], images[1]);
  EXPECT_EQ(images[0], images[2]);
}

// A batch has 4096 paths or more.
TEST_P(Progressive, BatchesAreNotTooSmall) {
  for (const auto& [photons, batches] : {std::pair(8192, 2), std::pair(8190, 1)}) {
    TestScene test(RandomScene(77, 1).text(fmt::format(R"(Integrator {} "integer photons" {})", GetParam(), photons)));
    const auto scene = test.scene({FileFrame(0)});
    EXPECT_EQ(with_least_memory(test, *scene)->statistics().photon_batches, batches);
  }
}

// Working buffers, and a copy of what the state of the pixels takes.
TEST(MemoryNeeds, OfBatchesHaveRoomForACopy) {
  TestScene test(RandomScene(77, 1).text(
      R"(Integrator "sppm" "string emission" "power" "string direct" "photons" "string estimator" "hj09" "integer photons" 20000)"));
  const auto scene = test.scene({FileFrame(0)});
  const auto pixels = static_cast<std::size_t>(test.job().settings.crop.count());
  // That the estimate of the error keeps of pixels, up to 4,096, and of parts of the picture, up to 1,024: of one pixel.
  constexpr std::size_t kLuminances = 2 * 8 * sizeof(float);
  EXPECT_EQ(needs_within(test, *scene, 1)->pixels,
            pixels * (2 * sizeof(PixelStatistics) + sizeof(PassSums) + 2 * kLuminances));
}

INSTANTIATE_TEST_SUITE_P(
    Estimators, Progressive,
    ::testing::Values(R"("dsppm" "string emission" "power" "string direct" "photons" "string estimator" "hj09")",
                      R"("dsppm" "string emission" "power" "string direct" "photons" "string estimator" "kz11")",
                      R"("sppm" "string emission" "power" "string direct" "photons" "string estimator" "hj09")",
                      R"("sppm" "string emission" "power" "string direct" "photons" "string estimator" "kz11")"));

/// What is in use, without the room that vectors keep for growing.
std::size_t bytes_in_use(const std::vector<HitPointTile>& tiles) {
  std::size_t bytes = 0;
  for (const HitPointTile& tile : tiles)
    bytes += (tile.hit_points.size() + tile.glossy.size()) * sizeof(HitPoint) +
             tile.scatterings.size() * sizeof(Scattering) + tile.seen.size() * sizeof(SeenLight);
  return bytes;
}

// The estimate looks at small blocks of pixels and is on the safe side, by no more than a half.
TEST(MemoryNeeds, OfHitPointsAreThoseOfAnIteration) {
  TestScene test(R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 200 "integer yresolution" 150
WorldBegin
LightSource "point" "point3 from" [0 2 -2] "rgb I" [8 8 8]
LightSource "infinite" "rgb L" [.2 .2 .2]
Material "coateddiffuse" "float roughness" 0.4
Shape "sphere"
Material "conductor" "float roughness" 0.5
Translate 1.5 0.5 0
Shape "sphere" "float radius" 0.7
)");
  const auto scene = test.scene({FileFrame(0)});
  for (const bool keep_bsdf : {false, true}) {
    const HitPointSettings settings{.sample_direct = true, .keep_bsdf = keep_bsdf};
    const RenderSettings& render = test.job().settings;
    const auto estimate = static_cast<double>(hit_point_bytes(*scene, render, settings));
    for (const std::uint64_t iteration : {0u, 7u}) {
      const auto actual = static_cast<double>(bytes_in_use(trace_hit_points(*scene, render, settings, iteration, {})));
      EXPECT_GE(estimate, actual);
      EXPECT_LE(estimate, 1.5 * actual);
    }
  }
}

class BoundedMemory : public ::testing::TestWithParam<const char*> {};

TEST_P(BoundedMemory, HoldsWhatItSays) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const std::string text = RandomScene(2100 + seed, kFrames).text(fmt::format(R"(Integrator {})", GetParam()));
    SCOPED_TRACE(text);
    TestScene test(text);
    const bool alone = test.job().plugin->frames_together == 1;
    const auto scene = test.scene(alone ? std::vector{FileFrame(1)} : test.all_frames());
    const std::size_t least = needs_within(test, *scene, 1)->total();
    EXPECT_TRUE(needs_within(test, *scene, least - 1));
    EXPECT_FALSE(needs_within(test, *scene, kPlenty));
    const auto integrator = test.integrator(*scene, {}, least);
    for (int i = 0; i < 6; ++i) integrator->iterate({i, *scene});
    // Photons are kept in vectors that grow by doubling; memory that was never written to is not taken.
    EXPECT_LE(static_cast<double>(integrator->statistics().bytes), 1.5 * static_cast<double>(least));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Integrators, BoundedMemory,
    ::testing::Values(
        R"("dsppm" "string emission" "power" "string direct" "photons" "integer photons" 50000 "string estimator" "hj09")",
        R"("dsppm" "string emission" "power" "string direct" "photons" "integer photons" 50000)",
        R"("sppm" "string emission" "power" "string direct" "photons" "integer photons" 50000 "string estimator" "hj09")",
        R"("photonmap" "string emission" "power" "integer photons" 20000 "integer causticphotons" 20000)",
        R"("photonmap" "string emission" "power" "integer photons" 20000 "integer finalgather" 2)", R"("path")",
        R"("vcm" "string emission" "power" "integer photons" 20000)"));

}  // namespace bounded_memory_test
}  // namespace dspm
