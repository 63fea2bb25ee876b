// The box around all that a file places is that of all triangles of all instances, though few of them are looked at.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "dspm/shapes/placed_bounds.h"
#include "dspm/testing/test_scene.h"

namespace dspm {
namespace bounds_test {

using test::TestScene;

/// Instances of a pyramid, turned and scaled at random.
std::string forest(int trees) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-50, 50), angle(0, 360), scale(0.1f, 4);
  std::string text = R"(WorldBegin LightSource "point"
ObjectBegin "tree"
Shape "trianglemesh" "point3 P" [0 0 3  1 .2 0  -.4 .9 0  -.7 -.8 .1] "integer indices" [0 1 2 0 2 3 0 3 1]
ObjectEnd
)";
  for (int i = 0; i < trees; ++i)
    text += fmt::format(
        "AttributeBegin Translate {} {} 0 Rotate {} .3 .2 1 Scale {} 1 1 ObjectInstance \"tree\" AttributeEnd\n",
        place(random), place(random), angle(random), scale(random));
  return text;
}

TEST(Bounds, AreThoseOfAllTrianglesOfAllInstances) {
  for (const int trees : {1, 2, 300}) {
    TestScene test(forest(trees));
    const auto scene = test.scene(test.all_frames());
    ASSERT_EQ(scene->shapes.size(), static_cast<std::size_t>(trees));
    Bounds3 box;
    for (const PlacedShape& shape : scene->shapes)
      for (int i = 0; i < shape.shape->primitive_count(); ++i) box.add(shape.bounds(i));
    EXPECT_EQ(scene->center, box.center());
  }
}

TEST(Bounds, OfABoxHoldThoseOfEveryBoxWithin) {
  TestScene test(forest(50));
  const auto scene = test.scene(test.all_frames());
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-3, 3);
  for (const PlacedShape& shape : scene->shapes)
    for (int round = 0; round < 200; ++round) {
      const auto point = [&] { return Vec3{any(random), any(random), any(random)}; };
      Bounds3 inner, outer;
      inner.add(point()), inner.add(point());
      outer.add(inner), outer.add(point());
      const Bounds3 in = bounds_of(shape, inner), out = bounds_of(shape, outer);
      Bounds3 both = out;
      both.add(in);
      EXPECT_EQ(both.low, out.low);
      EXPECT_EQ(both.high, out.high);
    }
}

}  // namespace bounds_test
}  // namespace dspm
