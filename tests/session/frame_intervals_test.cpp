// Which frames are rendered together: all of them once, in whole products where these fit, looks together.
#include "dspm/session/frame_intervals.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "dspm/base/math/moments.h"
#include "dspm/lang/parse.h"

namespace dspm {
namespace frame_intervals_test {

using Lengths = std::vector<std::size_t>;

/// An axis of `count` variations that say `content`.
std::string axis(const std::string& name, int count, const std::string& content) {
  std::string text = fmt::format("AxisBegin \"{}\"\n", name);
  for (int i = 0; i < count; ++i) text += fmt::format("VariationBegin \"{}{}\" {} VariationEnd\n", name, i, content);
  return text + "AxisEnd\n";
}

const std::string kFinish = "MakeNamedMaterial \"seat\" \"string type\" \"diffuse\"", kPart = "Show \"shade\"",
                  kDim = "Light \"key\" \"float scale\" 2";

struct Product {
  explicit Product(const std::string& axes, int frames = 1, const std::string& contents = {}) {
    Diagnostics diagnostics;
    scene = parse_text("scene.dsc",
                       fmt::format("Frames {}\nWorldBegin LightSource \"point\" \"string name\" \"key\"\n"
                                   "MakeNamedMaterial \"seat\" \"string type\" \"diffuse\"\n"
                                   "DynamicBegin \"shade\" Shape \"sphere\" DynamicEnd\n{}\n{}",
                                   frames, contents, axes),
                       {}, diagnostics);
    diagnostics.throw_if_errors();
  }
  FrameList all() const {
    FrameList frames(static_cast<std::size_t>(scene.frames.count()));
    std::iota(frames.begin(), frames.end(), FileFrame(0));
    return frames;
  }
  std::vector<FrameList> cut(int together) const { return cut(all(), together); }
  std::vector<FrameList> cut(const FrameList& frames, int together) const {
    const std::vector<FrameList> intervals = FrameIntervals(scene, frames).cut(together);
    FrameList held;
    for (const FrameList& interval : intervals) {
      EXPECT_TRUE(std::is_sorted(interval.begin(), interval.end()));
      EXPECT_LE(interval.size(), static_cast<std::size_t>(together));
      held.insert(held.end(), interval.begin(), interval.end());
    }
    std::sort(held.begin(), held.end());
    EXPECT_EQ(held, frames);
    return intervals;
  }
  /// How many places along the factor occur in each interval.
  Lengths places(const std::vector<FrameList>& intervals, int axis) const {
    Lengths counts;
    for (const FrameList& interval : intervals) {
      std::set<int> places;
      for (const FileFrame frame : interval) places.insert(place_along({axis, false}, scene.frames, frame));
      counts.push_back(places.size());
    }
    return counts;
  }
  SceneDescription scene;
};

Lengths lengths(const std::vector<FrameList>& intervals) {
  Lengths result;
  for (const FrameList& interval : intervals) result.push_back(interval.size());
  return result;
}

TEST(FrameIntervals, OfAnAnimationAreConsecutiveAndOfNearlyEqualLength) {
  EXPECT_EQ(lengths(Product("", 1).cut(64)), Lengths{1});
  EXPECT_EQ(lengths(Product("", 64).cut(64)), Lengths{64});
  EXPECT_EQ(lengths(Product("", 65).cut(64)), (Lengths{32, 33}));
  EXPECT_EQ(lengths(Product("", 128).cut(64)), (Lengths{64, 64}));
  EXPECT_EQ(lengths(Product("", 129).cut(64)), (Lengths{43, 43, 43}));
  EXPECT_EQ(lengths(Product("", 3).cut(1)), (Lengths{1, 1, 1}));
  for (const FrameList& interval : Product("", 129).cut(64))
    EXPECT_EQ(interval.back().slot() - interval.front().slot() + 1, interval.size());
}

TEST(FrameIntervals, HoldWholeInnerProducts) {
  EXPECT_EQ(lengths(Product(axis("shade", 3, kPart) + axis("finish", 40, kFinish)).cut(64)), (Lengths{40, 40, 40}));
  EXPECT_EQ(lengths(Product(axis("shade", 10, kPart) + axis("finish", 16, kFinish)).cut(64)), (Lengths{48, 48, 64}));
}

TEST(FrameIntervals, AreEqualCutsWhereInnerProductsDoNotFit) {
  const Lengths fabrics = lengths(Product(axis("fabric", 500, kFinish)).cut(64));
  EXPECT_EQ(fabrics.size(), 8u);
  for (const std::size_t length : fabrics) EXPECT_TRUE(length == 62 || length == 63) << length;
  EXPECT_EQ(lengths(Product(axis("shade", 2, kPart) + axis("finish", 70, kFinish)).cut(64)), (Lengths{35, 35, 35, 35}));
  // Of looks the larger axis is cut.
  EXPECT_EQ(lengths(Product(axis("lamp", 2, kDim) + axis("finish", 70, kFinish)).cut(64)), (Lengths{46, 46, 48}));
}

TEST(FrameIntervals, KeepLooksTogetherWhateverTheOrderOfTheText) {
  for (const bool shades_first : {true, false}) {
    const std::string shades = axis("shade", 3, kPart), finishes = axis("finish", 40, kFinish);
    const Product product(shades_first ? shades + finishes : finishes + shades);
    EXPECT_EQ(product.places(product.cut(64), shades_first ? 0 : 1), (Lengths{1, 1, 1}));
  }
}

TEST(FrameIntervals, KeepMomentsTogetherThatMoveNothing) {
  constexpr const char* kMoving =
      "DynamicBegin \"ball\" Keyframe 1 Translate 0 0 0 Keyframe 30 Translate 1 0 0 KeyframeEnd Shape \"sphere\" "
      "DynamicEnd";
  constexpr const char* kPaint =
      "MakeNamedMaterial \"paint\" \"string type\" \"diffuse\" \"rgb reflectance@1\" [0 0 0] \"rgb reflectance@30\" [1 "
      "1 1]";
  const Product moving(axis("finish", 20, kFinish), 30, kMoving), painted(axis("shade", 20, kPart), 30, kPaint);
  const auto of_moving = moving.cut(64), of_painted = painted.cut(64);
  EXPECT_EQ(moving.places(of_moving, Factor::kMoments), Lengths(10, 3));
  EXPECT_EQ(painted.places(of_painted, 0), Lengths(10, 2));
}

TEST(FrameIntervals, OfChosenFramesFitAsWell) {
  const Product product(axis("shade", 5, kPart) + axis("finish", 30, kFinish));
  FrameList some;
  for (const FileFrame frame : product.all())
    if (frame.index() % 7 != 0 && frame.index() < 100) some.push_back(frame);
  for (const int together : {64, 40, 20, 7, 1}) product.cut(some, together);
}

TEST(Factors, MovePathsByGeometryCameraAndPlacesOfLights) {
  const auto moves = [](const std::string& contents) {
    return factors_of(Product("", 9, contents).scene)[0].moves_paths;
  };
  EXPECT_FALSE(moves(""));
  EXPECT_FALSE(moves("LightSource \"point\" \"float scale@1\" 1 \"float scale@9\" 2"));
  EXPECT_TRUE(moves("LightSource \"point\" \"point3 from@1\" [0 0 0] \"point3 from@9\" [1 0 0]"));
  EXPECT_TRUE(moves("DynamicBegin \"a\" \"integer frames\" [2 3] DynamicEnd"));
  EXPECT_TRUE(moves("DynamicBegin \"a\" Shape \"sphere\" \"float radius@1\" 1 \"float radius@9\" 2 DynamicEnd"));
}

}  // namespace frame_intervals_test
}  // namespace dspm
