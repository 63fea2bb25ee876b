// Renders by wavelength against integrals over all of them: what red, green and blue alone cannot say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/sensor.h"
#include "dspm/base/colour/smooth_spectra.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/moments.h"
#include "dspm/materials/fresnel.h"
#include "dspm/testing/compare.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace spectral_test {

using test::TestScene;

const std::string kSpectral = "Option \"colour\" \"spectral\"\n";
const std::string kWhiteSky = R"(LightSource "infinite" "rgb L" [1 1 1]
)";

const std::vector<std::string>& integrators() {
  static const std::vector<std::string> all{
      R"("path" "integer maxdepth" 30)",
      R"("vcm" "integer maxdepth" 30 "integer photons" 3000)",
      R"("dsppm" "integer maxdepth" 30 "integer photons" 5000)",
      R"("dsppm" "integer maxdepth" 30 "integer photons" 5000 "string estimator" "hj09" "string direct" "photons")",
      R"("sppm" "integer maxdepth" 30 "integer photons" 5000)",
      R"("sppm" "integer maxdepth" 30 "integer photons" 5000 "string estimator" "hj09")",
      R"("photonmap" "integer maxdepth" 30 "integer photons" 5000 "integer causticphotons" 1000)",
  };
  return all;
}

/// The colour of a spectrum, under daylight.
template <class Value>
Rgb seen(Value&& value) {
  std::array<double, 3> sum{};
  for (int nm = kFirstNm; nm <= kLastNm; ++nm)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += part_of_white(nm)[c] * static_cast<double>(value(nm));
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

std::string view(const std::string& options, const std::string& integrator, const std::string& contents) {
  return options + "Integrator " + integrator + R"(
LookAt 0 0 1.5  0 0 0  0 1 0
Camera "perspective" "float fov" 20
PixelFilter "box"
Film "rgb" "integer xresolution" 6 "integer yresolution" 6
WorldBegin
)" + contents;
}

Rgb mean_of(const std::string& text, int iterations) { return mean(TestScene(text).render(FileFrame(0), iterations)); }

void expect_near(const Rgb& found, const Rgb& expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << c;
}

// A closed furnace of colour: light of each wavelength is reflected on and on by itself, so its colour is richer than red,
// green and blue reflected on and on would be.
TEST(Spectral, ColoursGrowRicherBetweenWalls) {
  const SmoothSpectrum& walls = SmoothSpectra::all().at(12, 8, 4);
  const Rgb expected = seen([&](int nm) { return 1 / (1 - walls.at(nm)); });
  EXPECT_GT(std::abs(expected.r - 1 / (1 - 0.75f)), 0.2f);  // RGB's answer
  const std::string furnace = R"(AttributeBegin
AreaLightSource "diffuse" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [.75 .5 .25]
ReverseOrientation
Shape "sphere" "float radius" 2
AttributeEnd
)";
  for (const std::string& integrator : integrators()) {
    SCOPED_TRACE(integrator);
    expect_near(mean_of(view(kSpectral, integrator, furnace), 64), expected, 0.05f * expected.r);
  }
}

const std::string kFloor = R"(Shape "bilinearmesh" "point3 P" [-3 -3 0  3 -3 0  -3 3 0  3 3 0]
)";

// The yellow of sodium on a thing that reflects nothing but it, and on one that reflects all but it.
TEST(Spectral, LampsOfOneLineShowOneColour) {
  const std::string lamp =
      R"(LightSource "distant" "spectrum L" [580 0 584 1 594 1 598 0] "point3 from" [0 0 1] "point3 to" [0 0 0]
)";
  const SpectralCurve line{{580, 584, 594, 598}, {0, 1, 1, 0}};
  const Colour light = Colour::of(line, SpectrumRole::illuminant);
  for (const auto& [reflectance, share] :
       {std::pair{"[575 .1 576 .8 600 .8 601 .1]", 0.8f}, {"[575 .8 576 .1 600 .1 601 .8]", 0.1f}}) {
    const std::string contents =
        lamp + fmt::format("Material \"diffuse\" \"spectrum reflectance\" {}\n", reflectance) + kFloor;
    const Rgb expected = seen([&](int nm) { return light.spectrum->at(nm) * share / kPi; });
    for (const std::string& integrator : integrators()) {
      SCOPED_TRACE(integrator);
      const Rgb found = mean_of(view(kSpectral, integrator, contents), 256);
      expect_near(found, expected, 0.06f * std::max(expected.r, expected.g));
    }
  }
}

// The first illuminant of a light is its own; the background that the camera sees is another.
TEST(Spectral, SkiesShineByTheirSpectra) {
  const std::string sky = R"(LightSource "infinite" "spectrum L" "stdillum-F11" "rgb background" [.2 .3 .4]
)";
  const std::string path = R"("path" "integer maxdepth" 2)";
  const std::string dyed = "Material \"diffuse\" \"spectrum reflectance\" [530 .1 550 .9 570 .1]\n";
  const Colour light = Colour::of(*named_spectrum("stdillum-F11"), SpectrumRole::illuminant);
  const SpectralCurve dye{{530, 550, 570}, {0.1f, 0.9f, 0.1f}};
  const Rgb expected = seen([&](int nm) { return light.spectrum->at(nm) * dye.at(static_cast<float>(nm)); });
  expect_near(mean_of(view(kSpectral, path, sky + dyed + kFloor), 512), expected, 0.03f * expected.g);
  expect_near(mean_of(view(kSpectral, path, sky), 64), {0.2f, 0.3f, 0.4f}, 0.003f);
}

TEST(Spectral, SurfacesEmitByTheirSpectra) {
  const std::string floor =
      "Material \"principled\" \"spectrum emission\" [500 0 510 1 520 0] \"float emissionstrength\" 2\n" + kFloor;
  const Colour light = Colour::of({{500, 510, 520}, {0, 1, 0}}, SpectrumRole::illuminant);
  const Rgb expected = seen([&](int nm) { return 2 * light.spectrum->at(nm); });
  EXPECT_LT(expected.r, -0.5f);  // the line lies outside of Rec. 709
  for (const std::string& integrator : integrators()) {
    SCOPED_TRACE(integrator);
    expect_near(mean_of(view(kSpectral, integrator, floor), 256), expected, 0.06f * expected.g);
  }
}

// A camera's picture of a dye under a lamp of lines is not what an eye sees.
TEST(Spectral, SensorsRecordByTheirResponses) {
  std::string text = view(kSpectral, R"("path" "integer maxdepth" 2)",
                          "LightSource \"infinite\" \"spectrum L\" \"stdillum-F11\"\n"
                          "Material \"diffuse\" \"spectrum reflectance\" [530 .1 550 .9 570 .1]\n" +
                              kFloor);
  const std::string film = "Film \"rgb\"";
  text.insert(text.find(film) + film.size(), " \"string sensor\" \"canon_eos_5d_mkii\"");
  const Colour light = Colour::of(*named_spectrum("stdillum-F11"), SpectrumRole::illuminant);
  const SpectralCurve dye{{530, 550, 570}, {0.1f, 0.9f, 0.1f}};
  const auto reflected = [&](int nm) { return light.spectrum->at(nm) * dye.at(static_cast<float>(nm)); };
  std::array<double, 3> sum{};
  for (int nm = kFirstNm; nm <= kLastNm; ++nm)
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += named_sensor("canon_eos_5d_mkii")->part_of_white(nm)[c] * static_cast<double>(reflected(nm));
  const Rgb expected{static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
  const float tolerance = 0.01f * expected.g;
  EXPECT_GT(std::abs(expected.r - seen(reflected).r), 5 * tolerance);
  expect_near(mean_of(text, 512), expected, tolerance);
}

// Colours that Rec. 709 lacks: a render in RGB clamps them, a spectral one has smooth spectra of them.
TEST(Spectral, WideColoursAreKept) {
  const std::string path = R"("path" "integer maxdepth" 2)", space = "ColorSpace \"rec2020\"\n";
  const std::string dyed = space + kWhiteSky + "Material \"diffuse\" \"rgb reflectance\" [.2 .6 .15]\n" + kFloor;
  const Rgb dye = beyond_rec709({0.2f, 0.6f, 0.15f}, ColourSpace::rec2020, SpectrumRole::albedo);
  EXPECT_LT(dye.r, -0.02f);
  expect_near(mean_of(view(kSpectral, path, dyed), 256), dye, 0.004f);
  EXPECT_GE(mean_of(view("", path, dyed), 4).r, 0);
  const std::string sky = space + "LightSource \"infinite\" \"rgb L\" [.3 2 .3]\n";
  const Rgb light = beyond_rec709({0.3f, 2, 0.3f}, ColourSpace::rec2020, SpectrumRole::illuminant);
  expect_near(mean_of(view(kSpectral, path, sky), 256), light, 0.02f);
}

// The first lamp has nothing where the second one does, and their photons start together.
TEST(Spectral, LampsOfOtherRangesSharePhotons) {
  const std::string lamps = R"(LightSource "point" "point3 from" [0 0 1] "spectrum I@1" [450 0 460 1 600 1 610 0]
  "spectrum I@2" "stdillum-D65" "spectrum I@3" [480 1 700 1]
Material "diffuse" "rgb reflectance" [.6 .6 .6]
)" + kFloor;
  const auto all = [&](const std::string& integrator) {
    return TestScene("Frames 3\n" + view(kSpectral, integrator, lamps)).render_all(128);
  };
  const std::vector<Image> expected = all(R"("path" "integer maxdepth" 2)");
  for (const char* integrator :
       {R"("dsppm" "integer photons" 20000 "string direct" "photons" "float radius" .1)",
        R"("dsppm" "integer photons" 20000 "string direct" "photons" "float radius" .1 "string estimator" "hj09")",
        R"("vcm" "integer photons" 5000 "float radius" .1)"}) {
    SCOPED_TRACE(integrator);
    const std::vector<Image> found = all(integrator);
    for (std::size_t frame = 0; frame < 3; ++frame) {
      const Rgb right = mean(expected[frame]);
      expect_near(mean(found[frame]), right, 0.03f * max_component(right));
    }
  }
}

TEST(Spectral, MetalsMirrorByTheirIndices) {
  const SpectralCurve eta = *named_spectrum("metal-Au-eta"), k = *named_spectrum("metal-Au-k");
  const auto mirrored = [&](int nm) {
    return fresnel_conductor(1, eta.at(static_cast<float>(nm)), k.at(static_cast<float>(nm)));
  };
  const std::string gold =
      kWhiteSky + "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\"\n" + kFloor;
  expect_near(mean_of(view(kSpectral, R"("path")", gold), 64), seen(mirrored), 0.01f);
}

TEST(Spectral, GlassAbsorbsByWavelength) {
  const SmoothSpectrum& left = SmoothSpectra::all().at(14, 8, 2);
  const std::string pane = kWhiteSky + R"(Material "dielectric" "float eta" 1 "rgb attenuationcolor" [.875 .5 .125]
Shape "trianglemesh" "point3 P" [-3 -3 -3 3 -3 -3 3 3 -3 -3 3 -3  -3 -3 0 3 -3 0 3 3 0 -3 3 0]
  "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
)";
  const Rgb expected = seen([&](int nm) { return std::pow(left.at(nm), 3.02f); });  // on average over the view
  expect_near(mean_of(view(kSpectral, R"("path" "integer maxdepth" 8)", pane), 64), expected, 0.015f);
}

// Dye that absorbs in one band: what is left of light in it is exp(-sigma d) at each wavelength, in an even medium and in a
// grid, whose bounds must be those of the band.
TEST(Spectral, MediaAbsorbByTheirSpectra) {
  const SpectralCurve band{{480, 520, 560}, {0.05f, 2, 0.05f}};
  const Rgb expected =
      seen([&](int nm) { return std::exp(-2.f * band.at(std::clamp(static_cast<float>(nm), 480.f, 560.f))); });
  for (
      const char* medium :
      {R"("string type" "homogeneous")",
       R"("string type" "uniformgrid" "integer nx" 3 "integer ny" 3 "integer nz" 3 "point3 p0" [-9 -9 -9] "point3 p1" [9 9 9]
           "float density" [1 1 1 1 1 1 1 1 1  1 1 1 1 1 1 1 1 1  1 1 1 1 1 1 1 1 1])"}) {
    const std::string contents = kWhiteSky + "MakeNamedMedium \"dye\" " + medium +
                                 R"( "spectrum sigma_a" [480 .05 520 2 560 .05] "rgb sigma_s" [0 0 0]
MediumInterface "dye" ""
Material "interface"
Shape "trianglemesh" "point3 P" [-2 -2 -2 2 -2 -2 2 2 -2 -2 2 -2  -2 -2 0 2 -2 0 2 2 0 -2 2 0]
  "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
)";
    for (const char* integrator : {R"("path" "integer maxdepth" 8)", R"("dsppm" "integer photons" 2000)"}) {
      SCOPED_TRACE(std::string(medium) + integrator);
      expect_near(mean_of(view(kSpectral, integrator, contents), 128), expected, 0.02f);
    }
  }
}

// A flame of salt: behind so much of it that absorbs in one band there is Le (1 - exp(-sigma_a d)) of each wavelength.
TEST(Spectral, MediaGlowByTheirSpectra) {
  const SpectralCurve band{{480, 520, 560}, {0.05f, 2, 0.05f}};
  const Colour lamp = Colour::of(*named_spectrum("stdillum-F11"), SpectrumRole::illuminant);
  const Rgb orange(3, 1, 0.2f);
  const auto absorbed = [&](int nm) { return band.at(std::clamp(static_cast<float>(nm), 480.f, 560.f)); };
  const SmoothSpectrum smooth(orange / 6, {});
  const auto blended = [&](int nm) {
    const auto [r, g, b] = SmoothSpectra::all().shares(nm);
    return 0.2f * r + 1 * g + 0.5f * b;
  };
  struct Case {
    std::string sigma_a, radiance;
    std::function<float(int)> absorbed, shining;
  };
  const std::string dyed = R"( "spectrum sigma_a" [480 .05 520 2 560 .05])", lit = R"( "spectrum Le" "stdillum-F11")";
  for (const Case& each : {Case{dyed, lit, absorbed, [&](int nm) { return lamp.spectrum->at(nm); }},
                           {dyed, R"( "rgb Le" [3 1 .2])", absorbed, [&](int nm) { return 6 * smooth.at(nm); }},
                           {R"( "rgb sigma_a" [.2 1 .5])", R"( "rgb Le" [1 1 1])", blended, [](int) { return 1.f; }}})
    for (const char* medium :
         {R"("string type" "homogeneous" "float Lescale" 2)",
          R"("string type" "uniformgrid" "float Lescale" 2 "integer nx" 2 "integer ny" 2 "integer nz" 2
             "point3 p0" [-9 -9 -9] "point3 p1" [9 9 9] "float density" [1 1 1 1  1 1 1 1])"}) {
      const std::string contents = std::string("MakeNamedMedium \"salt\" ") + medium + each.sigma_a + each.radiance +
                                   R"( "rgb sigma_s" [0 0 0]
MediumInterface "salt" ""
Material "interface"
Shape "trianglemesh" "point3 P" [-2 -2 -2 2 -2 -2 2 2 -2 -2 2 -2  -2 -2 0 2 -2 0 2 2 0 -2 2 0]
  "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
)";
      const Rgb expected = seen([&](int nm) { return 2 * each.shining(nm) * (1 - std::exp(-2 * each.absorbed(nm))); });
      for (const char* integrator : {R"("path" "integer maxdepth" 8)", R"("dsppm" "integer photons" 2000)"}) {
        SCOPED_TRACE(medium + each.sigma_a + each.radiance + integrator);
        expect_near(mean_of(view(kSpectral, integrator, contents), 128), expected, 0.03f * max_component(expected));
      }
    }
}

// A ball that glows lights the floor below it, whether paths find it or photons bring it: by Le (1 - exp(-sigma_a chord)) from
// each direction.
TEST(Spectral, GlowOfMediaLightsByItsSpectrum) {
  constexpr float kRadius = 1.6f, kHeight = 3.2f;
  const SpectralCurve band{{480, 520, 560}, {0.05f, 2, 0.05f}};
  const Colour lamp = Colour::of(*named_spectrum("stdillum-F11"), SpectrumRole::illuminant);
  const auto irradiance_over_pi = [&](int nm) {
    const float sigma_a = band.at(std::clamp(static_cast<float>(nm), 480.f, 560.f));
    constexpr int kSteps = 100;
    const float most = kRadius * kRadius / (kHeight * kHeight);  // the square of the sine
    float sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float sin2 = most * (static_cast<float>(i) + 0.5f) / kSteps;
      const float chord = 2 * std::sqrt(kRadius * kRadius - kHeight * kHeight * sin2);
      sum += 1 - std::exp(-sigma_a * chord);
    }
    return lamp.spectrum->at(nm) * sum * most / kSteps;
  };
  const Rgb expected = 0.5f * seen(irradiance_over_pi);
  const std::string contents =
      fmt::format(R"(MakeNamedMedium "salt" "string type" "homogeneous" "spectrum Le" "stdillum-F11"
  "spectrum sigma_a" [480 .05 520 2 560 .05] "rgb sigma_s" [0 0 0]
AttributeBegin
  MediumInterface "salt" ""
  Material "interface"
  Translate 0 0 {}
  Shape "sphere" "float radius" {}
AttributeEnd
Material "diffuse" "rgb reflectance" [.5 .5 .5]
)",
                  kHeight, kRadius) +
      kFloor;
  for (const std::string& integrator : integrators()) {
    SCOPED_TRACE(integrator);
    expect_near(mean_of(view(kSpectral, integrator, contents), 512), expected, 0.06f * max_component(expected));
  }
}

TEST(Spectral, FilmsInterfereByWavelength) {
  constexpr double kBase = 1.5, kNm = 700;
  const std::string film = kWhiteSky + R"(Material "principled" "rgb basecolor" [0 0 0] "float roughness" 0
  "float eta" 1.5 "float iridescence" 1 "float iridescencethickness" 700 "float iridescenceeta" 1.9
)" + kFloor;
  const auto airy = [&](int nm) {
    const double eta = 1.9, outer = (eta - 1) / (eta + 1), inner = (kBase - eta) / (kBase + eta);
    const double phase = 2 * std::acos(-1.) * 2 * eta * kNm / nm, x = outer * inner;
    return (outer * outer + inner * inner - 2 * std::abs(x) * std::cos(phase)) /
           (1 + x * x - 2 * std::abs(x) * std::cos(phase));
  };
  expect_near(mean_of(view(kSpectral, R"("path")", film), 64), seen(airy), 0.01f);
}

// What glass refracts by one of the wavelengths alone is as much light as there was.
TEST(Spectral, DispersionKeepsTheLight) {
  const std::string contents = kWhiteSky + R"(Material "dielectric" "string glass" "SF11"
Shape "sphere" "float radius" .4
)";
  for (const std::string& integrator : integrators()) {
    SCOPED_TRACE(integrator);
    expect_near(mean_of(view(kSpectral, integrator, contents), 64), Rgb(1), 0.03f);
  }
}

// In a chart each patch has its colour, whatever the method; so images by wavelength are those by RGB if light meets
// one coloured thing only.
TEST(Spectral, OneBounceIsAsInRgb) {
  const std::string contents = kWhiteSky + "Material \"diffuse\" \"rgb reflectance\" [.9 .3 .1]\n" + kFloor;
  for (const std::string& integrator : integrators()) {
    SCOPED_TRACE(integrator);
    expect_near(mean_of(view(kSpectral, integrator, contents), 64), {0.9f, 0.3f, 0.1f}, 0.02f);
  }
}

/// Things, lamps and glass that change from frame to frame.
std::string animation(const std::string& integrator) {
  return kSpectral + "Frames 3\nIntegrator " + integrator + R"(
LookAt 0 1 4  0 .4 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
WorldBegin
AttributeBegin
Translate 0 2.5 0
Rotate 90 1 0 0
AreaLightSource "diffuse" "rgb L@1" [9 4 2] "rgb L@3" [2 4 9]
Shape "disk" "float radius" .6
AttributeEnd
LightSource "point" "spectrum I" "stdillum-F11" "float scale" 2 "point3 from" [1 2 2]
Material "diffuse" "rgb reflectance" [.7 .6 .4]
Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
DynamicBegin "ball"
  Keyframe 1 Translate -.5 .4 0
  Keyframe 3 Translate .5 .4 0
  KeyframeEnd
  Material "dielectric" "string glass" "F2"
  Shape "sphere" "float radius" .4
DynamicEnd
AttributeBegin
Translate .9 .35 -.5
Material "principled" "rgb basecolor@1" [.8 .1 .1] "rgb basecolor@3" [.1 .1 .8] "float roughness" .4
Shape "sphere" "float radius" .35
AttributeEnd
)";
}

class SpectralPromises : public testing::TestWithParam<const char*> {};

TEST_P(SpectralPromises, AreKept) {
  const std::string scene = animation(GetParam());
  for (const test::Verdict& verdict :
       {test::check_threads(scene), test::check_resume(scene), test::check_joint(scene), test::check_crop(scene)})
    EXPECT_TRUE(verdict.passed) << verdict.message;
}

INSTANTIATE_TEST_SUITE_P(Integrators, SpectralPromises,
                         testing::Values(R"("path")", R"("dsppm" "integer photons" 3000)",
                                         R"("dsppm" "string estimator" "hj09" "integer photons" 3000)",
                                         R"("vcm" "integer photons" 1500)"));

}  // namespace spectral_test
}  // namespace dspm
