#include "dspm/output/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "dspm/output/bitmap_font.h"

namespace dspm {
namespace contact_sheet_test {

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

TEST(ContactSheet, PlacesLieApartOnTheSheet) {
  for (const int count : {1, 2, 3, 7, 8, 24, 25, 64, 500}) {
    for (const auto& [width, height] :
         {std::pair(512, 512), std::pair(1920, 1080), std::pair(100, 400), std::pair(16, 16)}) {
      const SheetLayout layout(count, width, height);
      EXPECT_LE(layout.sheet_width(), 2048);
      EXPECT_GE(layout.columns * layout.lines * layout.pages, count);
      EXPECT_LT(layout.columns * (layout.lines * layout.pages - layout.pages), count) << "no line is empty";
      EXPECT_EQ(layout.page(count - 1), layout.pages - 1);
      const auto with_label = [&](int i) {
        PixelRect place = layout.place(i);
        place.y1 += kTextHeight * layout.text_scale;
        return place;
      };
      for (int i = 0; i < count; ++i) {
        const PixelRect place = with_label(i);
        EXPECT_GT(place.x0, 0);
        EXPECT_LT(place.x1, layout.sheet_width());
        EXPECT_LE(place.y1, layout.sheet_height());
        for (int j = std::max(0, i - layout.columns - 1); j < i; ++j)
          EXPECT_FALSE(layout.page(j) == layout.page(i) && overlap(with_label(j), place));
      }
    }
  }
}

TEST(ContactSheet, TheGridSuitsTheImages) {
  const SheetLayout eight(8, 256, 256), one(1, 640, 480), tall(4, 100, 400);
  EXPECT_EQ(eight.columns, 4);
  EXPECT_EQ(eight.lines, 2);
  EXPECT_EQ(one.columns, 1);
  EXPECT_EQ(one.image_width, 640) << "nothing is shrunk without need";
  EXPECT_EQ(tall.columns, 4);
}

TEST(ContactSheet, ManyImagesGoToPagesThatAreAlike) {
  for (const int count : {151, 200, 1000, 5000}) {
    const SheetLayout layout(count, 160, 90);
    EXPECT_GE(layout.pages, (count + 149) / 150) << count;
    EXPECT_LE(layout.pages, (count + 119) / 120) << count;
    EXPECT_GE(layout.image_width, 100) << "an image can be seen";
    std::vector<int> images(static_cast<std::size_t>(layout.pages));
    for (int i = 0; i < count; ++i) ++images[static_cast<std::size_t>(layout.page(i))];
    EXPECT_LE(images.front(), 150);
    EXPECT_GT(images.back(), images.front() / 2) << count;
  }
  EXPECT_EQ(SheetLayout(144, 160, 90).pages, 1);
  EXPECT_EQ(SheetLayout(1000, 160, 90, {.lines = 1000}).pages, 1) << "all on one, if that is asked for";
}

TEST(ContactSheet, ColumnsAndLinesAreThoseAskedFor) {
  const SheetLayout seven(24, 160, 90, {.columns = 7}), paged(24, 160, 90, {.columns = 5, .lines = 2}),
      few(3, 160, 90, {.columns = 9});
  EXPECT_EQ(seven.columns, 7);
  EXPECT_EQ(seven.lines, 4);
  EXPECT_EQ(seven.place(7).x0, seven.place(0).x0) << "the first of the second line";
  EXPECT_EQ(paged.pages, 3);
  EXPECT_EQ(paged.page(10), 1);
  EXPECT_EQ(paged.place(10).y0, paged.place(0).y0);
  EXPECT_EQ(few.columns, 3) << "there are no more";
}

TEST(ContactSheet, ImagesAndLabelsAppear) {
  const SheetLayout layout(3, 64, 48);
  ContactSheet sheet(layout);
  Image red(64, 48);
  for (Rgb& pixel : red.pixels) pixel = {1, 0, 0};
  const Rgb background = sheet.image().at(0, 0);
  sheet.put(1, red, "0002");

  const PixelRect place = layout.place(1);
  int text_pixels = 0;
  for (int y = 0; y < sheet.image().height; ++y) {
    for (int x = 0; x < sheet.image().width; ++x) {
      const Rgb& pixel = sheet.image().at(x, y);
      const bool inside = x >= place.x0 && x < place.x1 && y >= place.y0 && y < place.y1;
      if (inside) {
        EXPECT_EQ(pixel, Rgb(1, 0, 0));
      } else if (!(pixel == background)) {
        ++text_pixels;
        EXPECT_GE(y, place.y1);
        EXPECT_GE(x, place.x0);
        EXPECT_LT(x, place.x1);
      }
    }
  }
  EXPECT_GT(text_pixels, 20);
}

TEST(ContactSheet, ALabelIsNearerToItsImageThanToTheNextRow) {
  const SheetLayout layout(4, 64, 48);
  ASSERT_GT(layout.lines * layout.columns, layout.columns) << "there is no next row";
  ContactSheet sheet(layout);
  const Rgb background = sheet.image().at(0, 0);
  sheet.put(0, Image(64, 48), "0001");
  const PixelRect place = layout.place(0);
  int first = 0, last = 0;
  for (int y = place.y1; y < sheet.image().height; ++y)
    for (int x = place.x0; x < place.x1; ++x)
      if (!(sheet.image().at(x, y) == background)) first = first == 0 ? y : first, last = y;
  ASSERT_GT(first, 0);
  EXPECT_LT(first - place.y1, layout.place(layout.columns).y0 - last);
}

TEST(ContactSheet, LongLabelsAreCutOff) {
  const SheetLayout layout(2, 32, 32);
  ContactSheet sheet(layout);
  sheet.put(0, Image(32, 32), "a-label-much-longer-than-the-image");
  const Rgb background = sheet.image().at(0, 0);
  for (int y = 0; y < sheet.image().height; ++y) {
    for (int x = layout.place(0).x1; x < sheet.image().width; ++x) EXPECT_EQ(sheet.image().at(x, y), background);
  }
}

TEST(ContactSheet, CutLabelsStillTellVariationsApart) {
  const auto sheet_with = [](const char* label) {
    ContactSheet sheet(SheetLayout(1, 64, 48));
    sheet.put(0, Image(64, 48), label);
    return sheet.image();
  };
  const Image petrol = sheet_with("walnut-dark-petrol");
  for (const char* other : {"walnut-dark-crimson", "walnut-pale-petrol", "birch-dark-petrol"})
    EXPECT_FALSE(sheet_with(other) == petrol) << other;
  EXPECT_EQ(petrol, sheet_with("wa-da-pe"));
  EXPECT_EQ(sheet_with("evening-view-0012"), sheet_with("ev-vi-12"));
  EXPECT_EQ(sheet_with("walnutandoak"), sheet_with("walnutand"));
}

TEST(ContactSheet, ATileHasTheWidthThatIsAskedFor) {
  const SheetLayout small(8, 640, 480, {.tile_width = 100}), large(8, 64, 48, {.tile_width = 128});
  EXPECT_EQ(small.image_width, 100);
  EXPECT_EQ(small.image_height, 75);
  EXPECT_EQ(large.image_height, 96);
  ContactSheet sheet(large);
  Image red(64, 48);
  for (Rgb& pixel : red.pixels) pixel = {1, 0, 0};
  sheet.put(0, red, "");
  const PixelRect place = large.place(0);
  EXPECT_EQ(sheet.image().at(place.x1 - 1, place.y1 - 1), Rgb(1, 0, 0));
  EXPECT_FALSE(sheet.image().at(place.x1, place.y1 - 1) == Rgb(1, 0, 0));
}

TEST(ContactSheet, ATitleStandsAboveAllAndLabelsCanBeLeftOut) {
  const SheetLayout plain(4, 64, 48), bare(4, 64, 48, {.labels = false}), titled(4, 64, 48, {.title = "LL"});
  EXPECT_LT(bare.sheet_height(), plain.sheet_height());
  EXPECT_GT(titled.sheet_height(), plain.sheet_height());
  ContactSheet sheet(titled), silent(bare);
  const Rgb background = sheet.image().at(0, 0);
  int text_pixels = 0;
  for (int y = 0; y < titled.place(0).y0; ++y)
    for (int x = 0; x < titled.sheet_width(); ++x) text_pixels += sheet.image().at(x, y) == background ? 0 : 1;
  EXPECT_EQ(text_pixels, 2 * 11 * 4) << "two L of eleven dots, at scale 2";
  silent.put(0, Image(64, 48), "LL");
  for (int y = bare.place(0).y1; y < bare.place(bare.columns).y0; ++y)
    for (int x = 0; x < bare.sheet_width(); ++x) EXPECT_EQ(silent.image().at(x, y), background);
}

TEST(BitmapFont, AllLettersDiffer) {
  std::vector<Image> glyphs;
  for (char c = ' '; c <= '~'; ++c) {
    Image glyph(kTextAdvance, kTextHeight);
    draw_text(glyph, 0, 0, std::string_view(&c, 1), 1, Rgb(1));
    for (const Image& other : glyphs) EXPECT_FALSE(glyph == other) << c;
    for (int y = 0; y < kTextHeight; ++y) EXPECT_EQ(glyph.at(kTextAdvance - 1, y), Rgb(0)) << "a gap follows " << c;
    glyphs.push_back(glyph);
  }
}

TEST(BitmapFont, AnL) {
  Image image(7, 11);
  draw_text(image, 1, 1, "L", 1, Rgb(1));
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 7; ++x) {
      const bool stem = x == 1 && y >= 1 && y <= 7, foot = y == 7 && x >= 1 && x <= 5;
      EXPECT_EQ(image.at(x, y), Rgb(stem || foot ? 1 : 0)) << x << ", " << y;
    }
  }
}

TEST(BitmapFont, WhatLiesOutsideIsCutOff) {
  Image image(4, 4);
  draw_text(image, -3, -3, "WWW", 3, Rgb(1));
  draw_text(image, 1000, 2, "W\xff\n", 1, Rgb(1));
}

}  // namespace contact_sheet_test
}  // namespace dspm
