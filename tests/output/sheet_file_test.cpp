#include "dspm/output/sheet_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/lang/parse.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace sheet_file_test {

using test::contents;
using test::TemporaryDirectory;

constexpr const char* kProduct = R"(AxisBegin "legs"
VariationBegin "oak" Hide "cushion" VariationEnd
VariationBegin "steel" Hide "cushion" VariationEnd
AxisEnd
AxisBegin "seat"
VariationBegin "red" Show "cushion" VariationEnd
VariationBegin "blue" Show "cushion" VariationEnd
VariationBegin "glass" Show "cushion" VariationEnd
AxisEnd
)";

/// A job of the frames of that scene, with images of 16 x 8 pixels.
struct Product {
  explicit Product(int frames, const std::string& axes = kProduct) {
    Diagnostics diagnostics;
    scene = parse_text("scene.dsc",
                       fmt::format("Frames {} WorldBegin DynamicBegin \"cushion\" DynamicEnd\n{}", frames, axes), {},
                       diagnostics);
    diagnostics.throw_if_errors();
    job.description = &scene;
    job.frames.resize(static_cast<std::size_t>(scene.frames.count()));
    std::iota(job.frames.begin(), job.frames.end(), FileFrame(0));
    job.settings.crop = {0, 0, 16, 8};
  }
  /// Each frame is of a grey of its own.
  Image image(FileFrame frame) const {
    Image image(16, 8);
    for (Rgb& pixel : image.pixels)
      pixel = Rgb(static_cast<float>(std::find(job.frames.begin(), job.frames.end(), frame) - job.frames.begin()) / 10);
    return image;
  }
  SheetFile written(const std::filesystem::path& path, const SheetStyle& style = {}) const {
    SheetFile file(path, job, style);
    for (const FileFrame frame : job.frames) file.put(frame, image(frame));
    file.write({});
    return file;
  }
  SceneDescription scene;
  Job job;
};

/// The number and the delay in milliseconds of an APNG's images.
std::pair<int, int> images_of(const std::string& apng) {
  const auto number = [&](std::size_t at, std::size_t bytes) {
    int value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value = value << 8 | static_cast<unsigned char>(apng.at(at + i));
    return value;
  };
  return {number(apng.find("acTL") + 4, 4), number(apng.find("fcTL") + 24, 2)};
}

TEST(SheetFile, APngHoldsAllImages) {
  const TemporaryDirectory directory;
  const Product product(1);
  product.written(directory / "sheet.png");
  const SheetLayout layout({3, 2}, 16, 8);
  const Image sheet = read_image(directory / "sheet.png");
  for (int i = 0; i < 6; ++i) {
    const PixelRect place = layout.place(i);
    EXPECT_NEAR(sheet.at(place.x0 + 4, place.y0 + 4).g, 0.1 * i, 3e-3) << i;
  }
}

TEST(SheetFile, PagesAreFiles) {
  const TemporaryDirectory directory;
  const Product product(1);
  const SheetFile file = product.written(directory / "sheet.png", {.lines = 1});
  ASSERT_EQ(file.names().size(), 2u);
  const SheetLayout layout({3, 2}, 16, 8, {.lines = 1});
  for (int i = 0; i < 6; ++i) {
    const Image sheet = read_image(directory / fmt::format("sheet.{:04}.png", i / 3 + 1));
    const PixelRect place = layout.place(i);
    EXPECT_NEAR(sheet.at(place.x0 + 4, place.y0 + 4).g, 0.1 * i, 3e-3) << i;
  }
  EXPECT_FALSE(std::filesystem::exists(directory / "sheet.png"));
}

TEST(SheetFile, AnAnimationRunsThroughTheRows) {
  const TemporaryDirectory directory;
  const Product product(1), moving(4);
  product.written(directory / "sheet.apng");
  const SheetLayout two(2, 16, 8);
  const Image first = read_image(directory / "sheet.apng");
  EXPECT_EQ(first.width, two.sheet_width());
  EXPECT_NEAR(first.at(two.place(0).x0 + 4, two.place(0).y0 + 4).g, 0, 3e-3);
  EXPECT_NEAR(first.at(two.place(1).x0 + 4, two.place(1).y0 + 4).g, 0.3, 3e-3) << "the first of the second row";
  EXPECT_EQ(images_of(contents(directory / "sheet.apng")), std::pair(3, 1000)) << "a variation a second";
  moving.written(directory / "moving.apng");
  EXPECT_EQ(images_of(contents(directory / "moving.apng")), std::pair(4, 42)) << "24 moments a second";
  Product(5, "").written(directory / "plain.apng");
  EXPECT_EQ(images_of(contents(directory / "plain.apng")), std::pair(5, 42));
}

TEST(SheetFile, AQuickLookHasTheSheetOfTheWhole) {
  const TemporaryDirectory directory;
  Product product(1);
  product.job.quick = true;
  product.written(directory / "quick.png");
  EXPECT_EQ(read_image(directory / "quick.png").width, SheetLayout({3, 2}, 64, 32).sheet_width());
  product.written(directory / "small.png", {.tile_width = 16});
  EXPECT_EQ(read_image(directory / "small.png").width, SheetLayout({3, 2}, 16, 8).sheet_width());
}

}  // namespace sheet_file_test
}  // namespace dspm
