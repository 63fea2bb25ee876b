// --part and --merge: parts of a render add up to it, in any order, and what is no part of it is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/session/checkpoint/checkpoint_file.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace parts_test {

constexpr float kRounding = 1e-6f;

/// Of the brightest pixel.
float difference(const Image& a, const Image& b) {
  float most = 0, brightest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      brightest = std::max(brightest, std::abs(a.pixels[i][c]));
      most = std::max(most, std::abs(a.pixels[i][c] - b.pixels[i][c]));
    }
  return brightest > 0 ? most / brightest : most;
}

/// 0: it is not there yet.
int iterations_in(const std::filesystem::path& checkpoint) {
  if (!std::filesystem::exists(checkpoint)) return 0;
  return CheckpointFile(checkpoint).intervals().front().iterations;
}

class Parts : public testing::Test {
 protected:
  Outcome good(const Arguments& arguments) const {
    Outcome outcome = run(directory, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  void expect_refused(const Arguments& arguments, int code, const std::string& why) const {
    const Outcome outcome = run(directory, arguments);
    EXPECT_EQ(outcome.code, code) << why;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err << "instead of: " << why;
  }

  /// Into the files 1 to `of`.
  void render_parts(int of, const Arguments& how) const {
    for (int number = 1; number <= of; ++number) render_part(number, of, how);
  }
  void render_part(int number, int of, const Arguments& how) const {
    const std::string name = std::to_string(number);
    good(Arguments{"tiny.dsc", "--part", name + "/" + std::to_string(of), "--checkpoint", name} + how);
  }
  std::vector<Image> images(const std::string& name = "tiny") const {
    std::vector<Image> all;
    for (const char* number : {".0001", ".0002", ".0003"})
      all.push_back(read_image(directory / (name + number + ".exr")));
    return all;
  }
  int iterations(const std::string& image = "tiny.0002.exr") const {
    return read_exr_header(directory / image).integers.at("iterations");
  }
  void expect_near(const std::vector<Image>& a, const std::vector<Image>& b) const {
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(difference(a[i], b[i]), kRounding) << "frame " << i + 1;
  }

  TinyDirectory directory;
};

class PartsOf : public Parts, public testing::WithParamInterface<Arguments> {};

TEST_P(PartsOf, ARenderAddUpToIt) {
  const Arguments how = Arguments{"--float", "--iterations", "12"} + GetParam();
  good(Arguments{"tiny.dsc", "-o", "whole.exr"} + how);
  render_parts(3, how + Arguments{"-t", "1"});
  EXPECT_FALSE(directory.has("tiny.0001.exr")) << "a part writes no images";
  good({"--merge", "1", "2", "3", "-o", "tiny.exr"});
  expect_near(images(), images("whole"));
  EXPECT_EQ(iterations(), 12);
  good({"--merge", "3", "1", "2", "-o", "again.exr"});
  EXPECT_EQ(images("again"), images());
  good(Arguments{"tiny.dsc", "--merge", "2", "3", "1", "--checkpoint", "all", "--float"} + GetParam());
  EXPECT_EQ(images(), images("again"));

  good(Arguments{"tiny.dsc", "-o", "whole.exr", "--float", "--iterations", "14"} + GetParam());
  good(Arguments{"tiny.dsc", "--resume", "all", "--float", "--iterations", "14"} + GetParam());
  expect_near(images(), images("whole"));
}

INSTANTIATE_TEST_SUITE_P(, PartsOf,
                         testing::Values(Arguments{"--integrator", "dsppm"}, Arguments{"--integrator", "sppm"},
                                         Arguments{"--integrator", "photonmap"}, Arguments{"--integrator", "path"},
                                         Arguments{"--integrator", "vcm"},
                                         Arguments{"--integrator", "ambientocclusion"}),
                         [](const auto& of) { return of.param[1]; });

TEST_F(Parts, HaveAllOutputs) {
  put_file(directory / "tiny.dsc", tiny_scene(R"("diffuse" "rgb L")", R"("diffuse" "string group" "key" "rgb L")"));
  const Arguments how = {"--float", "--iterations", "8", "--aov",
                         "N,Z,object,alpha,motion,cryptoobject,photons,radius,lights,variance"};
  good(Arguments{"tiny.dsc", "-o", "whole.exr"} + how);
  render_parts(4, how);
  const Outcome outcome =
      good({"--merge", "1", "2", "3", "4", "-o", "tiny.exr", "--png", "--contact-sheet", "all.png", "--stats=-"});
  EXPECT_TRUE(directory.has("tiny.0003.png") && directory.has("all.png"));
  EXPECT_NE(outcome.out.find("\"iterations\""), std::string::npos) << outcome.out;
  EXPECT_EQ(iterations(), 8);
  const ExrHeader header = read_exr_header(directory / "tiny.0002.exr");
  EXPECT_EQ(header.channels, read_exr_header(directory / "whole.0002.exr").channels);
  EXPECT_EQ(header.numbers.at("photons"), read_exr_header(directory / "whole.0002.exr").numbers.at("photons"));
  for (const std::string& channel : header.channels) {
    if (channel.starts_with("object")) continue;  // on edges there may be no majority
    const auto of = [&](const char* file) { return read_exr_channels(directory / file, {channel}); };
    // How much less the variance is than that of independent iterations, each part finds out for itself.
    EXPECT_LE(difference(of("tiny.0002.exr"), of("whole.0002.exr")), channel.starts_with("variance") ? 0.3f : kRounding)
        << channel;
  }
}

TEST_F(Parts, MayBeMissingOrShort) {
  const Arguments how = {"--float", "--iterations", "8"};
  render_parts(4, how);
  const Outcome outcome = good({"--merge", "1", "4", "2", "-o", "tiny.exr"});
  EXPECT_NE(outcome.err.find("part 3 of 4 is missing: the images are those of the others' iterations"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(iterations(), 6);
  expect_refused({"--merge", "1", "2", "4", "-o", "tiny.exr", "--checkpoint", "all"}, 2,
                 "no render can go on from there, as iterations are missing");
  std::filesystem::remove(directory / "3");
  render_part(3, 4, {"--float", "--iterations", "4"});
  EXPECT_NE(good({"--merge", "1", "2", "3", "4", "-o", "tiny.exr"}).err.find("3: part 3/4, 1 iteration\n"),
            std::string::npos);
  EXPECT_EQ(iterations(), 7);

  // More iterations later, of all.
  for (const char* part : {"1", "2", "3", "4"})
    good({"tiny.dsc", "--float", "--iterations", "10", "--part", std::string(part) + "/4", "--resume", part});
  good({"tiny.dsc", "-o", "whole.exr", "--float", "--iterations", "10"});
  good({"--merge", "1", "2", "3", "4", "-o", "tiny.exr"});
  EXPECT_EQ(iterations(), 10);
  expect_near(images(), images("whole"));
}

TEST_F(Parts, KnowTheErrorOfTheWhole) {
  const Arguments how = {"--float", "--iterations", "64"};
  good(Arguments{"tiny.dsc", "-o", "whole.exr"} + how);
  render_parts(4, how);
  good({"--merge", "1", "2", "3", "4", "-o", "tiny.exr"});
  const auto error = [&](const std::string& file) { return read_exr_header(directory / file).numbers.at("error"); };
  for (const char* frame : {".0001.exr", ".0002.exr", ".0003.exr"})
    EXPECT_NEAR(error(std::string("tiny") + frame) / error(std::string("whole") + frame), 1, 0.2) << frame;
}

TEST_F(Parts, KeepTheMemoryPlan) {
  const Arguments how = {"--float", "--iterations", "4", "--memory", "60M"};
  render_parts(2, how);
  good(Arguments{"tiny.dsc", "-o", "whole.exr"} + how);
  good({"--merge", "2", "1", "-o", "tiny.exr"});
  expect_near(images(), images("whole"));
  expect_refused({"tiny.dsc", "--part", "1/2", "--resume", "1"}, 2,
                 "--resume 1: parts keep their bound on memory, here --memory 60000000");
  std::filesystem::remove(directory / "2");
  render_part(2, 2, {"--iterations", "4"});
  expect_refused({"--merge", "1", "2", "-o", "tiny.exr"}, 2,
                 "--merge: 1 was rendered with --memory 60000000, 2 with no bound on memory");
}

TEST_F(Parts, OfTheFramesAreImagesAtOnce) {
  good({"tiny.dsc", "-o", "whole.exr", "--float"});
  const Arguments first_half = {"tiny.dsc", "--float", "--part", "frames:1/2"};
  good(first_half);
  EXPECT_TRUE(directory.has("tiny.0001.exr"));
  EXPECT_FALSE(directory.has("tiny.0003.exr"));
  std::filesystem::remove(directory / "tiny.0001.exr");
  // Of the frames, parts of the iterations.
  for (const char* part : {"1", "2"})
    good({"tiny.dsc", "--float", "--part", std::string("frames:2/2,") + part + "/2", "--checkpoint", part});
  good({"--merge", "1", "2", "--float"});
  EXPECT_TRUE(directory.has("tiny.0003.exr"));
  EXPECT_FALSE(directory.has("tiny.0001.exr"));
  good(first_half);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(difference(images()[i], images("whole")[i]), 1e-5f);
  expect_refused({"tiny.dsc", "--part", "frames:7/8"}, 2, "--part frames:7/8: the frames make only 3 parts");
}

TEST_F(Parts, ArePlannedFromTrialIterations) {
  const std::string plan = good({"tiny.dsc", "--plan", "6", "--iterations", "24"}).out;
  std::vector<std::string> ways;
  std::istringstream lines(plan);
  for (std::string line, way; std::getline(lines, line);) {
    std::istringstream(line) >> way;
    ways.push_back(way);
  }
  EXPECT_EQ(ways, (std::vector<std::string>{"--part", "frames:1/3,1/2", "frames:1/2,1/3", "1/6", "(one"}))
      << "three frames make no six parts\n"
      << plan;
  EXPECT_NE(plan.find("fastest"), std::string::npos);
  const std::string of_one_frame = good({"tiny.dsc", "--plan", "6", "--iterations", "24", "--frames", "2"}).out;
  EXPECT_NE(of_one_frame.find("\n1/6 "), std::string::npos) << of_one_frame;
  EXPECT_NE(of_one_frame.find("\n(one machine) "), std::string::npos) << of_one_frame;
  expect_refused({"tiny.dsc", "--plan", "2", "--iterations", "0"}, 2, "--plan: of how many iterations?");
  expect_refused({"tiny.dsc", "--plan", "7", "--iterations", "6"}, 2, "--plan 7: neither frames nor iterations");
}

TEST_F(Parts, OfOtherRendersAreRefusedByName) {
  render_parts(2, {});
  std::filesystem::copy(directory / "1", directory / "copy");
  expect_refused({"--merge", "1", "2", "copy", "-o", "tiny.exr"}, 2, "--merge: 1 and copy both hold part 1/2");
  expect_refused({"tiny.dsc", "--part", "2/2", "--resume", "1"}, 2,
                 "--resume 1: it holds part 1/2, and this run is part 2/2");
  expect_refused({"tiny.dsc", "--resume", "1"}, 2, "--resume 1: it holds part 1/2, and this run is all iterations");
  render_part(3, 3, {"--iterations", "3"});
  expect_refused({"--merge", "1", "3", "-o", "tiny.exr"}, 2, "--merge: 1 holds part 1/2, 3 holds part 3/3");
  std::filesystem::remove(directory / "2");
  render_part(2, 2, {"--frames", "1-2"});
  expect_refused({"--merge", "1", "2", "-o", "tiny.exr"}, 2,
                 "--merge: 1 and 2 do not hold the same frames in the same intervals");
  std::filesystem::remove(directory / "2");
  put_file(directory / "tiny.dsc", tiny_scene("0.4", "0.41"));
  render_part(2, 2, {"--seed", "6"});
  put_file(directory / "tiny.dsc", kTinyScene);
  const Arguments merge = {"--merge", "1", "2", "-o", "tiny.exr"};
  expect_refused(merge, 1, "shape \"sphere\" has changed since 2");
  expect_refused(merge, 1, "the seed: 5 now, 6 in 2");
  EXPECT_FALSE(directory.has("tiny.0001.exr"));
}

TEST_F(Parts, AreRefusedWhereTheyMakeNoSense) {
  put_file(directory / "tiny.dsc", tiny_scene("\"dsppm\"", "\"dsppm\" \"string estimator\" \"hj09\""));
  expect_refused({"tiny.dsc", "--part", "1/2", "--checkpoint", "a"}, 2,
                 "cannot be rendered in parts: the radii of hj09 depend on the photons");
  EXPECT_FALSE(directory.has("a"));
  put_file(directory / "tiny.dsc", kTinyScene);
  const Arguments part = {"tiny.dsc", "--part", "1/2", "--checkpoint", "a"};
  expect_refused(part + Arguments{"--until-error", "2%"}, 2, "--part and --until-error exclude each other");
  expect_refused(part + Arguments{"-o", "a.exr"}, 2, "--part and -o exclude each other: a part writes no images");
  expect_refused(part + Arguments{"--iterations", "1"}, 2,
                 "--part 1/2: 1 iteration cannot make so many parts; ask for fewer, or for more --iterations");
  expect_refused({"tiny.dsc", "--part", "1/2"}, 2, "--part: which file keeps it? Give --checkpoint");
  for (const char* wrong : {"0/2", "3/2", "1", "a/b", "1/2/3", "1/100000"})
    expect_refused({"tiny.dsc", "--checkpoint", "a", "--part", wrong}, 2, std::string("--part ") + wrong);
  expect_refused({"--merge", "a", "--iterations", "7"}, 2, "--merge and --iterations exclude each other");
  expect_refused({"--merge", "missing"}, 1, "checkpoint missing: there is no such file");
}

TEST_F(Parts, GoOnAfterTheyWereKilled) {
  const Arguments how = {"--float", "--iterations", "400"};
  render_parts(2, how);
  good({"--merge", "1", "2", "-o", "whole.exr"});
  const Arguments part = Arguments{"tiny.dsc", "--part", "2/2", "--checkpoint-every", "1"} + how;
  const Process process(directory, part + Arguments{"--checkpoint", "killed"});
  ASSERT_TRUE(comes_true([&] { return iterations_in(directory / "killed") > 2; }));
  process.send(SIGKILL);
  process.wait();
  good(part + Arguments{"--resume", "killed"});
  good({"--merge", "1", "killed", "-o", "tiny.exr"});
  EXPECT_EQ(images(), images("whole"));
}

}  // namespace parts_test
}  // namespace dspm::test
