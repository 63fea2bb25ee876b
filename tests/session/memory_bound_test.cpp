// --memory: a run keeps within it and its images stay the same, or it says what it would take before it renders.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "dspm/image/image.h"
#include "tests/support/fake_ffmpeg.h"
#include "tests/support/process.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DSPM_MEMORY_OF_ITS_OWN 1  // a sanitizer's account of memory is not the program's
#endif

namespace dspm::test {
namespace memory_bound_test {

constexpr double kMegabyte = 1e6;
constexpr float kRounding = 1e-4f;  // of sums of partial sums

/// Holds the tiny scene with more pixels and photons, for an integrator with these words.
class Directory : public TemporaryDirectory {
 public:
  explicit Directory(const std::string& integrator = R"("dsppm" "string emission" "power" "string direct" "photons")") {
    std::string scene = kTinyScene;
    const auto replace = [&](const std::string& from, const std::string& to) {
      scene.replace(scene.find(from), from.size(), to);
    };
    replace(R"("dsppm" "string indirect" "photons")", integrator);
    replace(R"("integer photons" 200)", R"("integer photons" 50000)");
    replace("12 \"integer yresolution\" 8", "192 \"integer yresolution\" 144");
    put_file(*this / "tiny.dsc", scene);
  }
};

Outcome run_within(const TemporaryDirectory& directory, const std::string& memory, std::vector<std::string> more = {}) {
  more.insert(more.end(), {"tiny.dsc", "--float", "--memory", memory});
  return run(directory, more);
}

/// What a message of too little memory says that a frame takes, in bytes.
double bytes_taken(const std::string& message) {
  const std::string before = "even one frame at a time takes ";
  const std::size_t at = message.find(before);
  return at == message.npos ? 0 : kMegabyte * std::strtod(message.c_str() + at + before.size(), nullptr);
}

/// The bytes that a run of this scene takes at least.
double least_bytes(const TemporaryDirectory& directory) { return bytes_taken(run_within(directory, "27M").err); }

std::string megabytes(double bytes) { return fmt::format("{:.1f}M", bytes / kMegabyte + 0.1); }

class Images {
 public:
  explicit Images(const Directory& directory) {
    for (const char* name : kTinyImages) all_.push_back(read_image(directory / name));
  }
  friend bool operator==(const Images&, const Images&) = default;

  void expect_close(const Images& other) const {
    for (std::size_t i = 0; i < all_.size(); ++i)
      for (std::size_t p = 0; p < all_[i].pixels.size(); ++p)
        for (int c = 0; c < 3; ++c) {
          const float a = all_[i].pixels[p][c], b = other.all_[i].pixels[p][c];
          ASSERT_NEAR(a, b, kRounding * std::max(a, max_component(all_[i].pixels[p])))
              << "pixel " << p << " of " << i + 1;
        }
  }

 private:
  std::vector<Image> all_;
};

class MemoryBound : public ::testing::TestWithParam<const char*> {};

TEST_P(MemoryBound, IsKeptAndChangesNoImage) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory(GetParam());
  const Outcome unbounded = run(directory, {"tiny.dsc", "--float"});
  ASSERT_EQ(unbounded.code, 0) << unbounded.err;
  const Images images(directory);
  const Outcome none = run_within(directory, "27M");
  EXPECT_EQ(none.code, 1);
  double least = bytes_taken(none.err);
  ASSERT_GT(least, 20 * kMegabyte) << none.err;
  // The first message may be about learning where photons start, before anything else was counted.
  if (const Outcome learned = run_within(directory, megabytes(least)); learned.code != 0)
    least = bytes_taken(learned.err);
  for (const double bytes : {least, 1.3 * least, 100 * least}) {
    const Outcome bounded = run_within(directory, megabytes(bytes));
    ASSERT_EQ(bounded.code, 0) << bounded.err;
    EXPECT_LE(bounded.peak_bytes, bytes);
    EXPECT_NE(bounded.err.find("dspm: memory "), std::string::npos) << bounded.err;
    images.expect_close(Images(directory));
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, MemoryBound,
                         ::testing::Values(R"("dsppm" "string indirect" "photons")",
                                           R"("dsppm" "string estimator" "hj09")",
                                           R"("sppm" "string estimator" "hj09")",
                                           R"("photonmap" "integer causticphotons" 50000)",
                                           R"("photonmap" "integer causticphotons" 50000 "integer finalgather" 2)"));

/// A square of n x n small ones, each of two triangles, as an ASCII PLY.
std::string sheet(int n) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      (n + 1) * (n + 1), 2 * n * n);
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) text += fmt::format("{:.4f} {:.4f} 3\n", 8. * x / n - 4, 8. * y / n - 4);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + n + 1;
      text += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, a + 1, b, b, a + 1, b + 1);
    }
  return text;
}

void add_sheet(const Directory& directory, int n) {
  put_file(directory / "sheet.ply", sheet(n));
  put_file(directory / "tiny.dsc",
           contents(directory / "tiny.dsc") + "\nShape \"plymesh\" \"string filename\" \"sheet.ply\"\n");
}

TEST(Memory, OfMeshesAndTheirTreesCounts) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory;
  const double without = least_bytes(directory);
  add_sheet(directory, 300);
  double least = bytes_taken(run_within(directory, megabytes(1.3 * without)).err);  // enough to read it
  ASSERT_GT(least, without + 10 * kMegabyte);
  Outcome bounded = run_within(directory, megabytes(least));
  if (bounded.code != 0) {  // the first message was about building the trees, before anything else was counted
    least = bytes_taken(bounded.err);
    bounded = run_within(directory, megabytes(least));
  }
  ASSERT_EQ(bounded.code, 0) << bounded.err;
  EXPECT_LE(bounded.peak_bytes, least);
}

// An image in memory and on its way into two files is most of what this run takes.
TEST(Memory, OfWritingImagesCounts) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const TemporaryDirectory directory;
  put_file(directory / "tiny.dsc", R"(
Integrator "path" "integer iterations" 1
Film "rgb" "integer xresolution" 1000 "integer yresolution" 750
WorldBegin
LightSource "infinite"
)");
  const double least = least_bytes(directory);
  const Outcome bounded = run_within(directory, megabytes(least), {"--png", "--contact-sheet", "sheet.png"});
  ASSERT_EQ(bounded.code, 1) << "a contact sheet takes memory, too";
  const double with_sheet = bytes_taken(bounded.err);
  const Outcome outcome = run_within(directory, megabytes(with_sheet), {"--png", "--contact-sheet", "sheet.png"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LE(outcome.peak_bytes, with_sheet);
  const Outcome without_sheet = run_within(directory, megabytes(least), {"--png"});
  ASSERT_EQ(without_sheet.code, 0) << without_sheet.err;
  EXPECT_LE(without_sheet.peak_bytes, least);
}

TEST(Memory, SaysWhatItMeans) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory;
  const std::string least = megabytes(least_bytes(directory));
  const Outcome outcome = run_within(directory, least);
  EXPECT_NE(outcome.err.find("3 intervals of 1 frame, photons in "), std::string::npos) << outcome.err;
  const Outcome ample = run_within(directory, "1T");
  EXPECT_NE(ample.err.find("memory 1000000.0 MB: 3 frames together\n"), std::string::npos) << ample.err;
  EXPECT_EQ(run_within(directory, least, {"--quiet"}).err, "");
}

TEST(Memory, HasTheSameBitsOnEveryRun) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory;
  const std::string bytes = megabytes(1.15 * least_bytes(directory));
  ASSERT_EQ(run_within(directory, bytes).code, 0);
  const Images images(directory);
  for (const char* threads : {"1", "2", "5", "64"}) {
    ASSERT_EQ(run_within(directory, bytes, {"--nthreads", threads}).code, 0);
    EXPECT_TRUE(images == Images(directory)) << threads << " threads";
  }
}

std::string plan(const Directory& directory, std::size_t bytes, const std::string& threads) {
  return run_within(directory, std::to_string(bytes), {"--check", "--nthreads", threads}).err;
}

/// To the byte: what threads take may not move the place where the plan changes.
void expect_plan_for_any_threads(const Directory& directory) {
  const auto is_short = [&](std::size_t bytes) {
    return plan(directory, bytes, "1").find("3 frames together\n") == std::string::npos;
  };
  std::size_t low = 20'000'000, high = 400'000'000;
  ASSERT_TRUE(is_short(low));
  ASSERT_FALSE(is_short(high));
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (is_short(middle) ? low : high) = middle;
  }
  for (const char* threads : {"2", "7", "64"})
    for (const std::size_t bytes : {low, high})
      EXPECT_EQ(plan(directory, bytes, threads), plan(directory, bytes, "1")) << bytes << " bytes, " << threads;
}

TEST(Memory, HasTheSamePlanWithAnyNumberOfThreads) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory;
  expect_plan_for_any_threads(directory);
  add_sheet(directory, 60);  // enough triangles for Embree's builder
  expect_plan_for_any_threads(directory);
}

TEST(Memory, SufficesForManyThreads) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory;
  const double least = least_bytes(directory);
  const Outcome outcome = run_within(directory, megabytes(least), {"--nthreads", "64"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LE(outcome.peak_bytes, least);
}

TEST(Memory, ExplainTellsTheIntervalsOfTheRun) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory;
  const std::string least = megabytes(least_bytes(directory));
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--explain"}, {"--explain", "--check"}}) {
    const std::string said = run_within(directory, least, more).err;
    EXPECT_EQ(said.find("3 frames rendered together"), std::string::npos) << said;
  }
}

TEST(Memory, IsPlannedByACheck) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory;
  const Outcome none = run_within(directory, "27M", {"--check"});
  EXPECT_EQ(none.code, 1);
  const Outcome least = run_within(directory, megabytes(bytes_taken(none.err)), {"--check"});
  EXPECT_EQ(least.code, 0) << least.err;
  EXPECT_NE(least.err.find("3 intervals of 1 frame, photons in "), std::string::npos) << least.err;
}

/// As many balls as parts of the image are looked at: none hides behind its regular place.
std::string regular_scene() {
  std::string scene = R"(
Frames 16
Integrator "dsppm" "integer iterations" 1 "integer photons" 1000
LookAt 0 0 -10  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Film "rgb" "integer xresolution" 512 "integer yresolution" 512 "string filename" "tiny.exr"
WorldBegin
LightSource "point" "rgb I" [5 5 5] "point3 from" [0 0 -5]
AttributeBegin Translate 0 0 3 Shape "disk" "float radius" 4 AttributeEnd
DynamicBegin "balls" Keyframe 1 Translate 0 0 0 Keyframe 16 Translate 0 0 -0.5 KeyframeEnd
)";
  for (int i = 0; i < 32 * 32; ++i)
    scene += fmt::format("AttributeBegin Translate {} {} 0 Shape \"sphere\" \"float radius\" 0.0234375 AttributeEnd\n",
                         -1 + i % 32 / 16., -1 + i / 32 / 16.);
  return scene + "DynamicEnd\n";
}

TEST(Memory, IsKeptWhereTheImageIsRegular) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const TemporaryDirectory directory;
  put_file(directory / "tiny.dsc", regular_scene());
  for (const char* memory : {"120M", "200M"}) {
    const Outcome outcome = run(directory, {"tiny.dsc", "--memory", memory});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_LE(outcome.peak_bytes, kMegabyte * std::strtod(memory, nullptr));
  }
}

TEST(Memory, HoldsForRunsWithAVideo) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory directory;
  const FakeFfmpeg ffmpeg(kKeepAll);
  const double least = least_bytes(directory);
  const Outcome outcome = run_within(directory, megabytes(least), {"--video", "a.mp4"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LE(outcome.peak_bytes, least);
}

TEST(Memory, TooLittleIsAnErrorBeforeRendering) {
  const Directory directory;
  for (const char* memory : {"1", "3M", "27M"}) {
    const Outcome outcome = run_within(directory, memory, {"--png", "--contact-sheet", "sheet.png", "--stats=s.json"});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("dspm: memory "), std::string::npos) << outcome.err;
    EXPECT_EQ(directory.file_count(), 3) << memory;  // the scene, and what was said
  }
#ifndef DSPM_MEMORY_OF_ITS_OWN
  const std::string message = run_within(directory, "27M").err;
  for (const char* what : {"scene and program", "trees", "pixels", "hit points", "photons", "writing of images"})
    EXPECT_NE(message.find(what), std::string::npos) << message;
#endif
}

TEST(Memory, AnIntegratorThatCannotBeMadeIsAnErrorOfTheScene) {
  const TemporaryDirectory directory;
  put_file(directory / "catcher.dsc", R"(Integrator "ambientocclusion"
Camera "perspective" Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin Shape "disk" "float height" 3 "bool shadowcatcher" true)");
  const Outcome outcome = run(directory, {"catcher.dsc", "--memory", "500M"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("catcher.dsc:1:1: error: "), std::string::npos) << outcome.err;
}

TEST(Memory, SenselessBytesAreUsageErrors) {
  const Directory directory;
  for (const char* memory : {"0", "-1", "12X", "", "G", "1e3", "2GG", "nan", "1 G", "2000000T"})
    EXPECT_EQ(run_within(directory, memory).code, 2) << memory;
}

}  // namespace memory_bound_test
}  // namespace dspm::test
