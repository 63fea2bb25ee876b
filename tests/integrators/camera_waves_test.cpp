// Camera paths traced in waves leave what those traced one by one leave, bit for bit: hit points with their Bsdfs, and the
// light that they see, for each pixel in each frame in the same order.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <map>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/trace_hit_points.h"
#include "dspm/integrators/waves/plain_objects.h"
#include "dspm/integrators/waves/wave_hit_points.h"
#include "dspm/session/job/choices.h"
#include "dspm/session/job/job.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/digits.h"
#include "tests/integrators/plain_random_scene.h"
#include "tests/integrators/tracers.h"

namespace dspm::test {
namespace camera_waves_test {

constexpr int kFrames = PlainRandomScene::kFrames;

const PlainRandomScene::View kViews[] = {
    {},
    {.camera = "LookAt 0 0.2 -4.2  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.1 "
               "\"float focaldistance\" 4"},
    {.camera = "LookAt 0 0.2 -4.2  0 0 0  0 1 0\nCamera \"orthographic\" \"float screenwindow\" [-1.5 1.5 -1.5 1.5]",
     .film = "\"bool transparent\" true"},
    {.camera = "Keyframe 1 LookAt 0 0.2 -4.2  0 0 0  0 1 0\nKeyframe 4 LookAt 1 0.4 -4  0 0 0  0 1 0\nKeyframeEnd\n"
               "Camera \"perspective\" \"float fov\" 40"},
    {.film = "\"bool transparent\" true", .walls = "\"bool shadowcatcher\" true"},
    {.lights = 14},
};

std::string in_words(const Scattering& s) {
  std::string text =
      fmt::format("{} {} {} {} {} {} {} {} {} {}", digits(s.wo), digits(s.p_error), s.lobes, s.transmits, s.material,
                  fmt::join(s.inside.bodies(), ","), s.inside.medium, digits(s.ns), digits(s.unbent_ns), s.strip);
  for (const float z : {-0.8f, 0.1f, 0.6f})
    for (const float x : {-0.6f, 0.4f}) {
      const Vec3 wi = normalize(Vec3{x, 0.3f, z});
      text += digits(s.scattered(wi)) + digits(s.bsdf->pdf_w(s.wo, wi, Transport::radiance, s.bsdf->all_lobes()));
    }
  return text;
}

std::string in_words(const HitPoint& h, const HitPointTile& tile) {
  const Scattering* scattering = tile.scattering_of(h);
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", digits(h.p), digits(h.ng), digits(h.throughput),
                     h.face.shape(), h.face.is_inner(), h.frames.count(), digits(h.radius), h.indirect, h.caught,
                     h.wavelength.nm, h.wavelength.alone, h.wavelength.weighs, h.strands,
                     scattering == nullptr ? "constant" : in_words(*scattering));
}

std::string in_words(const SeenLight& s, const HitPointTile&) {
  return fmt::format("{} {} {} {} {}\n", s.frames.count(), digits(s.radiance), s.light, s.caught, s.of_media);
}

/// What each pixel has of a list, in its order, in each frame.
using ByPixel = std::map<std::pair<int, Frame>, std::string>;

template <class Item>
ByPixel by_pixel(const std::vector<HitPointTile>& tiles, std::vector<Item> HitPointTile::*list) {
  ByPixel all;
  for (const HitPointTile& tile : tiles)
    for (const Item& item : tile.*list)
      for (Frame f = 0; f < kFrames; ++f)
        if (item.frames.contains(f)) all[{item.pixel, f}] += in_words(item, tile);
  return all;
}

/// Shows the first difference alone.
void expect_equal(const ByPixel& a, const ByPixel& b) {
  if (a == b) return;
  EXPECT_EQ(a.size(), b.size());
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (x != a.end() && y != b.end()) {
    EXPECT_EQ(*x, *y);
  }
}

std::pair<std::uint64_t, std::uint64_t> segments_of(const std::vector<HitPointTile>& tiles) {
  SharedCount sum;
  for (const HitPointTile& tile : tiles) sum += tile.paths.segments;
  return {sum.done, sum.separate};
}

void expect_equal(const std::vector<HitPointTile>& a, const std::vector<HitPointTile>& b) {
  expect_equal(by_pixel(a, &HitPointTile::hit_points), by_pixel(b, &HitPointTile::hit_points));
  expect_equal(by_pixel(a, &HitPointTile::glossy), by_pixel(b, &HitPointTile::glossy));
  expect_equal(by_pixel(a, &HitPointTile::seen), by_pixel(b, &HitPointTile::seen));
  EXPECT_EQ(segments_of(a), segments_of(b));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t t = 0; t < a.size(); ++t) {
    const PathCounts &x = a[t].paths, &y = b[t].paths;
    EXPECT_EQ(x.paths, y.paths);
    EXPECT_EQ(x.dynamic_paths, y.dynamic_paths);
    EXPECT_EQ(x.shadow_rays, y.shadow_rays);
    EXPECT_EQ(x.weighted, y.weighted);
    EXPECT_EQ(a[t].rejections.count(), b[t].rejections.count());
    EXPECT_EQ(a[t].hit_points.size(), b[t].hit_points.size());
    EXPECT_EQ(a[t].scatterings.size(), b[t].scatterings.size());
    EXPECT_NEAR(a[t].radii_in_pixels, b[t].radii_in_pixels, 1e-9 * a[t].radii_in_pixels);
    EXPECT_EQ(a[t].palette, b[t].palette);
  }
}

HitPointSettings settings_of(unsigned seed) {
  HitPointSettings settings;
  settings.share_paths = true, settings.keep_bsdf = seed % 4 == 3;
  if (seed % 3 == 1) settings.least_alpha = 0.05f, settings.radius = 0.1f;
  if (seed % 7 == 2) settings.least_alpha = kNothingGathers;
  if (seed % 6 == 5) settings.max_depth = 2;
  if (seed % 11 == 6) settings.pixels = {.moment = 1, .count = 3};
  if (seed % 11 == 7) settings.frames = FrameSet::first(2);
  return settings;
}

struct Found {
  std::size_t hit_points = 0, glossy = 0, scatterings = 0, seen = 0, caught = 0, rays = 0, parted = 0;
  std::size_t of_one_wavelength = 0;

  void add(const HitPointTile& tile) {
    hit_points += tile.hit_points.size(), glossy += tile.glossy.size(), scatterings += tile.scatterings.size();
    seen += tile.seen.size(), rays += tile.paths.shadow_rays, parted += tile.paths.dynamic_paths;
    for (const HitPoint& hit : tile.hit_points) {
      caught += hit.caught;
      of_one_wavelength += hit.wavelength.alone;
    }
  }
};

TEST(CameraWaves, LeaveWhatPathsOneByOneLeave) {
  Found found;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    TestScene test(PlainRandomScene(seed).text("\"dsppm\"", kViews[seed % std::size(kViews)]));
    const auto scene = test.scene(test.all_frames());
    const RenderSettings& render = test.job().settings;
    const HitPointSettings settings = settings_of(seed);
    ASSERT_EQ(why_not_in_waves(*scene, settings), "");
    const PlainObjects plain(*scene);
    const auto one_by_one = trace_hit_points(*scene, render, settings, seed, {});
    for (const auto& tracer : Tracers(*scene)) {
      SCOPED_TRACE(tracer->name());
      const auto waves = trace_hit_points_in_waves(*scene, plain.scene(), *tracer, render, settings, seed, {});
      expect_equal(one_by_one, waves);
      for (const HitPointTile& tile : waves) found.add(tile);
    }
  }
  EXPECT_GT(found.hit_points, 20'000u);
  EXPECT_GT(found.glossy, 1000u);
  EXPECT_GT(found.scatterings, 2000u);
  EXPECT_GT(found.seen, 10'000u);
  EXPECT_GT(found.caught, 1000u);
  EXPECT_GT(found.rays, 1000u);
  EXPECT_GT(found.parted, 10'000u);
  EXPECT_GT(found.of_one_wavelength, 300u);
}

std::vector<Image> images(const std::string& text, const char* device, bool otherwise) {
  Choices choices;
  choices.device = device;
  if (otherwise) choices.colour = "spectral", choices.noise = "perframe";
  return TestScene(text, choices).render_all(2);
}

TEST(CameraWaves, LeaveImagesAsTheyAre) {
  for (const bool otherwise : {false, true})
    for (unsigned seed = 200; seed < 200 + std::size(kViews); ++seed) {
      SCOPED_TRACE(fmt::format("{} {}", seed, otherwise));
      const std::string text = PlainRandomScene(seed).text(
          R"("dsppm" "integer photons" 1000 "string direct" "photons")", kViews[seed - 200]);
      const std::vector<Image> cpu = images(text, "cpu", otherwise), waves = images(text, "waves", otherwise);
      ASSERT_EQ(cpu.size(), waves.size());
      for (std::size_t f = 0; f < cpu.size(); ++f) EXPECT_TRUE(cpu[f].pixels == waves[f].pixels) << f;
    }
}

// A camera path stands for a pixel, and sees what a texture is there on average; a photon is a point.
TEST(CameraWaves, SayWhenTexturesAreAveraged) {
  TestScene test(PlainRandomScene(1).text("\"dsppm\"") +
                 "Texture \"t\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" \"t\"\n"
                 "Shape \"disk\"\n");
  const auto scene = test.scene(test.all_frames());
  EXPECT_EQ(why_not_in_waves(*scene, HitPointSettings()), "camera paths average textures over what they stand for");
}

TEST(CameraWaves, SayWhenLooksDiffer) {
  TestScene test(PlainRandomScene(1).text("\"dsppm\"", true));
  const auto scene = test.scene(test.all_frames());
  EXPECT_EQ(why_not_in_waves(*scene, HitPointSettings()), "materials differ between frames");
}

TEST(CameraWaves, SayWhenRaysBringLightToHitPoints) {
  TestScene test(PlainRandomScene(1).text("\"dsppm\""));
  const auto scene = test.scene(test.all_frames());
  HitPointSettings settings;
  settings.sample_direct = true;
  EXPECT_EQ(why_not_in_waves(*scene, settings), "rays from hit points look for lights");
  settings.sample_direct = false, settings.go_on = true;
  EXPECT_EQ(why_not_in_waves(*scene, settings), "camera paths go on from hit points");
}

}  // namespace camera_waves_test
}  // namespace dspm::test
