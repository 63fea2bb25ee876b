// What files hold next to radiance: times iso / 100 times the seconds that the shutter is open, and never more than
// maxcomponentvalue; in EXR and PNG images, on contact sheets and in videos. And what --describe says of the camera's
// parameters is true.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dspm/image/image.h"
#include "dspm/output/contact_sheet.h"
#include "dspm/session/modules/all_plugins.h"
#include "tests/support/fake_ffmpeg.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace film_output_test {

constexpr int kWidth = 12, kHeight = 8, kPixels = kWidth * kHeight;

struct Exposure {
  std::string camera, film;  // parameters
  float factor;
};

/// Two frames under an even sky of these radiances.
std::string skies(const Exposure& exposure, const Rgb& first, const Rgb& second) {
  return fmt::format(R"(
Frames 2
Integrator "path" "integer iterations" 1
Camera "perspective" {}
Film "rgb" "integer xresolution" {} "integer yresolution" {} "string filename" "sky.exr" {}
WorldBegin
LightSource "infinite" "rgb L@1" [{} {} {}] "rgb L@2" [{} {} {}]
)",
                     exposure.camera, kWidth, kHeight, exposure.film, first.r, first.g, first.b, second.r, second.g,
                     second.b);
}

/// The view "standard": the sRGB curve, in 255 steps. [IEC 61966-2-1]
std::string srgb(const Rgb& color) {
  std::string bytes;
  for (int c = 0; c < 3; ++c) {
    const auto v = static_cast<double>(color[c]);
    const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    bytes.push_back(static_cast<char>(std::lround(255 * encoded)));
  }
  return bytes;
}

/// The bytes of the pixels within `place`.
std::string bytes_within(const Image& png, const PixelRect& place) {
  std::string bytes;
  for (int y = place.y0; y < place.y1; ++y)
    for (int x = place.x0; x < place.x1; ++x) bytes += srgb(png.at(x, y));
  return bytes;
}

std::string repeated(const std::string& pixel) {
  std::string bytes;
  for (int i = 0; i < kPixels; ++i) bytes += pixel;
  return bytes;
}

/// Renders both frames into every kind of file and expects `first` and `second` everywhere.
void expect_in_all_files(const std::string& scene, const Rgb& first, const Rgb& second) {
  const TemporaryDirectory directory;
  const FakeFfmpeg ffmpeg(kKeepAll);
  put_file(directory / "sky.pbrt", scene);  // in dspm's own language, a shutter exposes nothing
  const Outcome outcome = run(directory, {"sky.pbrt", "--float", "--png", "--contact-sheet", "sheet.png", "--video",
                                          "sky.mp4", "--view", "standard"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;

  const SheetLayout layout(2, kWidth, kHeight);
  const Image sheet = read_image(directory / "sheet.png");
  std::string video;
  for (const auto& [frame, color] : {std::pair(0, first), std::pair(1, second)}) {
    const std::string name = fmt::format("sky.{:04}", frame + 1), shown = repeated(srgb(color));
    SCOPED_TRACE(name);
    for (const Rgb& pixel : read_image(directory / (name + ".exr")).pixels)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], color[c], 1e-6f);
    EXPECT_EQ(bytes_within(read_image(directory / (name + ".png")), {0, 0, kWidth, kHeight}), shown) << "PNG";
    EXPECT_EQ(bytes_within(sheet, layout.place(frame)), shown) << "contact sheet";
    video += shown;
  }
  EXPECT_EQ(ffmpeg.input(), video);
}

/// A disc that glows and mirrors nothing, before this sky.
std::string disc(const Rgb& sky) {
  return fmt::format(R"(
Integrator "path" "integer iterations" 8
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" {} "integer yresolution" {} "string filename" "disc.exr" "bool savefp16" false
WorldBegin
LightSource "infinite" "rgb L" [{} {} {}]
AreaLightSource "diffuse" "rgb L" [.6 .3 .05] "bool twosided" true
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "disk" "float radius" 1
)",
                     kWidth, kHeight, sky.r, sky.g, sky.b);
}

/// The largest difference between components.
float difference(const Image& a, const Image& b) {
  float largest = a.pixels.size() == b.pixels.size() ? 0 : kInfinity;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
  return largest;
}

/// In linear light.
Image laid_over(const Image& image, const Rgb& background) {
  Image result = image;
  for (std::size_t i = 0; i < image.alpha.size(); ++i)
    result.pixels[i] = image.alpha[i] * image.pixels[i] + (1 - image.alpha[i]) * background;
  return result;
}

/// Each is transparent, and over white, black and red what a render before white, black and red is.
TEST(FilmOutput, TransparentFilesHaveRightEdges) {
  const TemporaryDirectory directory;
  put_file(directory / "disc.dsc", disc(Rgb(0.3f)));
  const Arguments usual = {"disc.dsc", "--view", "standard"}, cut = usual + Arguments{"--transparent"};
  ASSERT_EQ(run(directory, cut + Arguments{"--png", "--denoise"}).code, 0);
  ASSERT_EQ(run(directory, cut + Arguments{"-o", "alone.png", "--png-bits", "16"}).code, 0);
  ASSERT_EQ(run(directory, cut + Arguments{"-o", "alone.webp"}).code, 0);
  const Image radiance = read_image(directory / "disc.exr");
  const auto edges =
      std::count_if(radiance.alpha.begin(), radiance.alpha.end(), [](float a) { return a > 0 && a < 1; });
  ASSERT_GT(edges, 4);
  for (const auto& [name, background] :
       {std::pair("white", Rgb(1)), std::pair("black", Rgb()), std::pair("#ff0000", Rgb(1, 0, 0))}) {
    put_file(directory / "before.dsc", disc(background));
    ASSERT_EQ(run(directory, {"before.dsc", "--view", "standard", "-o", "before.png"}).code, 0);
    const Image before = read_image(directory / "before.png");
    for (const char* const file : {"disc.png", "alone.png", "alone.webp"}) {
      const Image image = read_image(directory / file);
      EXPECT_EQ(image.alpha.size(), static_cast<std::size_t>(kPixels)) << file;
      EXPECT_LT(difference(laid_over(image, background), before), 0.009f) << file << " over " << name;
    }
    ASSERT_EQ(run(directory, usual + Arguments{"--background", name, "-o", "on.png", "--sheet", "sheet.png"}).code, 0);
    const Image on = read_image(directory / "on.png");
    EXPECT_TRUE(on.alpha.empty());
    EXPECT_LT(difference(on, before), 0.006f) << name;
    const PixelRect place = SheetLayout(1, kWidth, kHeight).place(0);
    EXPECT_EQ(bytes_within(read_image(directory / "sheet.png"), place), bytes_within(on, {0, 0, kWidth, kHeight}));
  }
  EXPECT_FALSE(read_image(directory / "disc.denoised.png").alpha.empty());
}

/// The alpha of a shadow, and what has no room for alpha says so.
TEST(FilmOutput, CatchersGoToTransparentFiles) {
  const TemporaryDirectory directory;
  put_file(directory / "catcher.dsc", disc(Rgb(0.8f)) + R"(
Translate 0 -1.2 0 Rotate 90 1 0 0 Shape "disk" "float radius" 9 "bool shadowcatcher" true
)");
  ASSERT_EQ(run(directory, {"catcher.dsc", "--png"}).code, 0);
  ASSERT_EQ(run(directory, {"catcher.dsc", "-o", "alone.webp"}).code, 0);
  const Image radiance = read_image(directory / "disc.exr"), png = read_image(directory / "disc.png"),
              webp = read_image(directory / "alone.webp");
  ASSERT_EQ(png.alpha.size(), static_cast<std::size_t>(kPixels));
  EXPECT_EQ(webp.alpha, png.alpha);
  int shadows = 0;
  for (std::size_t i = 0; i < png.alpha.size(); ++i) {
    if (max_component(radiance.pixels[i]) > radiance.alpha[i]) continue;  // light beyond alpha is added
    EXPECT_NEAR(png.alpha[i], std::max(radiance.alpha[i], 0.f), 0.004f) << i;
    shadows += radiance.alpha[i] > 0.02f && radiance.alpha[i] < 0.5f ? 1 : 0;
  }
  EXPECT_GT(shadows, 2);
  const Outcome outcome = run(directory, {"catcher.dsc", "-o", "alone.hdr"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("alone.hdr cannot hold alpha"), outcome.err.npos) << outcome.err;
  const Outcome wide = run(directory, {"catcher.dsc", "-o", "alone.webp", "--resolution", "16384x1"});
  EXPECT_EQ(wide.err, "dspm: alone.webp: WebP images have at most 16383 pixels a side\n") << "before it renders";
}

const Rgb kFirst{0.4f, 0.2f, 0.1f}, kSecond{0.05f, 0.1f, 0.3f};

TEST(FilmOutput, HoldsRadianceTimesExposure) {
  const std::vector<Exposure> exposures = {
      {"", "", 1},
      {"", R"("float iso" 150)", 1.5f},
      {R"("float shutterclose" 0.5)", "", 0.5f},
      {R"("float shutteropen" 0.25)", "", 0.75f},
      {R"("float shutteropen" 2 "float shutterclose" 6)", R"("float iso" 25)", 1},
      {R"("float shutteropen" 0.5 "float shutterclose" 0.75)", R"("float iso" 640)", 1.6f},
      {R"("float shutteropen" 1 "float shutterclose" 1)", R"("float iso" 50)", 0.5f},  // never open: taken for 1 s
  };
  for (const Exposure& exposure : exposures) {
    SCOPED_TRACE(exposure.camera + exposure.film);
    expect_in_all_files(skies(exposure, kFirst, kSecond), kFirst * exposure.factor, kSecond * exposure.factor);
  }
}

// Limited are the values after exposure, all components alike, and only where one is above the limit.
TEST(FilmOutput, LimitsTheLargestComponent) {
  const Exposure exposure{"", R"("float iso" 200 "float maxcomponentvalue" 0.6)", 2};
  expect_in_all_files(skies(exposure, Rgb(2, 1, 0.5f), Rgb(0.1f, 0.2f, 0.3f)), Rgb(0.6f, 0.3f, 0.15f),
                      Rgb(0.2f, 0.4f, 0.6f));
  expect_in_all_files(skies(exposure, Rgb(0.25f, 0.5f, 50), Rgb(0.25f, 0.29f, 0.1f)), Rgb(0.003f, 0.006f, 0.6f),
                      Rgb(0.5f, 0.58f, 0.2f));
}

// It says what blurs; brightness is for "iso".
TEST(FilmOutput, AShutterOfFramesExposesNothing) {
  const TemporaryDirectory directory;
  for (const char* shutter : {R"("float shutterclose" 0.5)", R"("float shutteropen" 0.25 "float shutterclose" 3)"}) {
    put_file(directory / "sky.dsc", skies({shutter, "", 1}, kFirst, kSecond));
    const Outcome outcome = run(directory, {"sky.dsc", "--no-blur", "--float"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NEAR(read_image(directory / "sky.0001.exr").at(3, 3).r, kFirst.r, 1e-6f);
  }
}

/// A ball before a floor, well before the plane of focus.
Image ball(const TemporaryDirectory& directory, const std::string& camera, const std::string& parameters) {
  put_file(directory / "ball.pbrt", fmt::format(R"(
Integrator "path" "integer iterations" 4
Camera "{}" {}
Film "rgb" "integer xresolution" 24 "integer yresolution" 16 "string filename" "ball.exr"
WorldBegin
LightSource "point" "rgb I" [20 20 20]
Translate 0.3 0.2 3
Shape "sphere" "float radius" 0.5
Shape "disk" "float radius" 20 "float height" 2
)",
                                                camera, parameters));
  const Outcome outcome = run(directory, {"ball.pbrt", "--float"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return read_image(directory / "ball.exr");
}

// Each parameter is given in place of the one that stands for it here; the image differs unless "without effect".
TEST(DescribedCamera, ParametersHaveTheEffectThatIsClaimed) {
  const std::vector<std::pair<std::string, std::string>> before_after = {
      {R"("float fov" 60)", R"("float fov" 40)"},
      {R"("float lensradius" 0.1)", R"("float lensradius" 0.3)"},
      {R"("integer blades" 5)", R"("integer blades" 3)"},
      {R"("float bladerotation" 10)", R"("float bladerotation" 30)"},
      {"", R"("float anamorphic" 3)"},
      {R"("float focaldistance" 8)", R"("float focaldistance" 3)"},
      {R"("float frameaspectratio" 1.5)", R"("float frameaspectratio" 1.1)"},
      {R"("float shutteropen" 0)", R"("float shutteropen" 0.5)"},
      {R"("float shutterclose" 1)", R"("float shutterclose" 0.5)"},
      {"", R"("float screenwindow" [-1 2 -1 1])"},
      {"", R"("string mapping" "equirectangular")"},
      {R"("string lensfile" "pair.dat")", R"("string lensfile" "weaker.dat")"},
      {R"("float aperturediameter" 14)", R"("float aperturediameter" 7)"},
      {R"("float focusdistance" 8)", R"("float focusdistance" 3)"},
      {"", R"("string aperture" "star")"},
      {"", R"("bool simpleweighting" true)"},
  };
  const auto all_with = [&](const CatalogueEntry& camera, const std::string& changed) {
    std::string parameters;
    for (const ParamInfo& info : camera.params())
      for (const auto& [before, after] : before_after)
        if (after.find(" " + info.name + "\"") != after.npos)
          parameters += (info.name == changed ? after : before) + " ";
    return parameters;
  };
  const TemporaryDirectory directory;
  // Two bulges around a stop.
  put_file(directory / "pair.dat", "55 5 1.6 24\n-400 6 1 24\n0 6 0 14\n400 5 1.6 24\n-55 40 1 24\n");
  put_file(directory / "weaker.dat", "55 5 1.5 24\n-400 6 1 24\n0 6 0 14\n400 5 1.5 24\n-55 40 1 24\n");
  int described = 0;
  for (const CatalogueEntry& camera : all_plugins()) {
    if (camera.kind != "camera") continue;
    const Image plain = ball(directory, camera.name, all_with(camera, ""));
    for (const ParamInfo& info : camera.params()) {
      const bool claims_none = info.sentence.find("without effect") != info.sentence.npos;
      EXPECT_EQ(ball(directory, camera.name, all_with(camera, info.name)) == plain, claims_none)
          << camera.name << ", " << info.name << ": " << info.sentence;
      const bool says_exposure = info.sentence.find("images are multiplied by") != info.sentence.npos;
      EXPECT_EQ(says_exposure, info.name.starts_with("shutter")) << info.name << ": " << info.sentence;
      ++described;
    }
  }
  EXPECT_GE(described, 20);
}

}  // namespace film_output_test
}  // namespace dspm::test
