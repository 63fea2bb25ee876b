#include "dspm/looking/image_tasks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "dspm/base/params/errors.h"
#include "dspm/image/encoding.h"
#include "dspm/image/exr.h"
#include "dspm/image/png.h"
#include "dspm/looking/error_figures.h"
#include "dspm/looking/false_colour.h"
#include "dspm/looking/flicker.h"
#include "dspm/looking/shown_file.h"
#include "tests/support/fake_ffmpeg.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace image_tasks_test {

using test::TemporaryDirectory;

Image flat(int width, int height, const Rgb& colour) {
  Image image(width, height);
  for (Rgb& pixel : image.pixels) pixel = colour;
  return image;
}

TEST(ErrorFigures, AreThoseOfTheDefinition) {
  const Image reference = flat(4, 2, Rgb(2));
  Image test = reference;
  test.at(3, 1) = Rgb(2, 5, 2);
  const ErrorFigures figures = error_figures(reference, test);
  EXPECT_NEAR(figures.rmse, std::sqrt(9. / 24), 1e-12);
  EXPECT_NEAR(figures.relative_rmse.value(), std::sqrt(2.25 / 24), 1e-12);
  EXPECT_NEAR(figures.bias.value(), 3. / 24 / 2, 1e-12);
  EXPECT_EQ(figures.largest, 3);
  EXPECT_EQ(figures.x, 3);
  EXPECT_EQ(figures.y, 1);
  EXPECT_THROW(error_figures(reference, Image(2, 4)), std::runtime_error);
}

TEST(ErrorFigures, BlackReferencesCountAsAHundredthOfTheMean) {
  Image reference = flat(2, 1, Rgb(0)), test = reference;
  reference.at(0, 0) = test.at(0, 0) = Rgb(2);
  test.at(1, 0) = Rgb(0.01f);
  EXPECT_NEAR(error_figures(reference, test).relative_rmse.value(), std::sqrt(0.5), 1e-6);
}

TEST(ErrorFigures, LeaveOutPixelsThatAreNotFinite) {
  Image reference = flat(4, 1, Rgb(2)), test = flat(4, 1, Rgb(3));
  reference.at(0, 0).g = std::numeric_limits<float>::quiet_NaN(), test.at(1, 0).b = INFINITY;
  const ErrorFigures figures = error_figures(reference, test);
  EXPECT_EQ(figures.left_out, 2);
  EXPECT_EQ(figures.rmse, 1);
  EXPECT_EQ(figures.bias.value(), 0.5);
  EXPECT_EQ(figures.largest, 1);
}

TEST(ErrorFigures, AreNotRelativeToABlackReference) {
  const ErrorFigures figures = error_figures(flat(2, 2, Rgb(0)), flat(2, 2, Rgb(3)));
  EXPECT_EQ(figures.rmse, 3);
  EXPECT_FALSE(figures.relative_rmse || figures.bias);
}

TEST(ErrorFigures, AnImageWithoutAlphaIsOpaque) {
  Image half = flat(2, 1, Rgb(1));
  half.alpha = {1, 0.5f};
  EXPECT_NEAR(error_figures(flat(2, 1, Rgb(1)), half).alpha_rmse.value(), 0.5 / std::sqrt(2.), 1e-7);
  EXPECT_FALSE(error_figures(flat(2, 1, Rgb(1)), flat(2, 1, Rgb(1))).alpha_rmse);
}

/// Noise that is independent from frame to frame, of a known deviation on a screen's scale.
Image noisy(double deviation, double brightness, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(brightness, deviation);
  Image image(64, 64);
  for (Rgb& pixel : image.pixels) pixel = Rgb(srgb_to_linear(static_cast<float>(noise(random))));
  return image;
}

TEST(Flicker, IsTheDeviationOfIndependentNoise) {
  FlickerMeter meter;
  for (unsigned frame = 0; frame < 12; ++frame) meter.add(noisy(0.02, 0.3 + 0.02 * frame, frame));
  const Flicker flicker = meter.result();
  EXPECT_NEAR(flicker.rms, 0.02, 4e-4) << "40,960 values; steady change does not count";
  EXPECT_NEAR(flicker.typical, 0.02, 8e-4);
}

TEST(Flicker, WhatMovesInAFewPixelsIsNotTypical) {
  FlickerMeter meter;
  for (int frame = 0; frame < 8; ++frame) {
    Image image = flat(40, 40, Rgb(0.2f));
    for (int y = 0; y < 40; ++y) image.at(frame, y) = Rgb(0.9f);
    meter.add(image);
  }
  EXPECT_GT(meter.result().rms, 0.01);
  EXPECT_LT(meter.result().typical, 1e-6);
  EXPECT_EQ(meter.result().rms_of_pixel[30], 0);
  EXPECT_GT(meter.result().rms_of_pixel[3], 0.1);
}

TEST(Flicker, NeedsThreeFramesOfOneSize) {
  FlickerMeter meter;
  meter.add(Image(4, 4));
  meter.add(Image(4, 4));
  EXPECT_THROW(meter.result(), std::runtime_error);
  EXPECT_THROW(meter.add(Image(5, 4)), std::runtime_error);
}

TEST(FalseColour, RunsFromBlackToPaleYellow) {
  const Image image = false_colours({0, 0.25f, 0.5f, 5, -1, NAN}, 3);
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  float last = -1;
  for (std::size_t i = 0; i < 4; ++i) {
    const float brightness = luminance(image.pixels[i]);
    EXPECT_GT(brightness, last);
    last = brightness;
  }
  EXPECT_NEAR(linear_to_srgb(image.at(0, 1).r), 0xfc / 255., 1e-3);
  EXPECT_EQ(image.at(1, 1), image.at(0, 0));
  EXPECT_EQ(image.at(2, 1), image.at(0, 0));
}

TEST(ShownFile, NumbersAreInOrder) {
  const TemporaryDirectory directory;
  for (const char* name : {"a.10.exr", "a.9.exr", "a.1.exr", "a.x.exr", "b.1.exr", "a.1.exr.png"})
    write_png(directory / name, Image(1, 1));
  const auto path = [&](const char* name) { return (directory / name).string(); };
  EXPECT_EQ(numbered_files(path("a.##.exr")), (std::vector{path("a.1.exr"), path("a.9.exr"), path("a.10.exr")}));
  EXPECT_EQ(numbered_files(path("a.%d.exr")), numbered_files(path("a.####.exr")));
  EXPECT_EQ(numbered_files(path("c.exr")), std::vector{path("c.exr")});
  EXPECT_THROW(numbered_files(path("c.##.exr")), std::runtime_error);
}

TEST(ShownFile, OnlyRadianceGoesThroughTheView) {
  const TemporaryDirectory directory;
  const Image grey = flat(2, 2, Rgb(0.5f));
  write_exr(directory / "a.exr", grey, {});
  write_png(directory / "a.png", grey);
  const View view(ViewCurve::agx, 2);
  EXPECT_EQ(shown_file(directory / "a.exr", view).at(0, 0), view.shown(grey).at(0, 0));
  EXPECT_EQ(shown_file(directory / "a.png", view), read_image(directory / "a.png"));
}

TEST(ImageTasks, CompareSaysItAndShowsIt) {
  const TemporaryDirectory directory;
  Image image = flat(20, 10, Rgb(0.2f));
  write_exr(directory / "a.exr", image, {}, ExrPixels::single);
  for (int y = 0; y < 10; ++y) image.at(15, y) = Rgb(0.8f);
  write_exr(directory / "b.exr", image, {}, ExrPixels::single);
  const std::string a = directory / "a.exr", b = directory / "b.exr", shown = directory / "errors.png";
  const std::string text = compare_images({{a, b}, {}, shown});
  EXPECT_NE(text.find("RMSE           0.134164\n"), std::string::npos) << text;  // 0.6 in a twentieth
  EXPECT_NE(text.find("relative RMSE  0.67082\n"), std::string::npos) << text;
  EXPECT_NE(text.find("FLIP           "), std::string::npos) << text;
  const Image colours = read_image(shown);
  EXPECT_EQ(colours.width, 20);
  EXPECT_GT(luminance(colours.at(15, 5)), 4 * luminance(colours.at(2, 5)));
  EXPECT_NE(compare_images({{a, a}, {}, shown}).find("FLIP           0,"), std::string::npos);
  EXPECT_THROW(compare_images({{a}, {}, shown}), UsageError);
  EXPECT_THROW(compare_images({{a, shown}, {}, shown}), UsageError) << "it would replace what it compares";
  EXPECT_THROW(compare_images({{a, b}, {}, directory / "errors.exr"}), UsageError);
}

// Of a crop and a whole image, the crop; of two crops, what they share.
TEST(ImageTasks, CompareTakesWhatBothShow) {
  const TemporaryDirectory directory;
  Image whole = flat(20, 10, Rgb(0.5f));
  whole.at(12, 6) = Rgb(0.9f);
  whole.at(0, 0) = Rgb(9);
  write_exr(directory / "whole.exr", whole, {}, ExrPixels::single);
  const auto put_crop = [&](const char* name, int x, int width) {
    ExrHeader header;
    header.x = x, header.y = 4, header.full_width = 20, header.full_height = 10;
    write_exr(directory / name, flat(width, 3, Rgb(0.5f)), header, ExrPixels::single);
  };
  put_crop("crop.exr", 11, 4), put_crop("left.exr", 2, 10), put_crop("far.exr", 0, 2);
  const std::string errors = directory / "errors.png";
  const auto compared = [&](const char* a, const char* b) {
    return compare_images({{directory / a, directory / b}, {}, errors});
  };
  const std::string text = compared("whole.exr", "crop.exr");
  EXPECT_NE(text.find("pixels         11, 4 to 14, 6 of 20 x 10\n"), std::string::npos) << text;
  EXPECT_NE(text.find("RMSE           0.11547\n"), std::string::npos) << text;  // 0.4 in one of twelve
  EXPECT_NE(text.find("largest error  0.4 at pixel 12, 6\n"), std::string::npos) << text;
  EXPECT_EQ(read_image(errors).width, 4);
  EXPECT_NE(compared("crop.exr", "whole.exr").find("RMSE           0.11547\n"), std::string::npos);
  EXPECT_NE(compared("left.exr", "crop.exr").find("pixels         11, 4 to 11, 6 of"), std::string::npos);
  EXPECT_THROW(compared("crop.exr", "far.exr"), std::runtime_error);
  write_exr(directory / "other.exr", flat(21, 10, Rgb(0.5f)), {}, ExrPixels::single);
  EXPECT_THROW(compared("whole.exr", "other.exr"), std::runtime_error);
}

TEST(ImageTasks, ASheetOfOldAndNewFiles) {
  const TemporaryDirectory directory;
  std::vector<std::string> files;
  for (int i = 0; i < 40; ++i) {
    files.push_back(directory / fmt::format("{}.{}", i, i < 32 ? "exr" : "png"));
    const Image image = flat(i == 3 ? 16 : 32, 16, Rgb(0.01f * static_cast<float>(i), 0.2f, 0.1f));
    if (i < 32) write_exr(files.back(), image, {});
    if (i >= 32) write_png(files.back(), image);
  }
  const std::string page = directory / "page.png";
  const PageFiles pages{page, "", {.tile_width = 32}};
  make_pages({files, {.view = "standard"}, ""}, pages);
  const Image sheet = read_image(page);
  const SheetLayout layout(40, 32, 16, pages.style);
  EXPECT_EQ(sheet.width, layout.sheet_width());
  for (int i = 0; i < 40; ++i) {
    const PixelRect place = layout.place(i);
    EXPECT_NEAR(sheet.at(place.x0 + 16, place.y0 + 8).r, 0.01 * i, 3e-3) << i;
  }
  EXPECT_EQ(sheet.at(layout.place(3).x0, layout.place(3).y0), Rgb(0)) << "a narrower image stands on black";
  EXPECT_THROW(make_pages({files, {}, ""}, {files[2], "", {}}), UsageError) << "it would replace one";
  EXPECT_THROW(make_pages({files, {}, ""}, {}), UsageError);
}

TEST(ImageTasks, AVideoOfFiles) {
  const TemporaryDirectory directory;
  const test::FakeFfmpeg ffmpeg(test::kKeepAll);
  std::vector<std::string> files;
  for (int i = 0; i < 3; ++i) {
    files.push_back(directory / fmt::format("{}.exr", i));
    ExrHeader header;
    header.frames_per_second = 12;
    write_exr(files.back(), flat(4, 2, Rgb(0.25f * static_cast<float>(i))), header);
  }
  make_pages({files, {.view = "standard"}, ""}, {"", directory / "a.mp4", {}});
  std::string expected;
  for (int i = 0; i < 3; ++i) expected += srgb_bytes(flat(4, 2, Rgb(0.25f * static_cast<float>(i))));
  EXPECT_EQ(ffmpeg.input(), expected);
  write_exr(files[1], flat(2, 2, Rgb(1)), {});
  EXPECT_THROW(make_pages({files, {}, ""}, {"", directory / "a.mp4", {}}), std::runtime_error) << "sizes differ";
}

}  // namespace image_tasks_test
}  // namespace dspm
