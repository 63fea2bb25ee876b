// Randomness must be uniform and independent along every one of its inputs, each alone and all of them together. Seeds
// are fixed; a right generator would fail any of the statistical tests here with a chance of about 1 in 100.
#include "dspm/base/math/rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/equal_cells.h"

namespace dspm {
namespace {

using test::cell;
using test::p_value;

struct Address {
  std::uint64_t seed = 1, stream = 0, path = 1000, iteration = 3;
  int bounce = 2, dimension = 1;

  float number() const {
    return PathRandom(seed, static_cast<Stream>(stream), path, iteration).number(bounce, dimension);
  }
  Vec2 pair() const { return PathRandom(seed, static_cast<Stream>(stream), path, iteration).pair(bounce, dimension); }
};

struct Walk {
  std::string name;
  Address (*at)(int step);
};

/// Ways through the six inputs: each alone with the others fixed, with strides, and all together.
const std::vector<Walk>& walks() {
  static const std::vector<Walk> all = {{"seed",
                                         [](int i) {
                                           Address a;
                                           a.seed = static_cast<std::uint64_t>(i);
                                           return a;
                                         }},
                                        {"stream",
                                         [](int i) {
                                           Address a;
                                           a.stream = static_cast<std::uint64_t>(i);
                                           return a;
                                         }},
                                        {"path",
                                         [](int i) {
                                           Address a;
                                           a.path = static_cast<std::uint64_t>(i);
                                           return a;
                                         }},
                                        {"path, every 512th",
                                         [](int i) {
                                           Address a;
                                           a.path = static_cast<std::uint64_t>(i) * 512;
                                           return a;
                                         }},
                                        {"iteration",
                                         [](int i) {
                                           Address a;
                                           a.iteration = static_cast<std::uint64_t>(i);
                                           return a;
                                         }},
                                        {"bounce",
                                         [](int i) {
                                           Address a;
                                           a.bounce = i;
                                           return a;
                                         }},
                                        {"dimension",
                                         [](int i) {
                                           Address a;
                                           a.dimension = i;
                                           return a;
                                         }},
                                        {"all",
                                         [](int i) {
                                           const auto n = static_cast<std::uint64_t>(i);
                                           return Address{n % 3, n % 5, n / 64, n / 1024, i % 8, i / 8 % 8};
                                         }},
                                        {"all alike", [](int i) {
                                           const auto n = static_cast<std::uint64_t>(i);
                                           return Address{n, n, n, n, i, i};
                                         }}};
  return all;
}

constexpr double kLevel = 0.01 / 60;  // about 60 tests in this file

TEST(Rng, IsUniformAlongEveryInput) {
  for (const Walk& walk : walks()) {
    std::vector<int> cells(1024);
    for (int i = 0; i < 1'000'000; ++i) ++cells[cell(walk.at(i).number(), 1024)];
    EXPECT_GT(p_value(cells), kLevel) << walk.name;
  }
}

TEST(Rng, TheLowBitsAreUniformToo) {
  for (const Walk& walk : walks()) {
    std::vector<int> cells(256);
    for (int i = 0; i < 500'000; ++i) ++cells[static_cast<std::size_t>(walk.at(i).number() * 0x1p24f) % 256];
    EXPECT_GT(p_value(cells), kLevel) << walk.name;
  }
}

TEST(Rng, NeighboursAreIndependent) {
  for (const Walk& walk : walks()) {
    for (const int lag : {1, 2, 64}) {
      std::vector<int> cells(32 * 32);
      for (int i = 0; i < 500'000; ++i) {
        ++cells[cell(walk.at(i).number(), 32) * 32 + cell(walk.at(i + lag).number(), 32)];
      }
      EXPECT_GT(p_value(cells), kLevel) << walk.name << " and its neighbour at " << lag;
    }
  }
}

TEST(Rng, TripletsAreIndependent) {
  for (const Walk& walk : walks()) {
    std::vector<int> cells(10 * 10 * 10);
    for (int i = 0; i < 500'000; ++i) {
      const std::size_t a = cell(walk.at(i).number(), 10), b = cell(walk.at(i + 1).number(), 10);
      ++cells[(a * 10 + b) * 10 + cell(walk.at(i + 2).number(), 10)];
    }
    EXPECT_GT(p_value(cells), kLevel) << walk.name;
  }
}

/// The same path in two iterations, streams, bounces ...: pairs across one input, taken over many paths.
TEST(Rng, OnePathsNumbersAreIndependentOfItsOther) {
  const auto over_paths = [](const std::string& name, auto&& first, auto&& second) {
    std::vector<int> cells(32 * 32);
    for (std::uint64_t path = 0; path < 500'000; ++path) {
      ++cells[cell(first(path), 32) * 32 + cell(second(path), 32)];
    }
    EXPECT_GT(p_value(cells), kLevel) << name;
  };
  const auto numbers = [](std::uint64_t seed, Stream stream, std::uint64_t iteration, int bounce, int dimension) {
    return [=](std::uint64_t path) { return PathRandom(seed, stream, path, iteration).number(bounce, dimension); };
  };
  const auto base = numbers(0, Stream::camera, 0, 0, 0);
  over_paths("seed", base, numbers(1, Stream::camera, 0, 0, 0));
  over_paths("stream", base, numbers(0, Stream::photon, 0, 0, 0));
  over_paths("iteration", base, numbers(0, Stream::camera, 1, 0, 0));
  over_paths("bounce", base, numbers(0, Stream::camera, 0, 1, 0));
  over_paths("dimension", base, numbers(0, Stream::camera, 0, 0, 1));
  over_paths("next path's next bounce", numbers(0, Stream::camera, 0, 1, 0),
             [](std::uint64_t path) { return PathRandom(0, Stream::camera, path + 1, 0).number(0, 0); });
}

TEST(Rng, PairsFillTheSquare) {
  for (const Walk& walk : walks()) {
    std::vector<int> cells(32 * 32);
    for (int i = 0; i < 500'000; ++i) {
      const Vec2 u = walk.at(i).pair();
      ++cells[cell(u.x, 32) * 32 + cell(u.y, 32)];
    }
    EXPECT_GT(p_value(cells), kLevel) << walk.name;
  }
}

TEST(Rng, StaysBelowOne) {
  float largest = 0, smallest = 1;
  for (std::uint64_t path = 0; path < 20'000'000; ++path) {
    const float u = PathRandom(0, Stream::photon, path, 0).number(0, 0);
    largest = std::max(largest, u), smallest = std::min(smallest, u);
  }
  EXPECT_LT(largest, 1.f);
  EXPECT_GT(largest, 0.9999f);
  EXPECT_GE(smallest, 0.f);
}

TEST(Rng, IsAFunction) {
  constexpr PathRandom random(7, Stream::caustic_photon, 5, 2);
  static_assert(random.number(1, 3) == PathRandom(7, Stream::caustic_photon, 5, 2).number(1, 3));
  static_assert(random.pair(1, 3).x == random.number(1, 3));
  EXPECT_NE(random.number(1, 3), random.number(3, 1));
}

TEST(Rng, InputsAreNotConfusedWithOneAnother) {
  const float base = PathRandom(5, Stream::camera, 6, 7).number(0, 0);
  EXPECT_NE(base, PathRandom(6, Stream::camera, 5, 7).number(0, 0));
  EXPECT_NE(base, PathRandom(5, Stream::camera, 7, 6).number(0, 0));
  EXPECT_NE(base, PathRandom(7, Stream::camera, 6, 5).number(0, 0));
}

}  // namespace
}  // namespace dspm
