#include "dspm/output/write_image.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

using test::TemporaryDirectory;

TEST(WriteImage, ACropKnowsItsPlace) {
  const TemporaryDirectory directory;
  FilmSettings film;
  film.width = 40, film.height = 20, film.crop_window = {0.25f, 0.5f, 0.5f, 1};
  const PixelRect crop = crop_of(film);
  ExrHeader header;
  header.integers["seed"] = 3;
  write_image(directory / "a.exr", Image(crop.width(), crop.height()), film, header);

  const ExrHeader back = read_exr_header(directory / "a.exr");
  EXPECT_EQ(back.x, 10);
  EXPECT_EQ(back.y, 10);
  EXPECT_EQ(back.full_width, 40);
  EXPECT_EQ(back.full_height, 20);
  EXPECT_EQ(back.integers.at("seed"), 3);
  EXPECT_EQ(read_image(directory / "a.exr").width, 10);
}

TEST(WriteImage, PngGoesThroughTheToneMap) {
  const TemporaryDirectory directory;
  FilmSettings film;
  film.width = film.height = 1;
  Image image(1, 1);
  image.at(0, 0) = {8, 2, 0};
  write_image(directory / "a.png", image, film, {}, {0.5f, false});
  EXPECT_EQ(read_image(directory / "a.png").at(0, 0), Rgb(1, 1, 0));
}

TEST(WriteImage, OtherEndingsAreErrors) {
  const TemporaryDirectory directory;
  EXPECT_THROW(write_image(directory / "a.tif", Image(1, 1), {}, {}), std::runtime_error);
  EXPECT_EQ(directory.file_count(), 0);
}

}  // namespace
}  // namespace dspm
