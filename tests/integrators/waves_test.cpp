// Photons traced in waves are those traced path by path, bit for bit: in random scenes of all that has a plain form, still
// and moving, and whatever the order in which a wave takes its paths. So are images.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/waves/traced_paths.h"
#include "dspm/integrators/waves/wave_photons.h"
#include "dspm/session/job/choices.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/digits.h"
#include "tests/integrators/plain_random_scene.h"
#include "tests/integrators/tracers.h"

namespace dspm::test {
namespace waves_test {

constexpr int kFrames = PlainRandomScene::kFrames;

/// All of a photon but its frames.
std::string in_words(const Photon& photon) {
  return fmt::format("{} {} {} {} {} {} {}", photon.face.shape(), photon.face.is_inner(), photon.light,
                     digits(photon.p), digits(photon.wi), digits(photon.flux), photon.only_nm);
}

/// What a frame has of a list of photons, in their order.
std::vector<std::string> of_frame(const std::vector<PhotonTrace>& traces, std::vector<Photon> PhotonTrace::*list,
                                  Frame f) {
  std::vector<std::string> photons;
  for (const PhotonTrace& trace : traces)
    for (const Photon& photon : trace.*list)
      if (photon.frames.contains(f)) photons.push_back(in_words(photon));
  return photons;
}

Statistics counts_of(const std::vector<PhotonTrace>& traces) {
  Statistics statistics;
  statistics.energy.resize(kFrames);
  account(traces, statistics);
  return statistics;
}

std::string in_words(const SurfaceGeometry& s) {
  return fmt::format("{} {} {} {} {} {} {} {}", digits(s.p), digits(s.p_error), digits(s.ng), digits(s.ns),
                     digits(s.dpdu), digits(s.dpdv), digits(s.uv.x), digits(s.uv.y));
}

TEST(Waves, KnowTheSurfacesOfShapesAndTheirHoles) {
  int holes = 0, passed = 0, turned = 0, of_several = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    TestScene test(PlainRandomScene(seed).text("\"dsppm\""));
    const auto scene = test.scene(test.all_frames());
    const PlainObjects plain(*scene);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> number(0, 1);
    for (std::size_t i = 0; i < scene->shapes.size(); ++i) {
      const PlacedShape& shape = scene->shapes[i];
      const PlainPlacedShape& own = plain.scene().shapes[i];
      const TriangleMesh* const mesh = shape.shape->triangles();
      holes += own.alpha != nullptr, turned += mesh != nullptr && !mesh->data().turned.empty();
      of_several += mesh == nullptr && shape.shape->primitive_count() > 1;
      for (int k = 0; k < 20; ++k) {
        const int primitive = k % shape.shape->primitive_count();
        const Vec2 uv{0.5f * number(random), 0.5f * number(random)};
        const Ray ray{{number(random), number(random), -3}, normalize({number(random), number(random), 1})};
        EXPECT_EQ(in_words(shape.surface_point(primitive, uv)), in_words(own.surface_point(primitive, uv)));
        EXPECT_EQ(shape.stops(ray, primitive, uv), own.stops(ray, primitive, uv));
        passed += !own.stops(ray, primitive, uv);
      }
    }
  }
  EXPECT_GT(holes, 50);
  EXPECT_GT(passed, 200);
  EXPECT_GT(turned, 20);
  EXPECT_GT(of_several, 20);
}

TEST(Waves, LeaveThePhotonsOfPathsOneByOne) {
  std::size_t all = 0, hidden = 0, parted = 0, of_one_wavelength = 0;
  int nested = 0, within = 0;  // scenes with bodies in one another, and within one
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    TestScene test(PlainRandomScene(seed).text("\"dsppm\"", seed % 2 == 1));
    const auto scene = test.scene(test.all_frames());
    nested += scene->nests, within += !scene->around_camera.empty();
    PhotonSettings settings;
    settings.hidden = true, settings.seed = seed, settings.max_depth = 6, settings.paths_per_trace = 512;
    if (seed % 3 == 1) settings.kinds = kCausticPhotons | kDiffusePhotons;
    if (seed % 3 == 2) settings.rays_tell = true;
    ASSERT_EQ(why_not_in_waves(*scene, settings), "");
    const auto one_by_one = trace_photons(*scene, settings, 3, 100, 2100, {});
    for (const auto& tracer : Tracers(*scene)) {
      SCOPED_TRACE(tracer->name());
      const auto waves = trace_photons_in_waves(*scene, *tracer, settings, 3, 100, 2100, {});
      for (Frame f = 0; f < kFrames; ++f) {
        EXPECT_EQ(of_frame(one_by_one, &PhotonTrace::photons, f), of_frame(waves, &PhotonTrace::photons, f)) << f;
        EXPECT_EQ(of_frame(one_by_one, &PhotonTrace::hidden, f), of_frame(waves, &PhotonTrace::hidden, f)) << f;
      }
      const Statistics a = counts_of(one_by_one), b = counts_of(waves);
      EXPECT_EQ(a.photon.segments.done, b.photon.segments.done);
      EXPECT_EQ(a.photon.segments.separate, b.photon.segments.separate);
      EXPECT_EQ(a.photon.paths, b.photon.paths);
      EXPECT_EQ(a.photon.dynamic_paths, b.photon.dynamic_paths);
      EXPECT_TRUE(a.photons_stored.done == b.photons_stored.done ||
                  looks_differ(*scene));  // one by one, they share some
      EXPECT_EQ(a.photons_stored.separate, b.photons_stored.separate);
      EXPECT_EQ(a.rejections.count(), b.rejections.count());
      for (std::size_t f = 0; f < kFrames; ++f)
        for (const auto entry : {&EnergyBalance::emitted, &EnergyBalance::absorbed, &EnergyBalance::escaped,
                                 &EnergyBalance::terminated, &EnergyBalance::roulette, &EnergyBalance::too_deep})
          EXPECT_NEAR(a.energy[f].*entry, b.energy[f].*entry, 1e-9 * a.energy[f].emitted);
      all += b.photons_stored.done, parted += b.photon.dynamic_paths;
      for (const PhotonTrace& trace : waves) {
        hidden += trace.hidden.size();
        of_one_wavelength += static_cast<std::size_t>(
            std::ranges::count_if(trace.photons, [](const Photon& photon) { return photon.only_nm != 0; }));
      }
    }
  }
  EXPECT_GT(all, 100'000u);
  EXPECT_GT(hidden, 100u);
  EXPECT_GT(parted, 20'000u);
  EXPECT_GT(of_one_wavelength, 10'000u);
  EXPECT_GT(nested, 20);
  EXPECT_GT(within, 5);
}

/// Traces photons on a machine with so many bytes of memory; returns why it was left.
std::string why_left(const Scene& scene, const PhotonSettings& settings, std::size_t bytes) {
  TracedPaths paths(std::make_unique<WaveTracerOn<RandomMachine>>(7, std::size_t{1} << 16, bytes), true);
  const auto one_by_one = trace_photons(scene, settings, 3, 0, 20'000, {});
  for (int turn = 0; turn < 2; ++turn) {
    const auto traces = paths.photons(scene, settings, 3, 0, 20'000, {});
    for (Frame f = 0; f < kFrames; ++f)
      EXPECT_EQ(of_frame(one_by_one, &PhotonTrace::photons, f), of_frame(traces, &PhotonTrace::photons, f)) << f;
  }
  return paths.why_off_gpu();
}

TEST(Waves, GoByFewerPathsOrOnTheCpuIfMemoryDoesNotSuffice) {
  TestScene test(PlainRandomScene(5).text("\"dsppm\""));
  const auto scene = test.scene(test.all_frames());
  const PhotonSettings settings;
  constexpr std::size_t kMega = std::size_t{1} << 20;
  EXPECT_EQ(why_left(*scene, settings, 500 * kMega), "");
  EXPECT_EQ(why_left(*scene, settings, 20 * kMega), "");  // not enough for all at once
  EXPECT_EQ(why_left(*scene, settings, kMega / 2), "the random machine's memory does not suffice");
}

std::vector<Image> images(const std::string& text, const char* device) {
  Choices choices;
  choices.device = device;
  return TestScene(text, choices).render_all(3);
}

TEST(Waves, LeaveImagesAsTheyAre) {
  for (const char* integrator :
       {R"("dsppm" "integer photons" 3000)", R"("dsppm" "integer photons" 3000 "string estimator" "hj09")",
        R"("sppm" "integer photons" 3000)", R"("dsppm" "integer photons" 3000 "string direct" "photons")",
        R"("dsppm" "integer photons" 3000 "string direct" "photons" "string estimator" "hj09")",
        R"("sppm" "integer photons" 3000 "string direct" "photons")",
        R"("sppm" "integer photons" 3000 "string direct" "photons" "string estimator" "hj09")"})
    for (unsigned seed = 100; seed < 106; ++seed) {
      SCOPED_TRACE(fmt::format("{} {}", seed, integrator));
      const std::string text = PlainRandomScene(seed).text(integrator);
      const std::vector<Image> cpu = images(text, "cpu"), waves = images(text, "waves");
      ASSERT_EQ(cpu.size(), waves.size());
      for (std::size_t f = 0; f < cpu.size(); ++f) EXPECT_TRUE(cpu[f].pixels == waves[f].pixels) << f;
    }
}

TEST(Waves, GatherOnRoughGlassInWater) {
  const std::string text = R"(
    Integrator "dsppm" "integer photons" 2000
    LookAt 0 0 -4  0 0 0  0 1 0
    Camera "perspective" "float fov" 40
    Film "rgb" "integer xresolution" 16 "integer yresolution" 12
    WorldBegin
    LightSource "point" "rgb I" [30 30 30] "point3 from" [2 3 -3]
    Material "diffuse"
    Shape "sphere" "float radius" 10
    Material "dielectric" "float eta" 1.33 "rgb attenuationcolor" [.7 .8 .9] "integer priority" 1
    Shape "sphere" "float radius" 1.2
    Material "dielectric" "float eta" 1.6 "float roughness" .5 "integer priority" 2
    Shape "sphere" "float radius" .9)";
  EXPECT_EQ(images(text, "cpu").front().pixels, images(text, "waves").front().pixels);
}

TEST(Waves, LeaveImagesAsTheyAreIfLooksDiffer) {
  for (const char* direct : {"photons", "both"})
    for (unsigned seed = 300; seed < 303; ++seed) {
      SCOPED_TRACE(fmt::format("{} {}", seed, direct));
      const std::string integrator =
          fmt::format(R"("dsppm" "integer photons" 3000 "bool sharepaths" false "string direct" "{}")", direct);
      const std::string text = PlainRandomScene(seed).text(integrator, true);
      const std::vector<Image> cpu = images(text, "cpu"), waves = images(text, "waves");
      ASSERT_EQ(cpu.size(), waves.size());
      for (std::size_t f = 0; f < cpu.size(); ++f) EXPECT_TRUE(cpu[f].pixels == waves[f].pixels) << f;
    }
}

std::string why_refused(const std::string& integrator, const std::string& more) {
  try {
    images(PlainRandomScene(1).text(integrator) + more, "waves");
  } catch (const std::exception& error) {
    return error.what();
  }
  return "it was rendered";
}

TEST(Waves, SayWhatHasNoPlainForm) {
  const auto refuses = [](const std::string& more, const std::string& why,
                          const std::string& integrator = "\"dsppm\"") {
    const std::string said = why_refused(integrator, more);
    EXPECT_NE(said.find(why), std::string::npos) << said;
  };
  refuses(
      "Texture \"t\" \"spectrum\" \"marble\" Material \"diffuse\" \"texture reflectance\" \"t\" Shape "
      "\"sphere\"\n",
      "\" is none of the plain kinds");
  refuses("Material \"diffuse\" \"rgb reflectance@1\" [0 0 0] \"rgb reflectance@3\" [1 1 1] Shape \"sphere\"\n",
          "materials differ between frames, and frames share paths");
  refuses("Texture \"t\" \"float\" \"vertexcolor\" Shape \"sphere\" \"texture alpha\" \"t\"\n",
          "has holes by a texture that has no plain form");
  refuses("Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0]\n", "none of the plain kinds");
  refuses("Material \"subsurface\" Shape \"sphere\"\n", "light is scattered inside");
  refuses("LightSource \"point\" \"rgb I@1\" [1 1 1] \"rgb I@3\" [2 1 1]\n", "lights differ between frames");
  refuses("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" MediumInterface \"fog\" \"\" Shape \"sphere\"\n",
          "there are media");
  refuses("", "the integrator path traces no photons in waves", "\"path\"");
}

}  // namespace waves_test
}  // namespace dspm::test
