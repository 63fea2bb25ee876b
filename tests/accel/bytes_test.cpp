// What a tree will take is known before it is built: never less than it does, and not much more.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "dspm/accel/tree_limits.h"
#include "dspm/accel/two_level.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {
namespace {

/// A wavy square of 2 n^2 triangles.
TriangleMesh waves(int n, float phase) {
  MeshData data;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const Vec2 p{static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n)};
      data.vertices.push_back({p.x, p.y, 0.1f * std::sin(20 * p.x + phase)});
    }
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + n + 1;
      data.faces.push_back({a, a + 1, b});
      data.faces.push_back({a + 1, b + 1, b});
    }
  return TriangleMesh(std::move(data));
}

struct Extent {
  int still, moving;  // triangles along a side: of the floor, and of each of three frames
};

class Bytes : public testing::TestWithParam<Extent> {};

TEST_P(Bytes, AreKnownBefore) {
  constexpr int kFrames = 3;
  const auto [still, moving] = GetParam();
  std::vector<TriangleMesh> meshes = {waves(still, 0)};
  for (int f = 0; f < kFrames; ++f) meshes.push_back(waves(moving, static_cast<float>(f)));
  std::vector<PlacedShape> shapes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    PlacedShape& shape = shapes.emplace_back();
    shape.shape = &meshes[i];
    shape.frames = i == 0 ? FrameSet::first(kFrames) : FrameSet::single(static_cast<Frame>(i - 1));
  }
  const auto said = static_cast<double>(two_level_bytes(shapes, FrameSet::first(kFrames)));
  for (const BvhBuilder builder : {BvhBuilder::own, BvhBuilder::embree}) {
    const auto taken = static_cast<double>(TwoLevel(shapes, FrameSet::first(kFrames), builder).memory());
    EXPECT_GE(said, taken);
    EXPECT_LE(said, 3 * taken);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Bytes, testing::Values(Extent{100, 8}, Extent{60, 60}, Extent{8, 100}));

TEST(TreeLimits, RefuseWhatCannotBeNumbered) {
  constexpr std::uint64_t kBillion = 1'000'000'000;
  expect_numbered(kBillion, kBillion / 2);
  EXPECT_THROW(expect_numbered(4 * kBillion, 0), std::length_error);
  EXPECT_THROW(expect_numbered(kBillion, kBillion), std::length_error);
}

}  // namespace
}  // namespace dspm
