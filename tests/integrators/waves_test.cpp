// Photons traced in waves are those traced path by path, bit for bit: in random scenes of all that has a plain form, still
// and moving, and whatever the order in which a wave takes its paths. So are images.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/waves/plain_objects.h"
#include "dspm/integrators/waves/wave_photons.h"
#include "dspm/session/job/choices.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/scene_files.h"

namespace dspm::test {
namespace waves_test {

constexpr int kFrames = 6;

class PlainRandomScene {
 public:
  explicit PlainRandomScene(unsigned seed) : random_(seed) {}

  std::string text(const std::string& integrator) {
    std::string s = fmt::format(
        "Frames {}\nIntegrator {}\nLookAt 0 0.2 -4.2  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
        "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 20\nWorldBegin\n",
        kFrames, integrator);
    s += "Texture \"tiles\" \"spectrum\" \"checkerboard\" \"float uscale\" 5 \"float vscale\" 4 \"rgb tex1\" [.9 .2 "
         ".4]\n"
         "Texture \"grain\" \"float\" \"wrinkled\" Texture \"picture\" \"spectrum\" \"imagemap\" \"float uscale\" 2 "
         "\"string filename\" " +
         files()["picture.png"] + "\n";
    for (const char* wall : {"-2 -1.2 -2  -2 -1.2 2  2 -1.2 2  2 -1.2 -2", "-2 -1.2 2  -2 2 2  2 2 2  2 -1.2 2",
                             "-2 -1.2 -2  -2 2 -2  -2 2 2  -2 -1.2 2"})
      s += "AttributeBegin\n" + material(whole(0, 3) > 1 ? 0 : whole(0, 8)) +
           fmt::format("Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [{}]\nAttributeEnd\n",
                       wall);
    for (int i = 0; i < 2; ++i) s += light(whole(0, 4));
    for (int i = 0; i < 3; ++i)
      s += "AttributeBegin\n" + place() + "\n" + material(whole(0, 8)) + shape() + "AttributeEnd\n";
    for (int i = 0; i < 2; ++i)
      s += fmt::format("DynamicBegin \"thing{}\" {}\nKeyframe 1 {} Keyframe {} {} KeyframeEnd\n{}DynamicEnd\n", i,
                       material(whole(0, 8)), place(), whole(2, kFrames), place(), shape());
    return s;
  }

 private:
  float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  std::string place() {
    return fmt::format("Translate {} {} {} Rotate {} {} 1 {} Scale {} {} {}", real(-1, 1), real(-1, 1), real(-1, 1),
                       real(0, 360), real(-1, 1), real(-1, 1), real(0.5f, 1), real(0.5f, 1),
                       whole(0, 4) == 0 ? -1.f : real(0.5f, 1));
  }
  std::string material(int kind) {
    switch (kind) {
      case 0:
        return fmt::format("Material \"diffuse\" \"rgb reflectance\" [{} {} {}]\n", real(0, 1), real(0, 1), real(0, 1));
      case 1: return fmt::format("Material \"dielectric\" \"float eta\" {}\n", real(1.1f, 1.8f));
      case 2:
        return fmt::format(
            "Material \"dielectric\" \"float eta\" 1.5 \"float uroughness\" {} \"float vroughness\" {}\n",
            real(0.01f, 0.5f), real(0.01f, 0.5f));
      case 3:
        return fmt::format("Material \"conductor\" \"float roughness\" {}\n",
                           whole(0, 1) == 0 ? 0.f : real(0.01f, 0.4f));
      case 4: return "Material \"conductor\" \"rgb reflectance\" [.9 .7 .4] \"float uroughness\" .3\n";
      case 5: return "Material \"thindielectric\" \"rgb tint\" [.9 .6 .8]\n";
      case 6: return "Material \"diffuse\" \"texture reflectance\" \"picture\"\n";
      case 7: return "Material \"diffuse\" \"texture reflectance\" \"tiles\"\n";
      default: return "Material \"conductor\" \"texture reflectance\" \"picture\" \"texture roughness\" \"grain\"\n";
    }
  }
  std::string shape() {
    switch (whole(0, 5)) {
      case 0: return "Shape \"sphere\" \"float radius\" .5 \"float zmax\" .4\n";
      case 1: return "Shape \"sphere\" \"float radius\" .5\n";
      case 2: return "Shape \"disk\" \"float radius\" .6 \"float innerradius\" .1\n";
      case 3: return "Shape \"cylinder\" \"float radius\" .4 \"float phimax\" 250\n";
      case 4:
        return "ReverseOrientation Shape \"loopsubdiv\" \"integer levels\" 2 \"integer indices\" [0 1 2 0 2 3 0 3 1 1 "
               "3 2] "
               "\"point3 P\" [0 .7 0  -.6 -.4 -.4  .6 -.4 -.4  0 -.4 .6]\n";
      default:
        return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point2 uv\" [0 0 1 0 1 1 0 1] "
               "\"normal3 N\" [0 .3 1  .2 0 1  0 -.2 1  -.1 0 1] \"point3 P\" [-.5 -.5 0  .5 -.5 0  .5 .5 .1  -.5 .5 "
               "0]\n";
    }
  }
  std::string light(int kind) {
    switch (kind) {
      case 0:
        return "AttributeBegin Translate 0 1.6 0 Rotate 90 1 0 0 AreaLightSource \"diffuse\" \"rgb L\" [9 8 7] \"bool "
               "twosided\" true Shape \"disk\" \"float radius\" .5 AttributeEnd\n";
      case 1: return "LightSource \"point\" \"rgb I\" [6 5 4] \"point3 from\" [.4 1.2 -1]\n";
      case 2: return "LightSource \"spot\" \"rgb I\" [20 20 20] \"point3 from\" [.5 1.4 -1] \"point3 to\" [0 -1 0]\n";
      case 3: return "LightSource \"distant\" \"rgb L\" [2 2 2] \"point3 from\" [1 2 -1] \"point3 to\" [0 0 0]\n";
      default: return "LightSource \"infinite\" \"rgb L\" [.3 .4 .5]\n";
    }
  }

  static const SceneFiles& files() {
    static const SceneFiles all;
    return all;
  }

  std::mt19937 random_;
};

std::string digits(float x) { return fmt::format("{:08x}", std::bit_cast<std::uint32_t>(x)); }

/// All of a photon but its frames.
std::string in_words(const Photon& photon) {
  std::string text = fmt::format("{} {} {}", photon.face.shape(), photon.face.is_inner(), photon.light);
  for (int i = 0; i < 3; ++i)
    text += " " + digits(photon.p[i]) + " " + digits(photon.wi[i]) + " " + digits(photon.flux[i]);
  return text;
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

TEST(Waves, LeaveThePhotonsOfPathsOneByOne) {
  std::size_t all = 0, hidden = 0, parted = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    TestScene test(PlainRandomScene(seed).text("\"dsppm\""));
    const auto scene = test.scene(test.all_frames());
    PhotonSettings settings;
    settings.hidden = true, settings.seed = seed, settings.max_depth = 6, settings.paths_per_trace = 512;
    if (seed % 3 == 1) settings.kinds = kCausticPhotons | kDiffusePhotons;
    if (seed % 3 == 2) settings.rays_tell = true;
    ASSERT_EQ(why_not_in_waves(*scene, settings), "");
    const PlainObjects plain(*scene);
    const auto one_by_one = trace_photons(*scene, settings, 3, 100, 2100, {});
    for (const std::uint64_t shuffle : {0, 7}) {
      const auto waves = trace_photons_in_waves(*scene, plain.scene(), settings, 3, 100, 2100, {}, shuffle);
      for (Frame f = 0; f < kFrames; ++f) {
        EXPECT_EQ(of_frame(one_by_one, &PhotonTrace::photons, f), of_frame(waves, &PhotonTrace::photons, f)) << f;
        EXPECT_EQ(of_frame(one_by_one, &PhotonTrace::hidden, f), of_frame(waves, &PhotonTrace::hidden, f)) << f;
      }
      const Statistics a = counts_of(one_by_one), b = counts_of(waves);
      EXPECT_EQ(a.photon.segments.done, b.photon.segments.done);
      EXPECT_EQ(a.photon.segments.separate, b.photon.segments.separate);
      EXPECT_EQ(a.photon.paths, b.photon.paths);
      EXPECT_EQ(a.photon.dynamic_paths, b.photon.dynamic_paths);
      EXPECT_EQ(a.photons_stored.done, b.photons_stored.done);
      EXPECT_EQ(a.photons_stored.separate, b.photons_stored.separate);
      EXPECT_EQ(a.rejections.count(), b.rejections.count());
      for (std::size_t f = 0; f < kFrames; ++f)
        for (const auto entry : {&EnergyBalance::emitted, &EnergyBalance::absorbed, &EnergyBalance::escaped,
                                 &EnergyBalance::terminated, &EnergyBalance::roulette, &EnergyBalance::too_deep})
          EXPECT_NEAR(a.energy[f].*entry, b.energy[f].*entry, 1e-9 * a.energy[f].emitted);
      all += b.photons_stored.done, parted += b.photon.dynamic_paths;
      for (const PhotonTrace& trace : waves) hidden += trace.hidden.size();
    }
  }
  EXPECT_GT(all, 100'000u);
  EXPECT_GT(hidden, 100u);
  EXPECT_GT(parted, 20'000u);
}

std::vector<Image> images(const std::string& text, const char* device) {
  Choices choices;
  choices.device = device;
  return TestScene(text, choices).render_all(3);
}

TEST(Waves, LeaveImagesAsTheyAre) {
  for (const char* integrator :
       {R"("dsppm" "integer photons" 3000)", R"("dsppm" "integer photons" 3000 "string estimator" "hj09")",
        R"("dsppm" "integer photons" 3000 "string direct" "photons")", R"("sppm" "integer photons" 3000)"})
    for (unsigned seed = 100; seed < 106; ++seed) {
      SCOPED_TRACE(fmt::format("{} {}", seed, integrator));
      const std::string text = PlainRandomScene(seed).text(integrator);
      const std::vector<Image> cpu = images(text, "cpu"), waves = images(text, "waves");
      ASSERT_EQ(cpu.size(), waves.size());
      for (std::size_t f = 0; f < cpu.size(); ++f) EXPECT_EQ(cpu[f].pixels, waves[f].pixels) << f;
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
          "\" differs between frames");
  refuses("Shape \"sphere\" \"float alpha\" 0.5\n", "has holes");
  refuses("Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0]\n", "none of the plain kinds");
  refuses("LightSource \"point\" \"rgb I@1\" [1 1 1] \"rgb I@3\" [2 1 1]\n", "lights differ between frames");
  refuses("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" MediumInterface \"fog\" \"\" Shape \"sphere\"\n",
          "there are media");
  refuses("", "the integrator path traces no photons in waves", "\"path\"");
}

}  // namespace waves_test
}  // namespace dspm::test
