#include "dspm/output/write_image.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace write_image_test {

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

TEST(WriteImage, PngGoesThroughTheView) {
  const TemporaryDirectory directory;
  FilmSettings film;
  film.width = film.height = 1;
  Image image(1, 1);
  image.at(0, 0) = {8, 2, 0};
  write_image(directory / "a.png", image, film, {}, View(ViewCurve::standard, 0.5f));
  EXPECT_EQ(read_image(directory / "a.png").at(0, 0), Rgb(1, 1, 0));
}

/// Three pixels wide and two high, of values far apart.
Image floats() {
  Image image(3, 2);
  image.pixels = {{1, 0.5f, 0}, {1e-6f, 3e5f, 7}, {0, 0, 0}, {0.1f, 0.2f, 0.3f}, {1e30f, 1, 1}, {255, 254, 128}};
  return image;
}

TEST(WriteImage, PfmKeepsEveryBit) {
  const TemporaryDirectory directory;
  write_image(directory / "a.pfm", floats(), {}, {});
  EXPECT_EQ(read_image(directory / "a.pfm"), floats());
}

TEST(WriteImage, HdrIsExactToHalfAMantissa) {
  const TemporaryDirectory directory;
  write_image(directory / "a.hdr", floats(), {}, {});
  const Image image = floats(), back = read_image(directory / "a.hdr");
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(back.pixels[i][c], image.pixels[i][c], max_component(image.pixels[i]) * 1.01f / 255) << i;
}

// The file says in which space its numbers are, so whoever reads it gets the same colours.
TEST(WriteImage, ColourSpacesOfTheFilmComeBack) {
  const TemporaryDirectory directory;
  Image image(2, 1);
  image.pixels = {{0.8f, 0.3f, 0.1f}, {0.1f, 0.2f, 3}};
  for (const ColourSpace space : {ColourSpace::rec2020, ColourSpace::aces2065_1, ColourSpace::dci_p3}) {
    FilmSettings film;
    film.width = 2, film.height = 1, film.space = space, film.save_half = false;
    write_image(directory / "a.exr", image, film, {});
    const Image back = read_image(directory / "a.exr");
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.pixels[i][c], image.pixels[i][c], 2e-6f) << i << ' ' << c;
    EXPECT_NE(test::contents(directory / "a.exr").find("chromaticities"), std::string::npos);
  }
}

TEST(WriteImage, OtherEndingsAreErrors) {
  const TemporaryDirectory directory;
  EXPECT_THROW(write_image(directory / "a.tif", Image(1, 1), {}, {}), std::runtime_error);
  EXPECT_EQ(directory.file_count(), 0);
}

}  // namespace write_image_test
}  // namespace dspm
