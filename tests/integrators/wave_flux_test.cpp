// Photons gathered in waves give each hit point the flux that they give it one by one, bit for bit and in every frame,
// whatever the order in which a machine does things.
#include "dspm/integrators/waves/wave_flux.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/integrators/photons/gather.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/waves/plain_objects.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/digits.h"
#include "tests/integrators/plain_random_scene.h"
#include "tests/integrators/tracers.h"

namespace dspm::test {
namespace wave_flux_test {

constexpr int kFrames = PlainRandomScene::kFrames;

struct Iteration {
  std::vector<HitPointTile> tiles;
  std::vector<PhotonTrace> traces;
  PhotonMap photons;

  Iteration(const Scene& scene, const RenderSettings& render, unsigned seed) {
    PhotonSettings photon;
    photon.seed = seed, photon.max_depth = 6, photon.paths_per_trace = 512;
    HitPointSettings hit_point;
    hit_point.radius = 0.3f, hit_point.least_alpha = seed % 2 == 0 ? 0.25f : 0.02f;
    tiles = trace_hit_points(scene, render, hit_point, seed, {});
    traces = trace_photons(scene, photon, seed, 0, 2000, {});
    photons.build(traces, scene.frame_count(), 0.3f);
  }
};

/// What a frame gets, and the sums that frames share.
template <class Flux>
std::string in_words(const HitPoint& hit, const Flux& flux) {
  std::string words = digits(flux.shared());
  for (Frame f = 0; f < kFrames; ++f)
    if ((hit.frames & flux.with_own()).contains(f)) words += fmt::format(" {}: {}", f, digits(flux.own(f)));
  return words;
}

struct Found {
  int scenes = 0;  // that may be gathered in waves
  std::size_t scattered = 0, own = 0;
  std::uint64_t photons = 0;
};

void expect_equal(const Iteration& it, const FluxOfPoints& flux, float radius2, Found& found) {
  ASSERT_EQ(flux.first_point.size(), it.tiles.size() + 1);
  for (std::size_t t = 0; t < it.tiles.size(); ++t) {
    std::size_t i = flux.first_point[t];
    for (const HitPoint& hit : it.tiles[t].hit_points) {
      GatheredFlux expected(hit, it.photons);
      GatherCounts counts;
      gather_photons(hit, it.tiles[t].scattering_of(hit), it.photons, radius2, counts,
                     [&](const Strand* strands, FrameSet frames, SpectrumLanes photon, float) {
                       expected.add(strands, frames, photon);
                     });
      expected.end();
      const PointFlux& point = flux.points[i];
      EXPECT_EQ(in_words(hit, flux.of(i)), in_words(hit, expected));
      EXPECT_EQ(point.found, counts.found.done);
      EXPECT_EQ(point.found_separate, counts.found.separate);
      EXPECT_EQ(point.tests, counts.tests);
      found.scattered += hit.scattering >= 0, found.own += static_cast<std::size_t>(point.with_own.count());
      found.photons += point.found;
      ++i;
    }
    EXPECT_EQ(i, flux.first_point[t + 1]);
  }
}

TEST(WaveFlux, IsThatOfHitPointsOneByOne) {
  Found found;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    TestScene test(PlainRandomScene(seed).text("\"dsppm\"", seed % 3 == 2));
    const auto scene = test.scene(test.all_frames());
    const Iteration iteration(*scene, test.job().settings, seed);
    const PlainObjects plain(*scene);
    const bool may = may_gather_in_waves(iteration.tiles, iteration.photons, plain.scene());
    EXPECT_FALSE(may && scene->disperses);
    if (!may) continue;
    ++found.scenes;
    for (const float radius2 : {1e-4f, 0.09f})
      for (const auto& tracer : Tracers(*scene)) {
        SCOPED_TRACE(tracer->name());
        const FluxOfPoints flux =
            gather_in_waves(*tracer, iteration.tiles, iteration.photons, [&](const HitPoint&) { return radius2; });
        expect_equal(iteration, flux, radius2, found);
      }
  }
  EXPECT_GT(found.scenes, 12);
  EXPECT_GT(found.scattered, 2000u);
  EXPECT_GT(found.own, 10'000u);
  EXPECT_GT(found.photons, 100'000u);
}

TEST(WaveFlux, IsLeftToTheCpuIfHitPointsAreNotPlain) {
  TestScene test(PlainRandomScene(3).text("\"dsppm\""));
  const auto scene = test.scene(test.all_frames());
  Iteration iteration(*scene, test.job().settings, 3);
  const PlainObjects plain(*scene);
  for (HitPointTile& tile : iteration.tiles)
    for (HitPoint& hit : tile.hit_points)
      if (hit.scattering >= 0) {
        hit.wavelength.nm = 500;
        EXPECT_FALSE(may_gather_in_waves(iteration.tiles, iteration.photons, plain.scene()));
        return;
      }
  FAIL() << "all are constant";
}

}  // namespace wave_flux_test
}  // namespace dspm::test
