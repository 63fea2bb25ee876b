// A render that is killed at random moments, while it computes, writes images or its checkpoint: what is there is
// whole, and in the end it has the bits of an undisturbed one.
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "dspm/base/math/moments.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/session/checkpoint/checkpoint_file.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace kill_test {

constexpr int kKills = 25;  // in each rhythm

/// Without learning where photons start, kills meet what is written more often.
class QuickDirectory : public TinyDirectory {
 public:
  QuickDirectory() {
    const std::string photons = R"("integer photons" 200)";
    put_file(*this / "tiny.dsc", tiny_scene(photons, photons + R"( "string emission" "power")"));
  }
};

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
    for (const FileFrame frame : interval.places.frames)
      if (directory.has(kTinyImages[frame.slot()])) {
        EXPECT_LE(read_exr_header(directory / kTinyImages[frame.slot()]).integers.at("iterations"),
                  interval.iterations);
      }
}

struct Rhythm {
  const char* integrator;
  int iterations;        // of each interval
  int checkpoint_every;  // iterations
};

class Kill : public testing::TestWithParam<Rhythm> {
 protected:
  static std::vector<std::string> writing(const char* option) {
    const auto& [integrator, iterations, every] = GetParam();
    const std::string end = "--iterations=" + std::to_string(iterations);
    const std::string rhythm = "--checkpoint-every=" + std::to_string(every);
    return {"tiny.dsc", "--float", "--quiet", "--integrator", integrator, end, "--write-every=1", rhythm, option, "a"};
  }

  void expect_final_images(const TinyDirectory& directory) const {
    for (const char* image : kTinyImages) EXPECT_EQ(read_image(directory / image), read_image(calm_ / image));
  }

  QuickDirectory calm_;
};

// A run that gets to its end between two kills is compared with the calm one, and another begins.
TEST_P(Kill, AtAnyMomentLosesWhatIsNewerThanTheCheckpointAtMost) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run(calm_, writing("--checkpoint")).code, 0);
  const std::chrono::duration<double> calm_run = std::chrono::steady_clock::now() - begin;
  const QuickDirectory directory;
  std::mt19937 random(20261121);
  std::uniform_real_distribution<double> share(0, 1);
  double patience = calm_run.count() / 2;
  int done = 0, ends = 0;
  for (int kills = 0; (kills < kKills || ends == 0) && !HasFailure();) {
    const Process process(directory, writing(directory.has("a") ? "--resume" : "--checkpoint"));
    std::this_thread::sleep_for(std::chrono::duration<double>(patience * share(random)));
    process.send(SIGKILL);
    const int code = process.wait().code;
    expect_whole_images(directory);
    if (code == 0) {
      ++ends, done = 0;
      expect_final_images(directory);
      for (const char* file : {"a", kTinyImages[0], kTinyImages[1], kTinyImages[2]})
        std::filesystem::remove(directory / file);
      continue;
    }
    ASSERT_EQ(code, -SIGKILL);
    ++kills;
    const int now = directory.has("a") ? iterations_in(directory) : 0;
    EXPECT_GE(now, done);
    if (now == done) patience *= 1.05;  // for machines that have become slower
    if (now > 0 && GetParam().checkpoint_every == 1) expect_no_image_ahead(directory);
    done = now;
  }
}

// sppm renders three intervals, one after the other.
INSTANTIATE_TEST_SUITE_P(Integrators, Kill,
                         testing::Values(Rhythm{"dsppm", 10, 1}, Rhythm{"dsppm", 12, 3}, Rhythm{"sppm", 4, 1},
                                         Rhythm{"sppm", 6, 3}));

}  // namespace kill_test
}  // namespace dspm::test
