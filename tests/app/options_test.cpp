#include "dspm/app/options/options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/accel/embree_version.h"
#include "dspm/app/tasks/optional_parts.h"
#include "dspm/app/tasks/version_text.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/version.h"

namespace dspm {
namespace {

using CommandWords = std::vector<std::string>;

TEST(Options, ReadsTheUsualOnes) {
  const Options o = parse_options(
      {"a.dsc",        "-o",    "out/a.####.exr", "-t",       "2",       "--seed",       "7",  "--integrator", "sppm",
       "--iterations", "50",    "--photons=1000", "--frames", "1-2",     "--time-limit", "1m", "--quick",      "--png",
       "--float",      "b.dsc", "--memory",       "2G",       "--video", "a.mp4"});
  EXPECT_EQ(o.task, Task::render);
  EXPECT_EQ(o.scenes, (CommandWords{"a.dsc", "b.dsc"}));
  EXPECT_EQ(o.outfile, "out/a.####.exr");
  EXPECT_EQ(o.threads, 2);
  EXPECT_EQ(o.seed, 7u);
  EXPECT_EQ(o.integrator, "sppm");
  EXPECT_EQ(o.iterations, 50);
  EXPECT_EQ(o.photons, 1000);
  EXPECT_EQ(o.frames, (std::vector<Moment>{Moment(0), Moment(1)}));
  EXPECT_EQ(o.time_limit, 60);
  EXPECT_EQ(o.memory, 2'000'000'000u);
  EXPECT_EQ(o.video, "a.mp4");
  EXPECT_TRUE(o.quick);
  EXPECT_TRUE(o.png);
  EXPECT_EQ(o.half, false);
}

TEST(Options, ViewsAreChosen) {
  const Options o = parse_options({"a", "--view", "filmic", "--exposure", "-1.5", "--png-bits", "16", "--png-space",
                                   "display-p3", "--sheet-title", "All of it", "--sheet-tile", "99", "--no-labels"});
  EXPECT_EQ(o.view.view, "filmic");
  EXPECT_EQ(o.view.stops, -1.5);
  EXPECT_EQ(o.view.png_bits, 16);
  EXPECT_TRUE(o.view.display_p3);
  EXPECT_EQ(o.sheet.title, "All of it");
  EXPECT_EQ(o.sheet.tile_width, 99);
  EXPECT_FALSE(o.sheet.labels);
  EXPECT_TRUE(parse_options({"a"}).sheet.labels);
  for (const CommandWords& wrong :
       {CommandWords{"--view", "agxx"}, CommandWords{"--png-bits", "12"}, CommandWords{"--png-space", "p3"},
        CommandWords{"--exposure", "x"}, CommandWords{"--view", "raw", "--png-space", "display-p3"}}) {
    CommandWords words = wrong;
    words.insert(words.begin(), "a");
    EXPECT_THROW(parse_options(words), UsageError) << wrong.back();
  }
}

// Scripts append to a line.
TEST(Options, OfAnOptionThatIsRepeatedTheLastHolds) {
  const Options o = parse_options({"a.dsc",    "-t",
                                   "1",        "-t",
                                   "2",        "--iterations=3",
                                   "--spp",    "4",
                                   "-o",       "a.exr",
                                   "-o",       "b.exr",
                                   "--frames", "1",
                                   "--frames", "2-3",
                                   "-D",       "x=1",
                                   "-D",       "y=2",
                                   "b.dsc",    "--quiet",
                                   "--quiet",  "--time-limit",
                                   "1s",       "--time-limit",
                                   "2s"});
  EXPECT_EQ(o.threads, 2);
  EXPECT_EQ(o.iterations, 4);
  EXPECT_EQ(o.outfile, "b.exr");
  EXPECT_EQ(o.frames, (std::vector<Moment>{Moment(1), Moment(2)}));
  EXPECT_EQ(o.defines, (CommandWords{"x=1", "y=2"}));
  EXPECT_EQ(o.scenes, (CommandWords{"a.dsc", "b.dsc"}));
  EXPECT_EQ(o.time_limit, 2);
}

TEST(Options, NamesEndInAnyCase) {
  EXPECT_EQ(parse_options({"a", "-o", "OUT.EXR"}).outfile, "OUT.EXR");
  EXPECT_EQ(parse_options({"a", "--video", "OUT.Mp4"}).video, "OUT.Mp4");
  EXPECT_EQ(parse_options({"a", "--contact-sheet", "S.PNG"}).contact_sheet, "S.PNG");
  EXPECT_THROW(parse_options({"a", "-o", "OUT.EX"}), UsageError);
}

TEST(Options, UntilErrorIsAShare) { EXPECT_DOUBLE_EQ(parse_options({"a", "--until-error", "2%"}).until_error, 0.02); }

TEST(Options, SppIsAnotherNameOfIterations) { EXPECT_EQ(parse_options({"a", "--spp", "9"}).iterations, 9); }

TEST(Options, StatsTakesItsFileOnlyBehindAnEqualSign) {
  EXPECT_EQ(parse_options({"a"}).stats, "");
  const Options table = parse_options({"--stats", "a.dsc"});
  EXPECT_EQ(table.stats, "table");
  EXPECT_EQ(table.scenes, CommandWords{"a.dsc"});
  EXPECT_EQ(parse_options({"--stats=s.json", "a"}).stats, "s.json");
  EXPECT_EQ(parse_options({"--stats=-", "a"}).stats, "-");
}

TEST(Options, DefinesDoNotSwallowScenes) {
  const Options o = parse_options({"-D", "x=1", "a.dsc", "-Dy=-2 3", "b.dsc"});
  EXPECT_EQ(o.defines, (CommandWords{"x=1", "y=-2 3"}));
  EXPECT_EQ(o.scenes, (CommandWords{"a.dsc", "b.dsc"}));
}

TEST(Options, StandardInputIsADash) { EXPECT_EQ(parse_options({"-"}).scenes, CommandWords{"-"}); }

TEST(Options, PbrtSpellingsWork) {
  const Options o = parse_options({"-OutFile", "x.exr", "--nthreads=3", "-crop_window", "0,.5,0,.5", "a.pbrt"});
  EXPECT_EQ(o.outfile, "x.exr");
  EXPECT_EQ(o.threads, 3);
  ASSERT_TRUE(o.crop_window);
  EXPECT_EQ((*o.crop_window)[1], .5);
}

TEST(Options, TasksNeedNoSceneWhereTheyReadNone) {
  EXPECT_EQ(parse_options({"--list"}).task, Task::list);
  const Options o = parse_options({"--describe", "material:diffuse"});
  EXPECT_EQ(o.task, Task::describe);
  EXPECT_EQ(o.described, "material:diffuse");
  EXPECT_EQ(parse_options({"--check", "a"}).task, Task::check);
  EXPECT_EQ(parse_options({"--format", "a"}).task, Task::format);
}

TEST(Options, WhatMakesNoSenseIsRefused) {
  for (const CommandWords& words :
       std::vector<CommandWords>{{},
                                 {"--check"},
                                 {"a", "--nonsense"},
                                 {"a", "--seed", "x"},
                                 {"a", "--seed", "-1"},
                                 {"a", "--iterations", "-1"},
                                 {"a", "--photons", "0"},
                                 {"a", "--nthreads", "-2"},
                                 {"a", "--outfile"},
                                 {"a", "-D", "x"},
                                 {"a", "-D", "=x"},
                                 {"a", "-o", "x.jpg"},
                                 {"a", "--contact-sheet", "x.exr"},
                                 {"a", "--video", "x.avi"},
                                 {"a", "--cropwindow", "0,1,0,1", "--pixelbounds", "0,1,0,1"}})
    EXPECT_THROW(parse_options(words), UsageError) << (words.empty() ? "" : words.back());
}

TEST(Options, AMisspeltOneIsGuessed) {
  try {
    parse_options({"a", "--sed", "3"});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("\"seed\""), std::string::npos) << error.what();
  }
}

TEST(Options, HelpAndVersionAreInformation) {
  try {
    parse_options({"--help"});
    FAIL();
  } catch (const Information& information) {
    EXPECT_NE(information.text.find("--time-limit TIME"), std::string::npos);
    for (const char* flag : {"  --stats[=FILE]         ", "  --half[=NAMES]         ", "  --denoise [oidn]       ",
                             "  --serve [PORT]         "})
      EXPECT_NE(information.text.find(flag + std::string(" ")), std::string::npos) << flag << information.text;
  }
  try {
    parse_options({"--version"});
    FAIL();
  } catch (const Information& information) {
    EXPECT_EQ(information.text, version_text());
  }
}

TEST(Options, TheVersionNamesTheBuildAndEveryPartOfItOnce) {
  const std::string text = version_text();
  EXPECT_TRUE(text.starts_with(fmt::format("dspm {}\nbuilt by: ", kVersion))) << text;
  EXPECT_NE(text.find(fmt::format("\nEmbree: {}\n", embree_version())), text.npos) << text;
  for (const OptionalPart& part : built_parts()) {
    const std::size_t at = text.find(part.name);
    ASSERT_NE(at, text.npos) << part.name;
    EXPECT_EQ(text.find(part.name, at + 1), text.npos) << part.name;
    EXPECT_EQ(at < text.find("without: "), part.fault().empty()) << part.name;
  }
}

}  // namespace
}  // namespace dspm
