// A render that is interrupted and resumed gives the bits of one that was not; one of another scene is refused.
#include <gtest/gtest.h>

#include <chrono>

#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/image/png.h"
#include "dspm/session/checkpoint/checkpoints.h"
#include "dspm/testing/test_scene.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace checkpoint_test {

Outcome expect_success(const TinyDirectory& directory, const Arguments& arguments) {
  Outcome outcome = run(directory, arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return outcome;
}

std::vector<Image> images_in(const TinyDirectory& directory) {
  std::vector<Image> images;
  for (const char* name : kTinyImages) images.push_back(read_image(directory / name));
  return images;
}

std::vector<Image> undisturbed(const Arguments& arguments, const std::string& scene = kTinyScene) {
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", scene);
  expect_success(directory, Arguments{"tiny.dsc", "--float"} + arguments);
  return images_in(directory);
}

struct Run {
  Arguments arguments;
  std::string scene = kTinyScene;
};

const std::string kFinalGather =
    tiny_scene(R"("dsppm" "string indirect" "photons" "integer iterations" 2 "integer photons" 200)",
               R"("photonmap" "integer finalgather" 2 "integer photons" 200 "integer causticphotons" 200)");

class Resumed : public testing::TestWithParam<Run> {};

TEST_P(Resumed, EqualsARunThatWasNotInterrupted) {
  const auto& [arguments, scene] = GetParam();
  const Arguments how = Arguments{"tiny.dsc", "--float"} + arguments;
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", scene);
  expect_success(directory, how + Arguments{"--iterations", "2", "--checkpoint", "a"});
  expect_success(directory, how + Arguments{"--iterations", "3", "--resume", "a", "-t", "1"});
  expect_success(directory, how + Arguments{"--iterations", "7", "--resume", "a", "--checkpoint", "b", "-t", "3"});
  const std::vector<Image> expected = undisturbed(arguments + Arguments{"--iterations", "7"}, scene);
  EXPECT_EQ(images_in(directory), expected);
  EXPECT_EQ(read_exr_header(directory / kTinyImages[2]).integers.at("iterations"), 7);

  // Once more from the end: nothing is left to do.
  for (const char* image : kTinyImages) std::filesystem::remove(directory / image);
  expect_success(directory, how + Arguments{"--iterations", "7", "--resume", "b"});
  EXPECT_EQ(images_in(directory), expected);
}

std::string name_of(const testing::TestParamInfo<Run>& info) { return "Case" + std::to_string(info.index); }
INSTANTIATE_TEST_SUITE_P(Integrators, Resumed,
                         testing::Values(Run{{"--integrator", "dsppm"}}, Run{{"--integrator", "sppm"}},
                                         Run{{"--integrator", "photonmap"}}, Run{{}, kFinalGather},
                                         Run{{"--integrator", "path"}}, Run{{"--integrator", "vcm"}},
                                         Run{{"--integrator", "dsppm", "--seed", "9"}}),
                         name_of);

/// The whole run's, in the statistics.
double seconds_told(const TinyDirectory& directory, const Arguments& arguments) {
  const std::string json = expect_success(directory, arguments + Arguments{"--stats=-"}).out, key = "\"seconds\": ";
  return std::stod(json.substr(json.find(key) + key.size()));
}

TEST(Checkpoint, AResumedRunCountsWhatRunsBeforeItDid) {
  const TinyDirectory directory;
  const auto iterations = [&] { return read_exr_header(directory / kTinyImages[0]).integers.at("iterations"); };
  const double before =
      seconds_told(directory, {"tiny.dsc", "--iterations", "0", "--time-limit", "0.5s", "--checkpoint", "a"});
  EXPECT_GE(before, 0.5);
  const int done = iterations();
  const double after = seconds_told(directory, {"tiny.dsc", "--iterations", "1", "--resume", "a"});
  EXPECT_GE(after, 0.5);
  EXPECT_EQ(iterations(), done) << "nothing was left to do";
}

TEST(Checkpoint, KeepsProgressiveRadii) {
  for (const char* integrator : {"dsppm", "sppm"}) {
    const TinyDirectory directory;
    put_file(directory / "tiny.dsc",
             tiny_scene("\"dsppm\" \"string indirect\" \"photons\" \"integer iterations\" 2",
                        std::string("\"") + integrator + "\" \"string estimator\" \"hj09\" \"integer iterations\" 6"));
    expect_success(directory, {"tiny.dsc", "--float"});
    const std::vector<Image> expected = images_in(directory);
    expect_success(directory, {"tiny.dsc", "--float", "--iterations", "4", "--checkpoint", "a"});
    expect_success(directory, {"tiny.dsc", "--float", "--resume", "a"});
    EXPECT_EQ(images_in(directory), expected) << integrator;
  }
}

TEST(Checkpoint, HarmlessChangesAreAllowed) {
  const TinyDirectory directory;
  expect_success(directory, {"tiny.dsc", "--float", "--checkpoint", "a"});
  put_file(directory / "tiny.dsc", "# The same with other words.\n" + tiny_scene("tiny.exr", "other.exr"));
  expect_success(directory, {"tiny.dsc", "--float", "--resume", "a", "--iterations", "5", "-t", "1", "--accel",
                             "bruteforce", "--memory", "1G", "-o", "tiny.exr"});
  EXPECT_EQ(images_in(directory), undisturbed({"--iterations", "5"}));
}

struct Change {
  std::string from, to;
  std::string told;
};

TEST(Checkpoint, OfAnotherSceneIsRefusedAndTheChangeNamed) {
  const TinyDirectory directory;
  expect_success(directory, {"tiny.dsc", "--checkpoint", "a"});
  const std::string before = contents(directory / "a");
  const std::vector<Change> changes = {
      {"0.4", "0.41", "tiny.dsc:22:5: error: shape \"sphere\" has changed since the checkpoint"},
      {"[.7 .6 .5]", "[.7 .6 .6]", "tiny.dsc:13:3: error: material \"diffuse\" has changed"},
      {"[5 5 5]", "[5 5 6]", "tiny.dsc:9:5: error: area light \"diffuse\" has changed"},
      {"\"float fov\" 45", "\"float fov\" 46", "tiny.dsc:5:1: error: camera \"perspective\" has changed"},
      {"Translate 1 0 0", "Translate 1 0 1", "shape \"sphere\" has changed"},
      {"Frames 3", "Frames 2", "error: the checkpoint has 3 frames"},
      {"xresolution\" 12", "xresolution\" 13", "the image: 13 x 8 pixels now, 12 x 8 pixels in the checkpoint"},
      {"photons\" 200", "photons\" 201", "tiny.dsc:3:1: error: integrator \"dsppm\" has changed"},
      {"seed\" 5", "seed\" 6", "the seed: 6 now, 5 in the checkpoint"},
      {"WorldBegin", "PixelFilter \"box\" WorldBegin", "the pixel filter has changed since the checkpoint"},
      {"Shape \"sphere\" \"float radius\" 0.4", "", "shape \"sphere\" has been removed since the checkpoint"},
  };
  for (const Change& change : changes) {
    put_file(directory / "tiny.dsc", tiny_scene(change.from, change.to));
    const Outcome outcome = run(directory, {"tiny.dsc", "--resume", "a"});
    EXPECT_EQ(outcome.code, 1) << change.to;
    EXPECT_NE(outcome.err.find(change.told), std::string::npos) << change.to << "\n" << outcome.err;
    EXPECT_EQ(contents(directory / "a"), before);
  }
}

TEST(Checkpoint, WhatChangedIsToldFromTheSettingsOn) {
  const TinyDirectory directory;
  expect_success(directory, {"tiny.dsc", "--checkpoint", "a"});
  put_file(directory / "tiny.dsc", tiny_scene("0.4", "0.41"));
  const Outcome outcome = run(directory, {"tiny.dsc", "--resume", "a", "--seed", "6"});
  EXPECT_LT(outcome.err.find("the seed"), outcome.err.find("shape \"sphere\"")) << outcome.err;
}

TEST(Checkpoint, OfOtherVariationsObjectsOrOrderIsRefused) {
  const std::string lamp = "LightSource \"point\" \"rgb I\" [1 1 1] ", spot = "LightSource \"spot\" \"rgb I\" [1 1 1] ";
  const std::string red = "MakeNamedMaterial \"top\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0] ";
  const std::string blue = "MakeNamedMaterial \"top\" \"string type\" \"diffuse\" \"rgb reflectance\" [0 0 1] ";
  const std::string top = "MakeNamedMaterial \"top\" \"string type\" \"diffuse\" ";
  const auto variations = [&](const std::string& oak, const std::string& steel) {
    return top + "VariationBegin \"oak\" " + oak + "VariationEnd VariationBegin \"steel\" " + steel + "VariationEnd ";
  };
  const auto object = [](const char* radius, const char* place) {
    return std::string("ObjectBegin \"o\" Shape \"sphere\" \"float radius\" ") + radius +
           " ObjectEnd AttributeBegin Translate " + place + " 0 0 ObjectInstance \"o\" AttributeEnd ";
  };
  const std::vector<Change> changes = {
      {lamp + spot, spot + lamp, "the order of the scene's parts has changed"},
      {variations(red, blue), variations(blue, red), "material \"top\" of variation \"oak\" has changed"},
      {object("1", "2"), object("1.5", "2"), "shape \"sphere\" of object \"o\" has changed"},
      {object("1", "2"), object("1", "3"), "instance of \"o\" has changed"},
  };
  for (const Change& change : changes) {
    const TinyDirectory directory;
    put_file(directory / "tiny.dsc", kTinyScene + change.from);
    expect_success(directory, {"tiny.dsc", "--checkpoint", "a", "--iterations", "1"});
    put_file(directory / "tiny.dsc", kTinyScene + change.to);
    const Outcome outcome = run(directory, {"tiny.dsc", "--resume", "a"});
    EXPECT_EQ(outcome.code, 1) << change.told;
    EXPECT_NE(outcome.err.find(change.told), std::string::npos) << change.told << "\n" << outcome.err;
  }
}

TEST(Checkpoint, OfOtherFilesIsRefused) {
  const TinyDirectory directory;
  const auto mesh = [](const char* x) {
    return std::string(
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n") +
           x + " 0 0\n0 1 0\n3 0 1 2\n";
  };
  const std::string wood = "Texture \"wood\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\"\n";
  put_file(directory / "mesh.ply", mesh("1"));
  write_png(directory / "wood.png", Image(2, 2));
  put_file(directory / "tiny.dsc", kTinyScene + wood + "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n");
  expect_success(directory, {"tiny.dsc", "--checkpoint", "a"});
  expect_success(directory, {"tiny.dsc", "--resume", "a"});
  put_file(directory / "mesh.ply", mesh("2"));
  write_png(directory / "wood.png", Image(2, 1));
  const Outcome outcome = run(directory, {"tiny.dsc", "--resume", "a"});
  EXPECT_EQ(outcome.code, 1);
  for (const char* file : {"mesh.ply", "wood.png"})
    EXPECT_NE(outcome.err.find(std::string(file) + " has changed since the checkpoint"), std::string::npos)
        << outcome.err;
}

TEST(Checkpoint, IsNeverOverwrittenByAnotherRun) {
  const TinyDirectory directory;
  expect_success(directory, {"tiny.dsc", "--checkpoint", "a"});
  const std::string before = contents(directory / "a");
  const Outcome outcome = run(directory, {"tiny.dsc", "--checkpoint", "a"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("continue it with --resume a"), std::string::npos) << outcome.err;
  EXPECT_EQ(contents(directory / "a"), before);
}

TEST(Checkpoint, ThatOthersPutThereIsLeftAlone) {
  const TinyDirectory directory;
  const Process process(directory, {"tiny.dsc", "--iterations", "0", "--write-every", "1", "--checkpoint", "a"});
  ASSERT_TRUE(appears(directory / "tiny.0003.exr"));
  EXPECT_TRUE(directory.has("a")) << "the name is taken from the start";
  put_file(directory / "other", "precious");
  std::filesystem::rename(directory / "other", directory / "a");
  process.send(SIGINT);
  EXPECT_EQ(process.wait().code, 130);
  EXPECT_EQ(contents(directory / "a"), "precious");
  EXPECT_NE(contents(directory / "err.txt").find("another program has put a file of its own there"), std::string::npos);
}

// Between the look whether there is one and the first write, the scene is made.
TEST(Checkpoint, ThatOthersPutThereMeanwhileIsLeftAlone) {
  const TinyDirectory directory;
  TestScene test(kTinyScene);
  CheckpointSettings settings;
  settings.checkpoint = directory / "a";
  Messages messages(true);
  Checkpoints checkpoints(test.job(), "", settings, nullptr, messages);
  put_file(directory / "a", "precious");
  const auto scene = test.scene(test.all_frames());
  const auto integrator = test.integrator(*scene);
  EXPECT_THROW(checkpoints.begin(test.intervals(), *integrator), std::runtime_error);
  EXPECT_EQ(contents(directory / "a"), "precious");
}

TEST(Checkpoint, ThatCannotBeOpenedEndsNoRun) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer looks at memory through pipes, and there are none left for it";
#endif
  const TinyDirectory directory;
  const Process process(directory, {"tiny.dsc", "--checkpoint", "a"}, "out.txt", "err.txt", [] {
    const int next = dup(0);  // two more files may be open: one too few, behind the first write
    close(next);
    const rlimit few{static_cast<rlim_t>(next + 2), static_cast<rlim_t>(next + 2)};
    setrlimit(RLIMIT_NOFILE, &few);
  });
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write a: it cannot be read: Too many open files"), std::string::npos)
      << outcome.err;
  for (const char* image : kTinyImages) EXPECT_EQ(read_image(directory / image).width, 12);
}

TEST(Checkpoint, GoesToAnotherFileEvenIfNothingIsLeftToDo) {
  const TinyDirectory directory;
  expect_success(directory, {"tiny.dsc", "--checkpoint", "a"});
  expect_success(directory, {"tiny.dsc", "--resume", "a", "--checkpoint", "b"});
  expect_success(directory, {"tiny.dsc", "--float", "--resume", "b", "--iterations", "4"});
  EXPECT_EQ(images_in(directory), undisturbed({"--iterations", "4"}));
}

TEST(Checkpoint, WhereItCannotBeIsKnownBeforeTheFirstIteration) {
  const TinyDirectory directory;
  for (const char* file : {"missing/a", "tiny.dsc", "."}) {
    const Outcome outcome = run(directory, {"tiny.dsc", "--checkpoint", file});
    EXPECT_NE(outcome.code, 0) << file;
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    EXPECT_FALSE(directory.has("tiny.0001.exr"));
  }
  const Outcome outcome = run(directory, {"tiny.dsc", "--resume", "missing"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("checkpoint missing: there is no such file"), std::string::npos) << outcome.err;
}

TEST(Checkpoint, DamageIsFound) {
  const TinyDirectory directory;
  expect_success(directory, {"tiny.dsc", "--checkpoint", "a"});
  const std::string whole = contents(directory / "a");
  std::vector<std::string> damaged = {"", "no checkpoint", whole + "x"};
  for (std::size_t i = 0; i < 12; ++i) {
    const std::size_t at = whole.size() * i / 12;
    damaged.push_back(whole.substr(0, at));
    damaged.push_back(whole);
    damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 16);
  }
  for (const std::string& bytes : damaged) {
    put_file(directory / "b", bytes);
    const Outcome outcome = run(directory, {"tiny.dsc", "--resume", "b"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("checkpoint b: it "), std::string::npos) << outcome.err;
  }
}

TEST(Checkpoint, IsWrittenAtTheEndThatASignalAsksFor) {
  const TinyDirectory directory;
  const Process process(directory, {"tiny.dsc", "--float", "--iterations", "0", "--write-every", "1", "--checkpoint",
                                    "a", "--checkpoint-every", "1h"});
  ASSERT_TRUE(appears(directory / "tiny.0003.exr"));
  process.send(SIGTERM);
  EXPECT_EQ(process.wait().code, 143);
  const int done = read_exr_header(directory / kTinyImages[0]).integers.at("iterations");
  const std::string iterations = std::to_string(done + 3);
  expect_success(directory, {"tiny.dsc", "--float", "--resume", "a", "--iterations", iterations});
  EXPECT_EQ(images_in(directory), undisturbed({"--iterations", iterations}));
}

TEST(Checkpoint, KnowsTheTimeOfAllIntervals) {
  const TinyDirectory directory;
  expect_success(directory, {"tiny.dsc", "--integrator", "sppm", "--checkpoint", "a"});
  double before = 0;
  const CheckpointFile file(directory / "a");
  for (const IntervalState& interval : file.intervals()) before += interval.seconds;
  const auto begin = std::chrono::steady_clock::now();
  expect_success(directory, {"tiny.dsc", "--integrator", "sppm", "--resume", "a", "--stats=s.json"});  // none is left
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  const std::string key = "\"seconds\": ", json = contents(directory / "s.json");
  const double seconds = std::stod(json.substr(json.find(key) + key.size()));
  EXPECT_GE(seconds, before);
  EXPECT_LE(seconds, before + taken.count());
}

TEST(Checkpoint, AWholeNumberOfIterationsMayLieBetween) {
  const TinyDirectory directory;
  const Process process(directory, {"tiny.dsc", "--iterations", "0", "--checkpoint", "a", "--checkpoint-every", "2"});
  EXPECT_TRUE(appears(directory / "a"));
  process.send(SIGKILL);
  EXPECT_EQ(process.wait().code, -SIGKILL);
  expect_success(directory, {"tiny.dsc", "--resume", "a", "--iterations", "1"});
}

TEST(Signals, ImagesCanBeAskedFor) {
  for (const int signal : {SIGHUP, SIGUSR1}) {
    const TinyDirectory directory;
    const Process process(directory, {"tiny.dsc", "--iterations", "0"});
    EXPECT_TRUE(says(directory, "memory"));
    process.send(signal);
    EXPECT_TRUE(appears(directory / "tiny.0003.exr"));
    process.send(SIGINT);
    EXPECT_EQ(process.wait().code, 130);
  }
}

TEST(Signals, AnIterationThatTakesTooLongIsGivenUp) {
  const TinyDirectory directory;
  put_file(directory / "tiny.dsc", tiny_scene("\"diffuse\" \"rgb reflectance\" [.7 .6 .5]", "\"conductor\""));
  const Process process(directory, {"tiny.dsc", "--iterations", "0", "--photons", "1000000000"});
  EXPECT_TRUE(says(directory, "memory"));
  const auto begin = std::chrono::steady_clock::now();
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 130);
  EXPECT_NE(outcome.err.find("interrupted before the first iteration"), std::string::npos) << outcome.err;
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

}  // namespace checkpoint_test
}  // namespace dspm::test
