// Coloured glass, for every integrator: bodies of index 1 bend and mirror nothing, so light keeps colour^d of itself over
// the distance d that it passes through them, and colours of a picture over those of another without absorption are known.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/base/math/moments.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace absorption_test {

using test::TestScene;

constexpr Rgb kColour(0.5f, 0.8f, 0.95f);
const std::string kGlass = R"(Material "dielectric" "float eta" 1 )";
const std::string kAmber = kGlass + R"("rgb attenuationcolor" [.5 .8 .95] )";

const std::vector<std::string>& integrators() {
  static const std::vector<std::string> all{
      R"("path" "integer maxdepth" 4)",
      R"("vcm" "integer maxdepth" 5 "integer photons" 5000)",
      R"("vcm" "integer maxdepth" 5 "integer photons" 5000 "bool merge" false)",
      R"("dsppm" "integer maxdepth" 6 "integer photons" 5000)",
      R"("dsppm" "integer maxdepth" 6 "integer photons" 5000 "string direct" "photons")",
      R"("sppm" "integer maxdepth" 6 "integer photons" 5000)",
      R"("photonmap" "integer maxdepth" 6 "integer photons" 20000 "integer causticphotons" 20000)",
  };
  return all;
}

/// Seen from above along z, in parallel rays.
std::string scene(const std::string& integrator, const std::string& contents, const std::string& frames = "") {
  return frames + "\nIntegrator " + integrator + R"(
LookAt 0 0 5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.2 .2 -.2 .2]
PixelFilter "box"
Film "rgb" "integer xresolution" 4 "integer yresolution" 4
WorldBegin
)" + contents;
}
/// A closed box with outward normals, of x and y in [-3, 3].
std::string box(float bottom, float top) {
  return fmt::format(
      R"(Shape "trianglemesh" "point3 P" [-3 -3 {0} 3 -3 {0} 3 3 {0} -3 3 {0}  -3 -3 {1} 3 -3 {1} 3 3 {1} -3 3 {1}]
  "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
)",
      bottom, top);
}
const std::string kDisk = R"(Material "diffuse" Shape "disk" "float radius" 2
)";
const std::string kSun = R"(LightSource "distant" "rgb L" [1 1 1] "point3 from" [0 0 1] "point3 to" [0 0 0]
)";

Rgb mean_of(const std::string& text, int iterations = 4) {
  return mean(TestScene(text).render(FileFrame(0), iterations));
}

/// Colours are in the same proportions in each photon, so noise concerns their sum alone.
void expect_left(const Rgb& seen, const Rgb& clear, double distance, const std::string& what, double error = 1e-3) {
  ASSERT_GT(max_component(clear), 0) << what;
  const auto left = [&](int c) { return std::pow(static_cast<double>(kColour[c]), distance); };
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(seen[c] / seen.b * clear.b / clear[c], left(c) / left(2), error) << what << ", colour " << c;
  EXPECT_NEAR(seen.b / clear.b, left(2), 0.06) << what;
}

/// Those that find light of the sun through glass.
bool finds_the_sun(const std::string& integrator) {
  return integrator.find("path") == std::string::npos && integrator.find("merge") == std::string::npos;
}

// A lamp of radiance 1 behind a pane of thickness 2.
TEST(Absorption, OfALampBehindAPane) {
  const std::string lamp =
      R"(AttributeBegin AreaLightSource "diffuse" "bool twosided" true Shape "disk" "float height" -1 AttributeEnd
)";
  for (const std::string& integrator : integrators()) {
    const Rgb seen = mean_of(scene(integrator, lamp + kAmber + box(0, 2)), 2);
    expect_left(seen, Rgb(1), 2, integrator);
  }
}

// Sunlight comes down through a slab of thickness 1.5 to a matte disk, and goes back up through it: 3 in all.
TEST(Absorption, OfSunlightOnWhatLiesBehind) {
  for (const std::string& integrator : integrators()) {
    if (!finds_the_sun(integrator)) continue;
    const Rgb clear = mean_of(scene(integrator, kSun + kDisk + kGlass + box(0.5, 2))),
              seen = mean_of(scene(integrator, kSun + kDisk + kAmber + box(0.5, 2)));
    expect_left(seen, clear, 3, integrator);
  }
}

// The same disk within the body, 2 below its top: no surface of the body tells of the way down.
TEST(Absorption, OfSunlightOnWhatLiesWithin) {
  for (const std::string& integrator : integrators()) {
    if (!finds_the_sun(integrator)) continue;
    const Rgb clear = mean_of(scene(integrator, kSun + kDisk + kGlass + box(-1, 2))),
              seen = mean_of(scene(integrator, kSun + kDisk + kAmber + box(-1, 2)));
    expect_left(seen, clear, 4, integrator);
  }
}

// A small lamp within the body, straight above the disk, lights it by rays, shadow rays, connections and photons, which
// have gone about as far; all integrators must agree with path on how much is left.
TEST(Absorption, OfALampWithin) {
  const auto pool = [](const std::string& integrator, const std::string& material) {
    return scene(integrator,
                 R"(AttributeBegin Translate 1.2 0 1.5 Rotate 180 1 0 0 AreaLightSource "diffuse" "rgb L" [200 200 200]
Material "diffuse" "rgb reflectance" [0 0 0] Shape "disk" "float radius" .05 AttributeEnd
)" + kDisk + material +
                     box(-1, 2));
  };
  const float distance = std::hypot(1.2f, 1.5f) + 2;
  for (const std::string& integrator : integrators()) {
    const Rgb clear = mean_of(pool(integrator, kGlass), 8), seen = mean_of(pool(integrator, kAmber), 8);
    expect_left(seen, clear, static_cast<double>(distance), integrator, 0.03);
  }
}

// Frames of other colours share their paths, each with its own.
TEST(Absorption, DiffersBetweenFrames) {
  const std::string keyed =
      kGlass + R"("float attenuationdistance@1" 1 "float attenuationdistance@3" 3 "rgb attenuationcolor" [.5 .8 .95] )";
  for (const std::string& integrator : integrators()) {
    if (!finds_the_sun(integrator)) continue;
    TestScene three(scene(integrator, kSun + kDisk + keyed + box(0.5, 2), "Frames 3"));
    const std::vector<Image> images = three.render_all(4);
    const Rgb clear = mean_of(scene(integrator, kSun + kDisk + kGlass + box(0.5, 2), "Frames 3"));
    for (int f = 0; f < 3; ++f) expect_left(mean(images[static_cast<std::size_t>(f)]), clear, 3. / (f + 1), integrator);
  }
  TestScene shared(scene(integrators()[3], kSun + kDisk + keyed + box(0.5, 2), "Frames 3"));
  const auto all = shared.scene(shared.all_frames());
  const auto dsppm = shared.integrator(*all);
  dsppm->iterate({0, *all});
  const PathCounts& photons = dsppm->statistics().photon;
  EXPECT_GT(photons.segments.factor(), 2.5);
}

}  // namespace absorption_test
}  // namespace dspm
