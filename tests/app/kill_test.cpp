// A render that is killed at random moments, while it computes, writes images or its checkpoint: what is there is
// whole, and in the end it has the bits of an undisturbed one.
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "app/checkpoint_file.h"
#include "image/exr.h"
#include "image/image.h"
#include "tests/app/process.h"

namespace dspm::test {
namespace {

constexpr int kKills = 50;
constexpr int kIterations = 2000;  // more than are done between two kills

/// Over all intervals.
int iterations_in(const TinyDirectory& directory) {
  int sum = 0;
  const CheckpointFile checkpoint(directory / "a");
  for (const IntervalState& interval : checkpoint.intervals()) sum += interval.iterations;
  return sum;
}

void expect_whole_images(const TinyDirectory& directory) {
  for (const char* image : kTinyImages)
    if (directory.has(image)) {
      EXPECT_EQ(read_image(directory / image).width, 12) << image;
    }
}

/// The checkpoint is written before the images of the same iteration, so no image can be of a later one.
void expect_no_image_ahead(const TinyDirectory& directory) {
  const CheckpointFile checkpoint(directory / "a");
  for (const IntervalState& interval : checkpoint.intervals())
    for (const Frame frame : interval.frames)
      if (directory.has(kTinyImages[frame])) {
        EXPECT_LE(read_exr_header(directory / kTinyImages[frame]).integers.at("iterations"), interval.iterations);
      }
}

struct Rhythm {
  const char* integrator;
  int checkpoint_every;  // iterations
};

class Kill : public testing::TestWithParam<Rhythm> {
 protected:
  static std::vector<std::string> with(std::vector<std::string> arguments, int iterations = kIterations) {
    for (const char* own : {"tiny.dsc", "--float", "--quiet", "--integrator", GetParam().integrator, "--iterations"})
      arguments.emplace_back(own);
    arguments.push_back(std::to_string(iterations));
    return arguments;
  }
};

TEST_P(Kill, AtAnyMomentLosesWhatIsNewerThanTheCheckpointAtMost) {
  const int every = GetParam().checkpoint_every;
  const auto writing = [&](const char* option, int iterations = kIterations) {
    return with({"--write-every", "1", "--checkpoint-every", std::to_string(every), option, "a"}, iterations);
  };
  const TinyDirectory directory, calm;
  const auto begin = std::chrono::steady_clock::now();
  run(calm, writing("--checkpoint", 2 * every));
  const std::chrono::duration<double> two_checkpoints = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(20261121);
  std::uniform_real_distribution<double> seconds(0, two_checkpoints.count());
  int done = 0;
  for (int kill = 0; kill < kKills; ++kill) {
    const Process process(directory, writing(directory.has("a") ? "--resume" : "--checkpoint"));
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds(random)));
    process.send(SIGKILL);
    ASSERT_EQ(process.wait().code, -SIGKILL) << "it has ended before it could be killed";
    expect_whole_images(directory);
    if (!directory.has("a")) continue;
    const int now = iterations_in(directory);
    EXPECT_GE(now, done);
    if (every == 1) expect_no_image_ahead(directory);
    done = now;
  }
  EXPECT_GT(done, 0);
  EXPECT_EQ(run(directory, with({"--resume", "a"})).code, 0);
  EXPECT_EQ(run(calm, with({})).code, 0);
  for (const char* image : kTinyImages) EXPECT_EQ(read_image(directory / image), read_image(calm / image));
}

// sppm renders three intervals, one after the other.
INSTANTIATE_TEST_SUITE_P(Integrators, Kill, testing::Values(Rhythm{"dsppm", 1}, Rhythm{"dsppm", 3}, Rhythm{"sppm", 1}));

}  // namespace
}  // namespace dspm::test
