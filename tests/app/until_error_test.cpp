// --until-error, as a user gives it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

const Arguments kUntil = {"tiny.dsc", "--float", "--until-error", "3%"};

void expect_success(const TinyDirectory& directory, const Arguments& arguments) {
  const Outcome outcome = run(directory, arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
}

/// What a run leaves: iterations, errors and pixels by frame.
struct Result {
  std::vector<int> iterations;
  std::vector<double> errors;
  std::vector<Image> images;

  friend bool operator==(const Result&, const Result&) = default;
};

Result result_of(const TinyDirectory& directory) {
  Result result;
  for (const char* name : kTinyImages) {
    const ExrHeader header = read_exr_header(directory / name);
    result.iterations.push_back(header.integers.at("iterations"));
    if (header.numbers.contains("error")) result.errors.push_back(header.numbers.at("error"));
    result.images.push_back(read_image(directory / name));
  }
  return result;
}

Result result_of(const Arguments& arguments) {
  const TinyDirectory directory;
  expect_success(directory, arguments);
  return result_of(directory);
}

TEST(UntilError, EndsWhereTheWorstFrameIsGoodEnough) {
  const Result result = result_of(kUntil);
  ASSERT_EQ(result.errors.size(), 3u);
  EXPECT_LE(*std::max_element(result.errors.begin(), result.errors.end()), 0.03);
  const int end = result.iterations[0];
  EXPECT_EQ(result.iterations, std::vector<int>(3, end));
  ASSERT_GT(end, 8);
  // Not before: a run that is ended there by --iterations has not reached it.
  const Result before = result_of(kUntil + Arguments{"--iterations", std::to_string(end - 1)});
  EXPECT_GT(*std::max_element(before.errors.begin(), before.errors.end()), 0.03);
  EXPECT_EQ(before.iterations[0], end - 1);
}

TEST(UntilError, HeadersTellTheBlurApart) {
  const TinyDirectory directory;
  expect_success(directory, kUntil);
  const double radius = read_exr_header(directory / kTinyImages[0]).numbers.at("radius in pixels");
  EXPECT_GT(radius, 1);
  EXPECT_LT(radius, 4);  // with which it began
  expect_success(directory, kUntil + Arguments{"--integrator", "path"});
  EXPECT_FALSE(read_exr_header(directory / kTinyImages[0]).numbers.contains("radius in pixels"));
}

TEST(UntilError, GivesTheImagesOfThatManyIterations) {
  const Result until = result_of(kUntil);
  const Result counted = result_of({"tiny.dsc", "--float", "--iterations", std::to_string(until.iterations[0])});
  EXPECT_EQ(until.images, counted.images);
  for (const double error : counted.errors) EXPECT_NEAR(error, 0.05, 0.03);
}

TEST(UntilError, AFrameAloneGivesTheJointImageInAsManyIterations) {
  const Result joint = result_of(kUntil);
  const TinyDirectory directory;
  expect_success(directory,
                 {"tiny.dsc", "--float", "--frames", "2", "--iterations", std::to_string(joint.iterations[1])});
  const Image alone = read_image(directory / kTinyImages[1]);
  for (std::size_t i = 0; i < alone.pixels.size(); ++i)
    EXPECT_NEAR(luminance(alone.pixels[i]), luminance(joint.images[1].pixels[i]), 1e-4f);
}

TEST(UntilError, EachFrameIntervalHasItsOwnIterations) {
  const Arguments sppm = {"--integrator", "sppm"};
  const Result all = result_of(kUntil + sppm);
  for (const int frame : {0, 1, 2}) {
    const auto j = static_cast<std::size_t>(frame);
    EXPECT_LE(all.errors[j], 0.03);
    const TinyDirectory directory;
    expect_success(directory, Arguments{"tiny.dsc", "--float", "--frames", std::to_string(frame + 1), "--iterations",
                                        std::to_string(all.iterations[j])} +
                                  sppm);
    EXPECT_EQ(read_image(directory / kTinyImages[j]), all.images[j]);
  }
}

TEST(UntilError, ThreadsDoNotMatter) {
  EXPECT_EQ(result_of(kUntil + Arguments{"-t", "1"}), result_of(kUntil + Arguments{"-t", "4"}));
}

TEST(UntilError, AResumedRunEndsAtTheSameIteration) {
  for (const char* integrator : {"dsppm", "path", "sppm"}) {
    const Arguments how = kUntil + Arguments{"--integrator", integrator};
    const TinyDirectory directory;
    expect_success(directory, how + Arguments{"--iterations", "5", "--checkpoint", "a"});
    expect_success(directory, how + Arguments{"--iterations", "11", "--resume", "a"});
    expect_success(directory, how + Arguments{"--resume", "a"});
    EXPECT_EQ(result_of(directory), result_of(how)) << integrator;
  }
}

TEST(UntilError, ContinuesARunThatBeganWithoutIt) {
  const TinyDirectory directory;
  expect_success(directory, {"tiny.dsc", "--float", "--iterations", "7", "--checkpoint", "a"});
  expect_success(directory, kUntil + Arguments{"--resume", "a"});
  EXPECT_LE(result_of(directory).errors.at(0), 0.03);
}

TEST(UntilError, ARunWithoutItDoesNotEndAtAnErrorOfZero) {
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", tiny_scene("[5 5 5]", "[0 0 0]"));
  expect_success(directory, {"tiny.dsc", "--iterations", "9"});
  EXPECT_EQ(result_of(directory).iterations, std::vector<int>(3, 9));
}

TEST(UntilError, TimeMayEndItFirst) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--until-error", "0.001%", "--time-limit", "0.5s"});
  EXPECT_EQ(outcome.code, 0);
  // A busy machine may not come to the first estimate.
  EXPECT_TRUE(outcome.err.find(", more than was wanted") != std::string::npos ||
              outcome.err.find("are too few to estimate the error") != std::string::npos)
      << outcome.err;
}

TEST(UntilError, FitsIntoBoundedMemory) {
  EXPECT_EQ(result_of(kUntil + Arguments{"--memory", "1G"}).iterations, result_of(kUntil).iterations);
}

TEST(UntilError, DoesNotWaitForBlackFrames) {
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", tiny_scene("[5 5 5]", "[0 0 0]"));
  const Outcome outcome = run(directory, kUntil);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("warning: frame 1 shows nothing of which an error could be estimated"), std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace dspm::test
