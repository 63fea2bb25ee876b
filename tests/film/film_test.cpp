#include "dspm/image/film/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

Param param(ParamType type, std::string name, Param::Values values) {
  Param result;
  result.type = type, result.name = std::move(name), result.values = std::move(values);
  return result;
}
Param numbers(std::string name, std::vector<float> v) {
  return param(ParamType::number, std::move(name), std::move(v));
}
Param integers(std::string name, std::vector<int> v) {
  return param(ParamType::integer, std::move(name), std::move(v));
}
Param text(std::string name, std::string v) {
  return param(ParamType::text, std::move(name), std::vector<std::string>{std::move(v)});
}

struct Reading {
  FilmSettings film;
  Diagnostics diagnostics;
};

Reading read(const std::vector<Param>& params, const char* film = "rgb") {
  Reading result;
  const ParamList list{params};
  ParamReader reader(list, "film", {}, result.diagnostics);
  result.film = *film_plugins().find(film)->make(reader);
  return result;
}

TEST(Film, DefaultsArePbrts) {
  const Reading r = read({});
  EXPECT_EQ(r.diagnostics.error_count(), 0);
  EXPECT_EQ(r.film.width, 1280);
  EXPECT_EQ(r.film.height, 720);
  EXPECT_EQ(r.film.filename, "pbrt.exr");
  EXPECT_EQ(r.film.diagonal, 0.035f);
  EXPECT_EQ(r.film.iso, 100);
  EXPECT_EQ(r.film.max_component, kInfinity);
  EXPECT_TRUE(r.film.save_half);
  EXPECT_EQ(crop_of(r.film), (PixelRect{0, 0, 1280, 720}));
  EXPECT_EQ(imaging_ratio(r.film, 1), 1.f);
}

TEST(Film, ReadsWhatIsGiven) {
  const Reading r = read({integers("xresolution", {64}), integers("yresolution", {32}), text("filename", "a.png"),
                          numbers("iso", {200}), numbers("maxcomponentvalue", {10}), numbers("diagonal", {50}),
                          param(ParamType::boolean, "savefp16", std::vector<bool>{false})});
  EXPECT_EQ(r.diagnostics.error_count(), 0);
  EXPECT_EQ(r.film.width, 64);
  EXPECT_EQ(r.film.height, 32);
  EXPECT_EQ(r.film.filename, "a.png");
  EXPECT_EQ(r.film.max_component, 10);
  EXPECT_EQ(r.film.diagonal, 0.05f);
  EXPECT_FALSE(r.film.save_half);
  EXPECT_EQ(imaging_ratio(r.film, 0.5f), 1.f);
}

TEST(Film, WrongValuesAreErrors) {
  const std::vector<std::vector<Param>> wrong = {{integers("xresolution", {0})},
                                                 {integers("yresolution", {-5})},
                                                 {integers("xresolution", {1'000'000})},
                                                 {text("filename", "a.jpg")},
                                                 {text("filename", "a")},
                                                 {numbers("cropwindow", {0, 1, 0})},
                                                 {numbers("cropwindow", {0, 1, 1, 1})},
                                                 {integers("pixelbounds", {10, 5, 0, 5})},
                                                 {integers("pixelbounds", {0, 5})},
                                                 {integers("pixelbounds", {2000, 3000, 0, 5})},
                                                 {numbers("iso", {0})},
                                                 {numbers("maxcomponentvalue", {-1})},
                                                 {text("sensor", "canon_eos")},
                                                 {numbers("whitebalance", {500})}};
  for (const auto& params : wrong) EXPECT_GT(read(params).diagnostics.error_count(), 0) << params.front().name;
}

TEST(Film, Cie1931StandsInForSensorsWithoutMeasurements) {
  const Reading r = read({text("sensor", "canon_eos_5d"), numbers("whitebalance", {5000})});
  ASSERT_EQ(r.diagnostics.all().size(), 1u);
  EXPECT_EQ(r.diagnostics.all()[0].severity, Severity::note);
  EXPECT_EQ(r.film.sensor, nullptr);
  EXPECT_EQ(r.film.white_kelvin, 5000);
  EXPECT_EQ(read({text("sensor", "nikon_d850")}).film.white_kelvin, 6500);  // pbrt's for real sensors
  EXPECT_EQ(read({text("sensor", "cie1931")}).film.white_kelvin, 0);
}

TEST(Film, HasMeasuredSensors) {
  const Reading named = read({text("sensor", "canon_eos_5d_mkii")});
  EXPECT_TRUE(named.diagnostics.all().empty());
  ASSERT_NE(named.film.sensor, nullptr);
  EXPECT_EQ(named.film.white_kelvin, 6500);
  const test::TemporaryDirectory directory;
  const auto of_file = [&](const std::string& contents) {
    test::put_file(directory / "mine.txt", contents);
    return read({text("sensorfile", (directory / "mine.txt").string())});
  };
  const Reading mine = of_file("# nm, red, green, blue\n400,0,0,1\n 500 0 1 .2\n600 1 .2 0\n700 0 0 0\n");
  EXPECT_TRUE(mine.diagnostics.all().empty());
  EXPECT_NE(mine.film.sensor, nullptr);
  for (const char* wrong : {"", "400 0 0 1", "400 0 0 1 500 0 1", "400 0 0 1 400 0 1 0", "400 1 1 1 700 1 1 1",
                            "400 0 0 1 700 0 0 1", "red green blue", "400 -1 0 1 500 -1 1 1 700 -1 1 1"}) {
    const Reading r = of_file(wrong);
    EXPECT_EQ(r.diagnostics.error_count(), 1) << wrong;
  }
  EXPECT_EQ(read({text("sensorfile", "nowhere.txt")}).diagnostics.error_count(), 1);
}

TEST(Film, ASpectralFilmIsRenderedByWavelength) {
  const Reading r = read({integers("xresolution", {64}), text("filename", "a.exr"), integers("nbuckets", {8}),
                          numbers("lambdamin", {400}), numbers("cropwindow", {0, 0.5f, 0, 1})},
                         "spectral");
  ASSERT_EQ(r.diagnostics.all().size(), 1u);
  EXPECT_EQ(r.diagnostics.all()[0].severity, Severity::note);
  EXPECT_TRUE(r.film.spectral);
  EXPECT_FALSE(read({}).film.spectral);
  EXPECT_EQ(r.film.filename, "a.exr");
  EXPECT_EQ(crop_of(r.film).x1, 32);
  EXPECT_EQ(read({numbers("lambdamin", {900})}, "spectral").diagnostics.error_count(), 1);
  EXPECT_EQ(read({integers("nbuckets", {0})}, "spectral").diagnostics.error_count(), 1);
}

TEST(Film, ExposureTimeMultiplies) {
  EXPECT_FLOAT_EQ(imaging_ratio(read({numbers("iso", {200}), numbers("exposuretime", {0.25f})}).film, 1), 0.5f);
  EXPECT_GT(read({numbers("exposuretime", {0})}).diagnostics.error_count(), 0);
}

/// pbrt-v4, film.cpp: edges at ceil(resolution * fraction) in single precision, fractions sorted and clamped.
TEST(Film, CropWindowsRoundAsInPbrt) {
  FilmSettings film;
  film.width = 101, film.height = 77;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 40; ++j) {
      const float a = static_cast<float>(i) / 30 - 0.1f, b = static_cast<float>(j) / 30 - 0.1f;
      film.crop_window = {a, b, b, a};
      const float low = std::min(std::max(std::min(a, b), 0.f), 1.f),
                  high = std::min(std::max(std::max(a, b), 0.f), 1.f);
      const PixelRect crop = crop_of(film);
      EXPECT_EQ(crop.x0, static_cast<int>(std::ceil(101.f * low)));
      EXPECT_EQ(crop.x1, static_cast<int>(std::ceil(101.f * high)));
      EXPECT_EQ(crop.y0, static_cast<int>(std::ceil(77.f * low)));
      EXPECT_EQ(crop.y1, static_cast<int>(std::ceil(77.f * high)));
    }
  }
}

/// Windows that share an edge share no pixel and leave none out.
TEST(Film, NeighbouringCropWindowsTile) {
  FilmSettings film;
  film.width = 101, film.height = 77;
  int pixels = 0;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      const auto at = [](int k) { return static_cast<float>(k) / 9; };
      film.crop_window = {at(i), at(i + 1), at(j), at(j + 1)};
      pixels += crop_of(film).count();
    }
  }
  EXPECT_EQ(pixels, 101 * 77);
}

TEST(Film, PixelBoundsAreClampedAndGiveWay) {
  FilmSettings film;
  film.width = 100, film.height = 50;
  film.pixel_bounds = {-5, 20, 10, 500};
  EXPECT_EQ(crop_of(film), (PixelRect{0, 10, 20, 50}));
  film.crop_window = {0.5f, 1, 0, 0.5f};
  EXPECT_EQ(crop_of(film), (PixelRect{50, 0, 100, 25}));
  EXPECT_EQ(read({numbers("cropwindow", {0, 1, 0, 1}), integers("pixelbounds", {0, 9, 0, 9})}).diagnostics.all().size(),
            1u);
}

TEST(Film, ScaledIsTheSamePicture) {
  FilmSettings film;
  film.width = 103, film.height = 3;
  EXPECT_EQ(scaled(film, 0.25).width, 25);
  EXPECT_EQ(scaled(film, 0.25).height, 1);
  EXPECT_EQ(scaled(film, 1e9).width, 65536);
  film.width = 100, film.height = 50;
  film.pixel_bounds = {10, 20, 20, 50};
  EXPECT_EQ(crop_of(scaled(film, 0.5)), (PixelRect{5, 10, 10, 25}));
  EXPECT_EQ(crop_of(scaled(film, 300, 50)), (PixelRect{30, 20, 60, 50}));
  EXPECT_FALSE(crop_of(scaled(film, 0.01)).empty());
}

TEST(Film, LimitedKeepsTheHue) {
  EXPECT_EQ(limited(Rgb(4, 2, 1), 2), Rgb(2, 1, 0.5f));
  EXPECT_EQ(limited(Rgb(4, 2, 1), kInfinity), Rgb(4, 2, 1));
}

// What daylight of that temperature lights becomes white.
TEST(Film, WhiteBalanceMakesItsDaylightWhite) {
  FilmSettings film;
  EXPECT_FALSE(white_balance(film));
  for (const float kelvin : {2500.f, 5000.f, 9000.f}) {
    film.white_kelvin = kelvin;
    const Chromaticity white = white_of(static_cast<double>(kelvin));
    const Chromaticities& rec709 = chromaticities(ColourSpace::srgb);
    const ColourMatrix to_rgb = rgb_from_xyz(rec709);
    Rgb daylight;
    const double xyz[] = {white.x / white.y, 1, (1 - white.x - white.y) / white.y};
    for (int c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k)
        daylight[c] += static_cast<float>(to_rgb[static_cast<std::size_t>(c)][k] * xyz[k]);
    const Rgb balanced = *white_balance(film) * daylight;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(balanced[c], 1, 1e-4f) << kelvin;
  }
}

TEST(Film, OtherColourSpacesKeepWhite) {
  FilmSettings film;
  EXPECT_FALSE(to_film_space(film));
  for (const ColourSpace space : {ColourSpace::rec2020, ColourSpace::dci_p3}) {
    film.space = space;
    const Rgb white = *to_film_space(film) * Rgb(1),
              back = to_rec709(*to_film_space(film) * Rgb(.2f, .7f, .4f), space, SpectrumRole::albedo);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-5f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], Rgb(.2f, .7f, .4f)[c], 1e-5f);
  }
}

TEST(Film, DescribesItsParameters) {
  const auto described = describe(film_plugins().front());
  EXPECT_EQ(described.size(), 14u);
}

}  // namespace
}  // namespace dspm
