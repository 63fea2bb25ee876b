// A guide draws what its density says, is fine where paths were found, and loses no light.
#include "dspm/integrators/photons/emission_guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dspm/base/system/parallel.h"
#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/guiding/emission_tree.h"
#include "dspm/integrators/guiding/quarter_sums.h"

namespace dspm {
namespace emission_guide_test {

constexpr float kUsual[] = {0.7f, 0.2f, 0, 0.1f};
constexpr float kSmall = 1.f / 32;

/// Paths that start in a small box of light 0's numbers; those in its upper half contribute four times as much.
std::vector<EmissionRecord> records_in_a_small_box(int count) {
  std::vector<EmissionRecord> records;
  for (int i = 0; i < count; ++i) {
    const PathRandom random(1, Stream::setup, static_cast<std::uint64_t>(i), 0);
    const Vec2 a = random.pair(0, 0), b = random.pair(0, 1);
    records.push_back(
        {0, {0.5f + kSmall * a.x, 0.25f + kSmall * a.y, kSmall * b.x, 0.75f + kSmall * b.y}, a.x < 0.5f ? 1. : 16.});
  }
  return records;
}

EmissionGuide learned(int count = 6000) {
  std::vector<EmissionRecord> records = records_in_a_small_box(count);
  return guide_from(records, kUsual);
}

EmissionStart draw(const EmissionGuide& guide, int i) {
  return guide.draw(PathRandom(2, Stream::setup, static_cast<std::uint64_t>(i), 0));
}

bool is_in_small_box(const EmissionStart& s) {
  return s.light == 0 && s.numbers[0] >= 0.5f && s.numbers[0] < 0.5f + kSmall && s.numbers[1] >= 0.25f &&
         s.numbers[1] < 0.25f + kSmall && s.numbers[2] < kSmall && s.numbers[3] >= 0.75f &&
         s.numbers[3] < 0.75f + kSmall;
}

TEST(EmissionGuide, DrawsWithTheDensityThatItClaims) {
  const EmissionGuide guide = learned();
  ASSERT_GT(guide.cell_count(), 100u);
  for (int i = 0; i < 20'000; ++i) {
    const EmissionStart start = draw(guide, i);
    EXPECT_EQ(start.density, guide.density(start.light, start.numbers));
    for (const float number : start.numbers) EXPECT_TRUE(number >= 0 && number < 1);
  }
}

// Over a side that may be any, the density is the mean over that side.
TEST(EmissionGuide, IntegratesOverNumbersThatMayBeAny) {
  const EmissionGuide guide = learned();
  for (int i = 0; i < 50; ++i) {
    const EmissionStart start = draw(guide, i);
    for (std::size_t side = 0; side < 4; ++side) {
      EmissionNumbers numbers = start.numbers;
      double sum = 0;
      constexpr int kSteps = 1 << 14;  // finer than any cell
      for (int step = 0; step < kSteps; ++step) {
        numbers[side] = (static_cast<float>(step) + 0.5f) / kSteps;
        sum += static_cast<double>(guide.density(start.light, numbers));
      }
      numbers[side] = kAnyNumber;
      EXPECT_NEAR(static_cast<double>(guide.density(start.light, numbers)) * kSteps / sum, 1, 1e-4);
    }
  }
  double all = 0;
  for (int light = 0; light < 4; ++light)
    all += static_cast<double>(guide.density(light, {kAnyNumber, kAnyNumber, kAnyNumber, kAnyNumber}));
  EXPECT_NEAR(all, 1, 1e-5);
}

// The mean of 1 / density over the draws that fall into a region is the region's volume.
TEST(EmissionGuide, CountsEveryRegionByItsVolume) {
  const EmissionGuide guide = learned();
  constexpr int kDraws = 400'000;
  double sums[4][4] = {}, squares[4][4] = {};  // by light and quarter of two sides
  for (int i = 0; i < kDraws; ++i) {
    const EmissionStart start = draw(guide, i);
    const int quarter = (start.numbers[0] < 0.5f ? 0 : 1) + (start.numbers[3] < 0.75f ? 0 : 2);
    const double weight = 1 / static_cast<double>(start.density);
    sums[start.light][quarter] += weight, squares[start.light][quarter] += weight * weight;
  }
  const double volumes[] = {0.375, 0.375, 0.125, 0.125};
  for (const int light : {0, 1, 3})
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double mean = sums[light][quarter] / kDraws,
                   error = std::sqrt((squares[light][quarter] / kDraws - mean * mean) / kDraws);
      EXPECT_NEAR(mean, volumes[quarter], 4 * error) << light << " " << quarter;
    }
}

TEST(EmissionGuide, PutsPathsWhereTheyWereFound) {
  const EmissionGuide guide = learned();
  constexpr int kDraws = 50'000;
  int inside = 0, low = 0;
  for (int i = 0; i < kDraws; ++i) {
    const EmissionStart start = draw(guide, i);
    if (!is_in_small_box(start)) continue;
    ++inside, low += start.numbers[0] < 0.5f + kSmall / 2;
  }
  EXPECT_GT(inside, 0.4 * kDraws);  // a millionth of the volume
  EXPECT_NEAR(static_cast<double>(low) / inside, 0.2, 0.05);
}

// A photon from just beyond an edge weighs as much more as its start is less dense.
TEST(EmissionGuide, HasNoCliffsAtTheEdgesOfWhatWasFound) {
  const EmissionGuide guide = learned();
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const PathRandom random(4, Stream::setup, static_cast<std::uint64_t>(i), 0);
    const Vec2 a = random.pair(0, 0), b = random.pair(0, 1);
    EmissionNumbers inside{0.5f, 0.25f + kSmall * a.y, kSmall * b.x, 0.75f + kSmall * b.y}, beyond = inside;
    const std::size_t side = i % 2 == 0 ? 0 : 3;  // where boxes of other sizes meet, and where they go on
    if (side == 3) inside[0] = beyond[0] = 0.5f + kSmall * a.x, inside[3] = 0.75f;
    beyond[side] = std::nextafter(inside[side], 0.f);
    worst = std::max(worst, static_cast<double>(guide.density(0, inside) / guide.density(0, beyond)));
  }
  EXPECT_LT(worst, 100);  // millions, if nothing were drawn beyond the edges
}

TEST(EmissionGuide, LosesNoLight) {
  const EmissionGuide guide = learned();
  for (int i = 0; i < 1000; ++i) {
    const PathRandom random(3, Stream::setup, static_cast<std::uint64_t>(i), 0);
    const Vec2 a = random.pair(0, 0), b = random.pair(0, 1);
    for (const int light : {0, 1, 3}) EXPECT_GE(guide.density(light, {a.x, a.y, b.x, b.y}), 0.2499f * kUsual[light]);
  }
}

TEST(EmissionGuide, WithoutRecordsIsAsUsual) {
  const EmissionGuide guide = guide_from({}, kUsual);
  EXPECT_FLOAT_EQ(guide.density(1, {0.5f, 0.1f, 0.9f, 0}), 0.2f);
}

// So many records that several threads take part, at every stage.
TEST(EmissionGuide, IsTheSameWithAnyNumberOfThreadsAndInUsedMemory) {
  const auto saved = [](int threads, GuideRoom& room) {
    const ThreadLimit limit(threads);
    std::vector<EmissionRecord> records = records_in_a_small_box(30'000);
    for (std::size_t i = 20'000; i < records.size(); ++i) records[i].light = 3;
    SavedState state;
    EmissionGuide guide = guide_from(records, kUsual, room);
    EXPECT_GT(guide.cell_count(), 1000u);
    guide.persist(state, 4);
    return state.all;
  };
  GuideRoom fresh, used;
  const std::string expected = saved(1, fresh);
  EXPECT_EQ(saved(4, used), expected);
  EXPECT_EQ(saved(3, used), expected);
}

// Lanes find what a loop over records and sides finds, also beyond the box and at its borders.
TEST(QuarterSums, AreThoseOfEachSide) {
  EmissionBox box;
  box.low = {0.5f, 0, 0.25f, 0.75f}, box.size = {0.25f, 1, 0.125f, 0x1p-10f};
  std::vector<EmissionRecord> records;
  for (int i = 0; i < 700; ++i) {
    const PathRandom random(5, Stream::setup, static_cast<std::uint64_t>(i), 0);
    const Vec2 a = random.pair(0, 0), b = random.pair(0, 1);
    const float u[] = {a.x, a.y, b.x, b.y};
    EmissionRecord record{0, {}, 0.1 + static_cast<double>(random.number(0, 5))};
    for (std::size_t side = 0; side < 4; ++side) {
      const float place = i % 3 == 0 ? std::floor(5 * u[side]) / 4 : 1.2f * u[side] - 0.1f;
      record.numbers[side] = box.low[side] + place * box.size[side];
    }
    records.push_back(record);
  }
  const QuarterSums sums(records, box);
  for (std::size_t side = 0; side < 4; ++side) {
    double expected[4] = {};
    std::size_t below = 0;
    for (const EmissionRecord& record : records) {
      const float place = (record.numbers[side] - box.low[side]) * (4 / box.size[side]);
      const int quarter = std::clamp(static_cast<int>(place), 0, 3);
      expected[quarter] += record.value, below += quarter < 2;
      EXPECT_EQ(is_in_upper_half(record, box, side), quarter >= 2);
    }
    for (std::size_t at = 0; at < 4; ++at) EXPECT_EQ(sums.values(side)[at], expected[at]) << side << " " << at;
    EXPECT_EQ(sums.below(side), below);
  }
}

TEST(EmissionGuide, IsTheSameAfterSavingAndLoading) {
  EmissionGuide guide = learned();
  SavedState saved;
  guide.persist(saved, 4);
  EmissionGuide copy;
  LoadedState state(saved.all);
  copy.persist(state, 4);
  for (int i = 0; i < 1000; ++i) {
    const EmissionStart a = draw(guide, i), b = draw(copy, i);
    EXPECT_EQ(a.numbers, b.numbers);
    EXPECT_EQ(a.density, b.density);
  }
}

TEST(EmissionGuide, RefusesDamagedRecords) {
  EmissionGuide guide = learned(200);
  SavedState saved;
  guide.persist(saved, 4);
  for (std::size_t byte = 0; byte < saved.all.size(); byte += 4) {
    std::string damaged = saved.all;
    damaged[byte + 3] = static_cast<char>(damaged[byte + 3] ^ 0x41);
    LoadedState state(damaged);
    EmissionGuide loaded;
    try {
      loaded.persist(state, 4);
    } catch (const std::runtime_error&) {
      continue;
    }
    // Numbers that are possible: it may draw other paths, but only of these lights.
    for (int i = 0; i < 20; ++i) EXPECT_LT(draw(loaded, i).light, 4);
  }
  LoadedState of_others(saved.all);
  EmissionGuide loaded;
  EXPECT_THROW(loaded.persist(of_others, 3), std::runtime_error);
}

}  // namespace emission_guide_test
}  // namespace dspm
