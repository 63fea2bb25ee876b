// How many photon paths are found: where the command line says it, and where not.
#include <gtest/gtest.h>

#include "dspm/image/image.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

bool says(const std::string& text, const std::string& words) { return text.find(words) != text.npos; }

const std::string kByPower =
    tiny_scene("\"integer photons\" 200", "\"integer photons\" 200 \"string emission\" \"power\"");

TEST(FoundPhotons, AreInTheLogOfAGuidedRun) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc"});
  EXPECT_TRUE(says(outcome.err, "dspm: photons: ")) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "of the paths are found by hit points")) << outcome.err;
  EXPECT_FALSE(says(run(directory, {"tiny.dsc", "--quiet"}).err, "photons")) << "quiet";
  EXPECT_FALSE(says(run(directory, {"tiny.dsc", "--integrator", "path"}).err, "found"));
}

// Whether they are merged or not: there may be no hit points that find them.
TEST(FoundPhotons, AreLightPathsOfVcm) {
  const TinyDirectory directory;
  for (const char* merge : {"true", "false"}) {
    put_file(directory / "vcm.dsc",
             tiny_scene("\"dsppm\" \"string indirect\" \"photons\"", "\"vcm\" \"bool merge\" " + std::string(merge)));
    const std::string log = run(directory, {"vcm.dsc"}).err;
    EXPECT_TRUE(says(log, "dspm: light paths: ")) << log;
    EXPECT_TRUE(says(log, "% of the paths bring what the camera sees other than direct light")) << log;
    EXPECT_FALSE(says(log, "hit points")) << log;
  }
}

// Where nothing is learned, paths are only counted if somebody wants to know.
TEST(FoundPhotons, AreCountedIfStatisticsAreWanted) {
  const TinyDirectory directory;
  put_file(directory / "power.dsc", kByPower);
  EXPECT_FALSE(says(run(directory, {"power.dsc"}).err, "found by hit points"));
  const Image plain = read_image(directory / "tiny.0002.exr");
  const std::string table = run(directory, {"power.dsc", "--stats"}).err;
  EXPECT_TRUE(says(table, "found by hit points")) << table;
  EXPECT_TRUE(says(table, "photons of                paths by power             paths     found\n  sphere")) << table;
  const Image counted = read_image(directory / "tiny.0002.exr");
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) EXPECT_EQ(plain.pixels[i], counted.pixels[i]) << i;
  const std::string json = run(directory, {"power.dsc", "--stats=-"}).out;
  EXPECT_TRUE(says(json, "\"emission\": \"power\"")) << json;
  EXPECT_TRUE(says(json, "\"name\": \"sphere\"")) << json;
  // Memory is for the render.
  EXPECT_FALSE(says(run(directory, {"power.dsc", "--stats", "--memory", "200M"}).err, "found by hit points"));
}

TEST(FoundPhotons, AreExplainedWithoutARender) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--explain", "--check"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(says(outcome.err, "\nphotons: start ")) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "\nphotons of sphere: 100% of the paths, 100% by power; found: ")) << outcome.err;
  EXPECT_FALSE(directory.has("tiny.0001.exr"));
}

// A run that continues another one knows what the first had learned.
TEST(FoundPhotons, AreKeptInCheckpoints) {
  const TinyDirectory directory;
  const std::string first = run(directory, {"tiny.dsc", "--checkpoint", "c", "--stats=-"}).out;
  const std::string second = run(directory, {"tiny.dsc", "--resume", "c", "--iterations", "4", "--stats=-"}).out;
  const auto emission = [](const std::string& json) {
    const std::size_t begin = json.find("\"emission\": ["), end = json.find("\"photon_tests\"");
    return begin < end ? json.substr(begin, end - begin) : "";
  };
  EXPECT_TRUE(says(emission(first), "sphere")) << first;
  EXPECT_EQ(emission(first), emission(second));
}

TEST(FoundPhotons, AreFoundAlikeWithASavedGuide) {
  const TinyDirectory directory;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--check", "--save-guide", "g"}).code, 0);
  const std::string learned = run(directory, {"tiny.dsc", "--stats=-"}).out;
  const Image without = read_image(directory / "tiny.0002.exr");
  const std::string given = run(directory, {"tiny.dsc", "--stats=-", "--guide", "g"}).out;
  const Image with = read_image(directory / "tiny.0002.exr");
  for (std::size_t i = 0; i < with.pixels.size(); ++i) EXPECT_EQ(with.pixels[i], without.pixels[i]) << i;
  const Outcome path = run(directory, {"tiny.dsc", "--integrator", "path", "--guide", "g"});
  EXPECT_EQ(path.code, 2);
  EXPECT_TRUE(says(path.err, "--guide g: integrator \"path\" starts no photons by a guide here")) << path.err;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--guide", "g", "--save-guide", "h"}).code, 2);
  EXPECT_EQ(run(directory, {"tiny.dsc", "--save-guide", "tiny.dsc"}).code, 2);
}

TEST(FoundPhotons, ACheckpointRemembersTheGuide) {
  const TinyDirectory directory;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--check", "--save-guide", "g"}).code, 0);
  EXPECT_EQ(run(directory, {"tiny.dsc", "--check", "--save-guide", "h", "--seed", "9"}).code, 0);
  EXPECT_EQ(run(directory, {"tiny.dsc", "--guide", "g", "--checkpoint", "c"}).code, 0);
  const Outcome learning = run(directory, {"tiny.dsc", "--resume", "c", "--iterations", "3"});
  EXPECT_EQ(learning.code, 1);
  EXPECT_TRUE(says(learning.err, "the guide (--guide) has been removed since the checkpoint")) << learning.err;
  const Outcome other = run(directory, {"tiny.dsc", "--guide", "h", "--resume", "c", "--iterations", "3"});
  EXPECT_TRUE(says(other.err, "the guide (--guide) has changed since the checkpoint")) << other.err;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--guide", "g", "--resume", "c", "--iterations", "3"}).code, 0);
}

}  // namespace
}  // namespace dspm::test
