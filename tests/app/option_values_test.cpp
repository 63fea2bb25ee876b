#include "dspm/app/options/option_values.h"

#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

std::vector<int> numbers(std::string_view text) {
  std::vector<int> all;
  for (const Moment moment : parse_frames(text)) all.push_back(moment.number());
  return all;
}

TEST(ParseFrames, AreInOrderWithoutRepetition) {
  EXPECT_EQ(numbers("7"), (std::vector<int>{7}));
  EXPECT_EQ(numbers("1-3,12"), (std::vector<int>{1, 2, 3, 12}));
  EXPECT_EQ(numbers("5,2-3,3,1"), (std::vector<int>{1, 2, 3, 5}));
  EXPECT_EQ(numbers("1001,0"), (std::vector<int>{0, 1001}));
}

TEST(ParseFrames, ARangeMayHaveAStep) {
  EXPECT_EQ(numbers("1-32:8"), (std::vector<int>{1, 9, 17, 25}));
  EXPECT_EQ(numbers("2-6:2,3"), (std::vector<int>{2, 3, 4, 6}));
  EXPECT_EQ(numbers("5-7:2000000000"), (std::vector<int>{5}));
}

TEST(ParseFrames, RefusesWhatIsNoListOfFrames) {
  for (const char* text : {"", "-1", "3-1", "1-", "1,,2", "a", "1 2", "1-2-3", "99999999999", "1-999999999",
                           "1-9:", "1-9:0", "1-9:-2", "9:2", "1:2-9", "1-9:2:2"})
    EXPECT_THROW(parse_frames(text), UsageError) << text;
}

TEST(ParseDuration, AddsItsParts) {
  EXPECT_DOUBLE_EQ(parse_duration("--time-limit", "30s"), 30);
  EXPECT_DOUBLE_EQ(parse_duration("--time-limit", "10m"), 600);
  EXPECT_DOUBLE_EQ(parse_duration("--time-limit", "2h"), 7200);
  EXPECT_DOUBLE_EQ(parse_duration("--time-limit", "1h30m"), 5400);
  EXPECT_DOUBLE_EQ(parse_duration("--time-limit", "1h30m10s"), 5410);
  EXPECT_DOUBLE_EQ(parse_duration("--time-limit", "1.5h"), 5400);
  EXPECT_DOUBLE_EQ(parse_duration("--time-limit", "0.25s"), 0.25);
  EXPECT_DOUBLE_EQ(parse_duration("--time-limit", "90"), 90);
}

TEST(ParseDuration, RefusesWhatIsNone) {
  for (const char* text : {"", "0s", "0", "-3s", "m", "10x", "1h30", "10m x", "1e400s", "1e308h", "nan", "inf", "s30"})
    EXPECT_THROW(parse_duration("--time-limit", text), UsageError) << text;
}

TEST(ParseInterval, IsATimeOrACount) {
  EXPECT_EQ(parse_interval("--write-every", "20").iterations, 20);
  EXPECT_EQ(parse_interval("--write-every", "20").seconds, 0);
  EXPECT_EQ(parse_interval("--write-every", "20s").iterations, 0);
  EXPECT_DOUBLE_EQ(parse_interval("--write-every", "1m20s").seconds, 80);
  EXPECT_THROW(parse_interval("--write-every", "0"), UsageError);
  EXPECT_THROW(parse_interval("--write-every", "-4"), UsageError);
}

TEST(ParseShare, IsAPercentageOrAFraction) {
  EXPECT_DOUBLE_EQ(parse_share("--until-error", "2%"), 0.02);
  EXPECT_DOUBLE_EQ(parse_share("--until-error", "0.02"), 0.02);
  EXPECT_DOUBLE_EQ(parse_share("--until-error", ".5%"), 0.005);
}

TEST(ParseShare, RefusesWhatIsNone) {
  for (const char* text : {"", "%", "0", "0%", "-2%", "2", "100%", "2%%", "2 %", "two", "nan", "inf", "1e-400"})
    EXPECT_THROW(parse_share("--until-error", text), UsageError) << text;
  try {
    parse_share("--until-error", "2");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "--until-error 2: expected an error between 0 and 1 such as 2% or 0.02");
  }
}

TEST(ParseBytes, KnowsThousandsAnd1024s) {
  EXPECT_EQ(parse_bytes("--memory", "4096"), 4096u);
  EXPECT_EQ(parse_bytes("--memory", "512B"), 512u);
  EXPECT_EQ(parse_bytes("--memory", "2G"), 2'000'000'000u);
  EXPECT_EQ(parse_bytes("--memory", "2gb"), 2'000'000'000u);
  EXPECT_EQ(parse_bytes("--memory", "2Gi"), 2u << 30);
  EXPECT_EQ(parse_bytes("--memory", "1.5MiB"), 3u << 19);
  EXPECT_EQ(parse_bytes("--memory", "800k"), 800'000u);
  EXPECT_EQ(parse_bytes("--memory", "1T"), 1'000'000'000'000u);
}

TEST(ParseBytes, RefusesWhatIsNone) {
  for (const char* text : {"", "G", "0", "0G", "-2G", "2X", "2GG", "2 G", "2iB", "0.1", "1e9", "1..5G", "99999999T"})
    EXPECT_THROW(parse_bytes("--memory", text), UsageError) << text;
}

TEST(ParseCropWindow, TakesFourNumbersInOrder) {
  EXPECT_EQ(parse_crop_window("0,.5,0.25,1"), (std::array<double, 4>{0, .5, .25, 1}));
  for (const char* text : {"", "0,1,0", "0,1,0,1,1", "1,0,0,1", "0,1,.5,.5", "-.1,1,0,1", "0,1.1,0,1", "0,1,0,nan"})
    EXPECT_THROW(parse_crop_window(text), UsageError) << text;
}

TEST(ParsePixelBounds, TakesFourIntegersInOrder) {
  EXPECT_EQ(parse_pixel_bounds("0,100,20,30"), (std::array<int, 4>{0, 100, 20, 30}));
  for (const char* text : {"0,1,0", "5,5,0,1", "0,1,3,2", "0,1.5,0,1", "a,b,c,d"})
    EXPECT_THROW(parse_pixel_bounds(text), UsageError) << text;
}

TEST(CanonicalSpelling, IgnoresDashesUnderlinesAndCase) {
  const std::vector<std::string> names = {"time-limit", "seed", "stats"};
  const auto spelt = [&](const char* argument) { return canonical_spelling({argument}, names).front(); };
  for (const char* word : {"--time-limit", "-time-limit", "--timelimit", "-TimeLimit", "--TIME_LIMIT", "--time_limit"})
    EXPECT_EQ(spelt(word), "--time-limit") << word;
  EXPECT_EQ(spelt("-Seed=7"), "--seed=7");
  EXPECT_EQ(spelt("--Stats=Some-File_Name.json"), "--stats=Some-File_Name.json");
  for (const char* word : {"-t", "-t4", "-Dseed=3", "-", "--", "scene.dsc", "seed", "-x", "--seeds", "-5"})
    EXPECT_EQ(spelt(word), word);
}

TEST(CanonicalSpelling, LeavesWhatFollowsTwoDashes) {
  const std::vector<std::string> arguments = {"-SEED", "3", "--", "-SEED"};
  EXPECT_EQ(canonical_spelling(arguments, {"seed"}), (std::vector<std::string>{"--seed", "3", "--", "-SEED"}));
}

TEST(OptionValues, ResolutionsAreSharesOrPixels) {
  EXPECT_EQ(parse_resolution("50%").share, 0.5);
  EXPECT_EQ(parse_resolution("12.5%").share, 0.125);
  EXPECT_EQ(parse_resolution("800x600").width, 800);
  EXPECT_EQ(parse_resolution("800x600").height, 600);
  for (const char* wrong : {"", "%", "0%", "-5%", "nan%", "800", "x", "800x", "0x5", "70000x1", "1e99%", "50", "8x6x4"})
    EXPECT_THROW(parse_resolution(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace dspm
