// Numbers of a sequence of paths must cover each slot's square evenly, and be uniform and independent in every other
// way. Seeds are fixed; right numbers would fail any of the statistical tests here with a chance of about 1 in 100.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "dspm/base/math/owen.h"
#include "dspm/base/math/rng.h"
#include "tests/support/equal_cells.h"

namespace dspm {
namespace {

constexpr double kChance = 0.0005;  // twenty tests or so

PathRandom in_sequence(std::uint64_t sequence, std::uint32_t place) {
  return PathRandom::even(1, Stream::camera, sequence, place);
}

constexpr int kSquares = 16;

std::vector<int> counted(int count, const std::function<Vec2(int)>& pair) {
  std::vector<int> cells(kSquares * kSquares);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = pair(i);
    ++cells[test::cell(u.x, kSquares) * kSquares + test::cell(u.y, kSquares)];
  }
  return cells;
}
double chance_of_pairs(int count, const std::function<Vec2(int)>& pair) { return test::p_value(counted(count, pair)); }

/// Returns whether each of the 2^a x 2^b equal rectangles holds one of the 2^(a + b) places from `first` on.
bool one_in_each(std::uint32_t first, int a, int b, int bounce, int dimension) {
  std::vector<int> cells(std::size_t{1} << (a + b));
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const Vec2 u = in_sequence(3, first + i).pair(bounce, dimension);
    ++cells[(test::cell(u.x, 1 << a) << b) + test::cell(u.y, 1 << b)];
  }
  return std::all_of(cells.begin(), cells.end(), [](int n) { return n == 1; });
}

TEST(EvenNumbers, HaveOnePointInEveryElementaryInterval) {
  for (int bits = 0; bits <= 10; ++bits)
    for (int a = 0; a <= bits; ++a)
      for (const std::uint32_t block : {0u, 1u, 2u, 5u, 1000003u})
        for (const int dimension : {0, 5})
          ASSERT_TRUE(one_in_each(block << bits, a, bits - a, 1, dimension)) << bits << ' ' << a << ' ' << block;
}

TEST(EvenNumbers, AreNotEvenWhereNothingIsGained) {
  EXPECT_FALSE(one_in_each(0, 5, 5, 9, 0));     // a late bounce
  EXPECT_FALSE(one_in_each(0, 5, 5, 1, 1024));  // a walk below a surface
}

TEST(EvenNumbers, AreUniformWhateverThePlace) {
  for (const std::uint32_t place : {0u, 1u, 77u, 123456789u})
    for (const int bounce : {0, 3, 4}) {
      const auto pair = [&](int i) { return in_sequence(static_cast<std::uint64_t>(i), place).pair(bounce, 2); };
      EXPECT_GT(chance_of_pairs(200'000, pair), kChance) << place << ' ' << bounce;
    }
}

TEST(EvenNumbers, OfTwoSlotsAreIndependent) {
  for (const auto& [bounce, dimension] : {std::pair(0, 1), std::pair(1, 0), std::pair(2, 6), std::pair(7, 0)}) {
    const auto pair = [&, b = bounce, d = dimension](int i) {
      const PathRandom random = in_sequence(static_cast<std::uint64_t>(i), 5);
      return Vec2{random.number(0, 0), random.number(b, d)};
    };
    EXPECT_GT(chance_of_pairs(200'000, pair), kChance) << bounce << ' ' << dimension;
  }
}

/// In one sequence both slots are even, but not together: the statistic is no larger than that of independent numbers,
/// on average over sequences, and does not grow with the places as it would if one slot told about the other.
TEST(EvenNumbers, OfTwoSlotsOfOneSequenceAreIndependent) {
  constexpr int kSequences = 200;
  for (const int places : {1 << 11, 1 << 14}) {
    double statistic = 0;
    for (std::uint64_t s = 0; s < kSequences; ++s) {
      const std::vector<int> cells = counted(places, [&](int i) {
        const PathRandom random = in_sequence(s, static_cast<std::uint32_t>(i));
        return Vec2{random.pair(0, 0).y, random.pair(2, 6).x};
      });
      const double expected = static_cast<double>(places) / (kSquares * kSquares);
      for (const int n : cells) statistic += (n - expected) * (n - expected) / expected / (kSquares * kSquares - 1);
    }
    EXPECT_LT(statistic / kSequences, 1.02) << places;
  }
}

TEST(EvenNumbers, OfTwoSequencesAreIndependent) {
  const auto pair = [](int i) {
    return Vec2{in_sequence(1, static_cast<std::uint32_t>(i)).number(1, 0),
                in_sequence(2, static_cast<std::uint32_t>(i)).number(1, 0)};
  };
  EXPECT_GT(chance_of_pairs(200'000, pair), kChance);
}

TEST(EvenNumbers, OfLateBouncesAreIndependentBetweenPaths) {
  const auto pair = [](int i) {
    const auto place = static_cast<std::uint32_t>(i);
    return Vec2{in_sequence(1, place).number(6, 0), in_sequence(1, place + 1).number(6, 0)};
  };
  EXPECT_GT(chance_of_pairs(200'000, pair), kChance);
}

/// The squared error of the mean of fn over so many paths, itself a mean over sequences.
double squared_error(int paths, double truth, bool even, const std::function<double(const PathRandom&)>& fn) {
  constexpr int kSequences = 200;
  double sum = 0;
  for (std::uint64_t s = 0; s < kSequences; ++s) {
    double mean = 0;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(paths); ++i)
      mean += fn(even ? in_sequence(s, i) : PathRandom(1, Stream::camera, i, s)) / paths;
    sum += (mean - truth) * (mean - truth) / kSequences;
  }
  return sum;
}

TEST(EvenNumbers, IntegrateBetterThanIndependentOnes) {
  const auto smooth = [](const PathRandom& r) {
    const Vec2 u = r.pair(1, 0);
    return static_cast<double>(u.x * u.x + u.y);
  };
  const auto edge = [](const PathRandom& r) {
    const Vec2 u = r.pair(1, 0);
    return u.x + 0.5f * u.y < 0.75f ? 1.0 : 0.0;
  };
  const auto both = [](const PathRandom& r) {
    const Vec2 u = r.pair(1, 0), v = r.pair(2, 0);
    return static_cast<double>((u.x + v.x) * (u.y + v.y));
  };
  struct Case {
    std::string name;
    std::function<double(const PathRandom&)> fn;
    double truth;
    int paths;
    double gain;  // at least
  };
  for (const Case& c : {Case{"smooth", smooth, 5 / 6.0, 16, 20}, Case{"smooth", smooth, 5 / 6.0, 12, 3},
                        Case{"edge", edge, 0.5, 64, 5}, Case{"two slots", both, 1, 64, 4}})
    EXPECT_GT(squared_error(c.paths, c.truth, false, c.fn), c.gain * squared_error(c.paths, c.truth, true, c.fn))
        << c.name << ' ' << c.paths;
}

TEST(EvenNumbers, AreAFunction) {
  constexpr PathRandom random = PathRandom::even(7, Stream::photon, 5, 2);
  static_assert(random.pair(1, 3).x == random.number(1, 3));
  static_assert(random.pair(5, 3).x == random.number(5, 3));
  static_assert(reverse_bits(0x00000001u) == 0x80000000u && reverse_bits(0x12345678u) == 0x1e6a2c48u);
  EXPECT_NE(random.number(1, 3), PathRandom::even(7, Stream::photon, 5, 3).number(1, 3));
}

}  // namespace
}  // namespace dspm
