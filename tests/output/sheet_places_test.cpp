// Rows and columns of contact sheets.
#include "dspm/output/sheet_places.h"

#include <gtest/gtest.h>

#include <numeric>

#include "dspm/lang/parse.h"

namespace dspm {
namespace {

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

/// The shape of the sheet, and where each of its frames lies.
struct Sheet {
  int columns, rows;
  std::vector<int> places;
};

Sheet sheet(int frames, const std::string& axes, const std::vector<int>& chosen = {}) {
  Diagnostics diagnostics;
  const SceneDescription scene = parse_text(
      "scene.dsc", "Frames " + std::to_string(frames) + " WorldBegin DynamicBegin \"cushion\" DynamicEnd\n" + axes, {},
      diagnostics);
  diagnostics.throw_if_errors();
  Job job;
  job.description = &scene;
  for (const int index : chosen) job.frames.emplace_back(index);
  if (job.frames.empty()) {
    job.frames.resize(static_cast<std::size_t>(scene.frames.count()));
    std::iota(job.frames.begin(), job.frames.end(), FileFrame(0));
  }
  const SheetPlaces places(job);
  const SheetLayout layout = places.layout(64, 48);
  Sheet result{layout.columns, layout.rows, {}};
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

}  // namespace
}  // namespace dspm
