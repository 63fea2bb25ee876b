// The pieces of many segments: against a slow twin that cuts one segment after the other and sorts all that it gets.
#include "dspm/shapes/curve_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "dspm/base/system/parallel.h"
#include "tests/shapes/random.h"

namespace dspm {
namespace {

using test::Random;
using Segments = std::vector<CurveSegment>;

/// On a grid of 2^21 cells along each axis of the box.
std::array<std::uint32_t, 3> cell_of(const CurvePiece& piece, const Bounds3& box) {
  std::array<std::uint32_t, 3> cell{};
  const Vec3 middle = piece.start + piece.chord * 0.5f;
  for (int axis = 0; axis < 3; ++axis) {
    const float share = (middle[axis] - box.low[axis]) / (box.high[axis] - box.low[axis]);
    cell[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(std::clamp(share, 0.f, 1.f) * ((1 << 21) - 1));
  }
  return cell;
}

/// The order along a z-curve, by the axis on which the two differ in the highest bit; of equal bits, z counts most.
bool comes_before(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  std::size_t axis = 2;
  for (const std::size_t other : {1u, 0u})
    if (std::bit_width(a[other] ^ b[other]) > std::bit_width(a[axis] ^ b[axis])) axis = other;
  return a[axis] < b[axis];
}

std::vector<CurvePiece> slow_twin(const Segments& segments, const std::vector<std::uint8_t>& depths) {
  std::vector<CurvePiece> all;
  Bounds3 box;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::vector<CurvePiece> own;
    for (const CurvePiece& piece : cut_into_pieces({&segments[s], 1}, {&depths[s], 1})) own.push_back(piece);
    std::sort(own.begin(), own.end(), [](const CurvePiece& a, const CurvePiece& b) { return a.index < b.index; });
    for (CurvePiece& piece : own) {
      EXPECT_EQ(piece.segment, 0u);
      piece.segment = static_cast<std::uint32_t>(s);
      all.push_back(piece), box.add(piece.start);
    }
  }
  std::stable_sort(all.begin(), all.end(), [&](const CurvePiece& a, const CurvePiece& b) {
    return comes_before(cell_of(a, box), cell_of(b, box));
  });
  return all;
}

void expect_as_twin(const Segments& segments, const std::vector<std::uint8_t>& depths) {
  const auto expected = slow_twin(segments, depths);
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    const auto found = cut_into_pieces(segments, depths);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].segment, expected[i].segment) << i;
      ASSERT_EQ(found[i].index, expected[i].index) << i;
      ASSERT_EQ(found[i].count, expected[i].count);
      ASSERT_EQ(found[i].start, expected[i].start);
      ASSERT_EQ(found[i].chord, expected[i].chord);
    }
  }
}

CurveSegment strand_at(const Vec3& at, Random& random) {
  const Vec3 a = 0.05f * random.direction(), b = 0.05f * random.direction();
  return CurveSegment::of({at, at + a, at + a + b, at + 2 * a + b}, 0.01f, 0);
}

TEST(CurvePieces, AreThoseOfASlowTwin) {
  Random random(41);
  Segments segments;
  std::vector<std::uint8_t> depths;
  for (int i = 0; i < 10'000; ++i) {
    segments.push_back(i % 50 == 49 ? segments.back() : strand_at(random.in_cube(1), random));  // some lie on others
    depths.push_back(static_cast<std::uint8_t>(random.below(5)));
  }
  expect_as_twin(segments, depths);
}

/// Then all pieces but one fall into one cell.
TEST(CurvePieces, OfAStrandFarAway) {
  Random random(42);
  Segments segments{strand_at({1e6f, 2e6f, 3e6f}, random)};
  for (int i = 0; i < 10'000; ++i) segments.push_back(strand_at(random.in_cube(1), random));
  expect_as_twin(segments, std::vector<std::uint8_t>(segments.size(), 3));
}

TEST(CurvePieces, OfNothing) { EXPECT_TRUE(cut_into_pieces({}, {}).empty()); }

}  // namespace
}  // namespace dspm
