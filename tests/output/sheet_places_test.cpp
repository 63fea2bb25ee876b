// Rows and columns of contact sheets.
#include "dspm/output/sheet_places.h"

#include <gtest/gtest.h>

#include <numeric>

#include "dspm/base/math/moments.h"
#include "dspm/lang/parse.h"

namespace dspm {
namespace sheet_places_test {

constexpr const char* kSeats = R"(AxisBegin "seat"
VariationBegin "red" Show "cushion" VariationEnd
VariationBegin "blue" Show "cushion" VariationEnd
VariationBegin "glass" Show "cushion" VariationEnd
AxisEnd
)";
constexpr const char* kLegs = R"(AxisBegin "legs"
VariationBegin "oak" Hide "cushion" VariationEnd
VariationBegin "steel" Hide "cushion" VariationEnd
AxisEnd
)";
constexpr const char* kLamps = R"(AxisBegin "lamp"
VariationBegin "on" Hide "cushion" VariationEnd
VariationBegin "off" Hide "cushion" VariationEnd
AxisEnd
)";

SceneDescription scene_of(int frames, const std::string& axes) {
  Diagnostics diagnostics;
  SceneDescription scene = parse_text(
      "scene.dsc", "Frames " + std::to_string(frames) + " WorldBegin DynamicBegin \"cushion\" DynamicEnd\n" + axes, {},
      diagnostics);
  diagnostics.throw_if_errors();
  return scene;
}

/// A job that renders the chosen frames, or all. The scene must outlive it.
Job job_of(const SceneDescription& scene, const std::vector<int>& chosen = {}) {
  Job job;
  job.description = &scene;
  for (const int index : chosen) job.frames.emplace_back(index);
  if (job.frames.empty()) {
    job.frames.resize(static_cast<std::size_t>(scene.frames.count()));
    std::iota(job.frames.begin(), job.frames.end(), FileFrame(0));
  }
  return job;
}

/// The shape of the sheet, and where each of its frames lies.
struct Sheet {
  int columns, rows;
  std::vector<int> places;
};

Sheet sheet(int frames, const std::string& axes, const std::vector<int>& chosen = {}) {
  const SceneDescription scene = scene_of(frames, axes);
  const Job job = job_of(scene, chosen);
  const SheetPlaces places(job);
  const SheetLayout layout = places.layout(64, 48);
  Sheet result{layout.columns, layout.lines, {}};
  for (const FileFrame frame : job.frames) result.places.push_back(places.of(frame));
  return result;
}

using Places = std::vector<int>;

TEST(SheetPlaces, AnAnimationOrOneAxisFillsAScreen) {
  EXPECT_EQ(sheet(5, "").places, (Places{0, 1, 2, 3, 4}));
  EXPECT_EQ(sheet(1, kSeats).places, (Places{0, 1, 2}));
  EXPECT_EQ(sheet(12, "").columns, SheetLayout(12, 64, 48).columns);
}

TEST(SheetPlaces, TheLastAxisIsInColumns) {
  const Sheet two = sheet(1, std::string(kLegs) + kSeats), three = sheet(1, std::string(kLamps) + kSeats + kLegs);
  EXPECT_EQ(two.columns, 3);
  EXPECT_EQ(two.rows, 2);
  EXPECT_EQ(two.places, (Places{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(three.columns, 2);
  EXPECT_EQ(three.rows, 6);
}

/// An axis of so many choices.
std::string axis(const std::string& name, int choices) {
  std::string text = "AxisBegin \"" + name + "\"\n";
  for (int i = 0; i < choices; ++i)
    text += "VariationBegin \"" + name + std::to_string(i) + "\" Hide \"cushion\" VariationEnd\n";
  return text + "AxisEnd\n";
}

struct Pages {
  SheetLayout layout;
  std::vector<int> places;
};

Pages suited(int frames, const std::string& axes, int width, int height, const SheetStyle& style = {}) {
  const SceneDescription scene = scene_of(frames, axes);
  const Job job = job_of(scene);
  const SheetPlaces places = SheetPlaces::suited(job, width, height, style);
  Pages pages{places.layout(width, height, style), {}};
  for (const FileFrame frame : job.frames) pages.places.push_back(places.of(frame));
  return pages;
}

/// 6 x 4 x 3 x 2 variations: with the last axis alone in columns, the page would be 2 images wide and 72 high.
TEST(SheetPlaces, ColumnsSuitThePage) {
  const std::string axes = axis("a", 6) + axis("b", 4) + axis("c", 3) + axis("d", 2);
  for (const auto& [width, height] : {std::pair(160, 120), std::pair(160, 90), std::pair(90, 160)}) {
    const Pages pages = suited(1, axes, width, height);
    const SheetLayout& layout = pages.layout;
    EXPECT_EQ(layout.pages, 1);
    EXPECT_EQ(layout.columns % 2, 0) << "the last axis stays in one line";
    EXPECT_LT(layout.unsuited(), kUnsuited);
    const double aspect = static_cast<double>(layout.sheet_width()) / layout.sheet_height();
    EXPECT_GT(aspect, 0.5) << width;
    EXPECT_LT(aspect, 4) << width;
    for (int i = 0; i < 144; ++i) EXPECT_EQ(pages.places[static_cast<std::size_t>(i)], i) << "in the file's order";
  }
}

TEST(SheetPlaces, PagesBeginWithAChoiceOfAnAxis) {
  const Pages thousand = suited(1, axis("a", 10) + axis("b", 10) + axis("c", 10), 160, 90);
  EXPECT_EQ(thousand.layout.columns, 10);
  EXPECT_EQ(thousand.layout.pages, 10);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(thousand.layout.page(thousand.places[static_cast<std::size_t>(i)]), i / 100);
}

/// The axes whose product reaches that number are in columns, and rows that are too long go on below.
TEST(SheetPlaces, ColumnsAreThoseAskedFor) {
  const std::string axes = axis("a", 4) + axis("b", 3) + axis("c", 2);
  const Pages six = suited(1, axes, 64, 48, {.columns = 6}), five = suited(1, axes, 64, 48, {.columns = 5});
  EXPECT_EQ(six.layout.columns, 6);
  EXPECT_EQ(six.layout.lines, 4);
  EXPECT_EQ(five.layout.columns, 5);
  EXPECT_EQ(five.layout.lines, 8) << "two for each row of six";
  EXPECT_EQ(five.layout.place(6).x0, five.layout.place(0).x0) << "the next row begins at the left";
}

TEST(SheetPlaces, LongAnimationsOfVariationsAreBroken) {
  const Pages pages = suited(48, axis("a", 2), 64, 48);
  EXPECT_LE(pages.layout.columns, 24);
  EXPECT_EQ(pages.layout.place(48).x0, pages.layout.place(0).x0) << "the second variation begins at the left";
}

TEST(SheetPlaces, MomentsAreInColumnsOfVariations) {
  const Sheet one = sheet(4, kSeats), two = sheet(4, std::string(kLegs) + kSeats);
  EXPECT_EQ(one.columns, 4);
  EXPECT_EQ(one.rows, 3);
  EXPECT_EQ(two.columns, 4);
  EXPECT_EQ(two.rows, 6);
}

TEST(SheetPlaces, WhatIsNotChosenTakesNoPlace) {
  const std::string axes = std::string(kLegs) + kSeats;
  const Sheet some = sheet(1, axes, {0, 2, 5}), row = sheet(1, axes, {3, 4, 5});
  EXPECT_EQ(some.columns, 2);
  EXPECT_EQ(some.places, (Places{0, 1, 3}));
  EXPECT_EQ(row.places, (Places{0, 1, 2}));
}

}  // namespace sheet_places_test
}  // namespace dspm
