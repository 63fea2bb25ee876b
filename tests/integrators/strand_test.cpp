#include "dspm/integrators/transport/strand.h"

#include <gtest/gtest.h>

#include <map>

namespace dspm {
namespace strand_test {

constexpr FrameSet kFew(0b0110), kOther(0b1001);

std::map<std::uint64_t, Spectrum> contents(const Strand* list, FrameSet frames) {
  std::map<std::uint64_t, Spectrum> all;
  for_each_strand(list, frames, [&](FrameSet alike, const Spectrum& weight) { all[alike.bits()] = weight; });
  return all;
}

TEST(Strands, NoListIsWeightOne) {
  EXPECT_EQ(contents(nullptr, kFew), (std::map<std::uint64_t, Spectrum>{{kFew.bits(), Spectrum(1)}}));
}

TEST(Strands, ListsKeepWeightsAndLeaveOutOtherFrames) {
  StrandTable table;
  Strands red_and_blue;
  red_and_blue.add(kFew, {1, 0, 0});
  red_and_blue.add(kOther, {0, 0, 1});
  Spectrum common;
  const StrandList first = table.add(red_and_blue, common), second = table.add(red_and_blue, common);
  EXPECT_EQ(common, Spectrum(1));
  EXPECT_NE(first, second);
  EXPECT_FALSE(table.of(second)->grey);
  EXPECT_EQ(contents(table.of(second), FrameSet(0b0011)),
            (std::map<std::uint64_t, Spectrum>{{0b0010, {1, 0, 0}}, {0b0001, {0, 0, 1}}}));
  EXPECT_EQ(contents(table.of(first), kOther), (std::map<std::uint64_t, Spectrum>{{kOther.bits(), {0, 0, 1}}}));
}

TEST(Strands, MultiplesOfAColourBecomeGrey) {
  Strands dimming;
  dimming.add(kFew, {2, 1, 0});
  dimming.add(kOther, {1, 0.5f, 0});
  EXPECT_EQ(dimming.take_common(), Spectrum(2, 1, 0));
  ASSERT_EQ(dimming.strands().size(), 2u);
  for (const Strand& strand : dimming.strands()) EXPECT_TRUE(strand.grey);
  EXPECT_EQ(dimming.strands()[0].weight, Spectrum(1));
  EXPECT_EQ(dimming.strands()[1].weight, Spectrum(0.5f));
}

TEST(Strands, ColoursThatNearlyAgreeAreNoMultiples) {
  Strands tinted;
  tinted.add(kFew, {1, 1, 1});
  tinted.add(kOther, {1, 1, 0.95f});
  const Spectrum common = tinted.take_common();
  ASSERT_EQ(tinted.strands().size(), 2u);
  EXPECT_FALSE(tinted.strands()[0].grey);
  EXPECT_EQ(common * tinted.strands()[1].weight, Spectrum(1, 1, 0.95f));
}

TEST(Strands, EqualWeightsAreOneStrand) {
  Strands alike;
  alike.add(kFew, {0.3f, 0.2f, 0.1f});
  alike.add(kOther, {0.3f, 0.2f, 0.1f});
  EXPECT_EQ(alike.take_common(), Spectrum(0.3f, 0.2f, 0.1f));
  ASSERT_EQ(alike.strands().size(), 1u);
  EXPECT_EQ(alike.strands()[0].frames, kFew | kOther);
}

}  // namespace strand_test
}  // namespace dspm
