// What a user meets: exit codes, streams, files.
#include <gtest/gtest.h>

#include "dspm/base/system/version.h"
#include "dspm/image/exr.h"
#include "tests/output/json_check.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

/// Sums may have another order.
void expect_close(const Rgb& a, const Rgb& b) {
  for (const auto& [x, y] : {std::pair(a.r, b.r), {a.g, b.g}, {a.b, b.b}}) EXPECT_NEAR(x, y, 1e-5f * y);
}

TEST(CommandLine, RendersEveryFrameToItsFile) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("3 frames of 12 x 8 pixels, dsppm, 2 iterations"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("200 photons"), std::string::npos) << outcome.err;
  for (const char* name : kTinyImages) {
    const Image image = read_image(directory / name);
    EXPECT_EQ(image.width, 12);
    EXPECT_EQ(image.height, 8);
  }
  const ExrHeader header = read_exr_header(directory / "tiny.0002.exr");
  EXPECT_EQ(header.texts.at("scene"), "tiny.dsc");
  EXPECT_EQ(header.texts.at("integrator"), "dsppm");
  EXPECT_EQ(header.texts.at("software"), "dspm " + std::string(kVersion));
  EXPECT_FALSE(header.texts.contains("version")) << "OpenEXR's own name for a number, of deep images";
  EXPECT_EQ(header.integers.at("iterations"), 2);
  EXPECT_EQ(header.integers.at("frame"), 2);
  EXPECT_EQ(header.numbers.at("seed"), 5);
  EXPECT_EQ(header.numbers.at("photons"), 400);
  EXPECT_GT(header.numbers.at("seconds"), 0);
  EXPECT_EQ(header.frames_per_second, 25);
}

TEST(CommandLine, QuietSaysNothing) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST(CommandLine, FramesMayHaveAFirstNumber) {
  const TinyDirectory directory;
  std::string shot = kTinyScene;
  for (std::size_t at = 0; (at = shot.find("Keyframe ", at)) != shot.npos;) shot.insert(at += 9, "100");
  shot.insert(shot.find("Frames 3") + 8, " \"integer first\" 1001");
  put_file(directory / "shot.dsc", shot);
  EXPECT_EQ(run(directory, {"shot.dsc", "--float", "-o", "shot.exr"}).code, 0);
  EXPECT_EQ(run(directory, {"shot.dsc", "--float", "--frames", "1002", "-o", "some.exr"}).code, 0);
  EXPECT_EQ(run(directory, {"tiny.dsc", "--float", "--frames", "2", "-o", "tiny.exr"}).code, 0);
  EXPECT_EQ(read_exr_header(directory / "shot.1002.exr").integers.at("frame"), 1002);
  const Image all = read_image(directory / "shot.1002.exr"), some = read_image(directory / "some.1002.exr"),
              tiny = read_image(directory / "tiny.0002.exr");
  ASSERT_EQ(all.pixels.size(), some.pixels.size());
  for (std::size_t p = 0; p < all.pixels.size(); ++p) {
    expect_close(all.pixels[p], some.pixels[p]);
    expect_close(tiny.pixels[p], some.pixels[p]);
  }
  EXPECT_FALSE(directory.has("some.1001.exr"));
  const Outcome outside = run(directory, {"shot.dsc", "--frames", "1-3"});
  EXPECT_EQ(outside.code, 2);
  EXPECT_NE(outside.err.find("there is no frame 1, the first one is 1001"), std::string::npos) << outside.err;
}

TEST(CommandLine, FramesKeepTheirNumbersAndTheirPixels) {
  const TinyDirectory directory;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--float"}).code, 0);
  EXPECT_EQ(run(directory, {"tiny.dsc", "--float", "--frames", "2-3", "-o", "some-%03d.exr"}).code, 0);
  EXPECT_FALSE(directory.has("some-001.exr"));
  for (const char* pair : {"2", "3"}) {
    const Image all = read_image(directory / (std::string("tiny.000") + pair + ".exr"));
    const Image some = read_image(directory / (std::string("some-00") + pair + ".exr"));
    ASSERT_EQ(all.pixels.size(), some.pixels.size());
    for (std::size_t p = 0; p < all.pixels.size(); ++p) expect_close(all.pixels[p], some.pixels[p]);
  }
}

TEST(CommandLine, ACropIsAPartOfTheImage) {
  const TinyDirectory directory;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--float", "--frames", "1", "-o", "all.exr"}).code, 0);
  EXPECT_EQ(run(directory, {"tiny.dsc", "--float", "--frames", "1", "-o", "part.exr", "--pixelbounds", "3,9,2,7"}).code,
            0);
  EXPECT_EQ(run(directory, {"tiny.dsc", "--frames", "1", "-o", "w.exr", "--cropwindow", "0.25,0.75,0.25,0.875"}).code,
            0);
  const Image all = read_image(directory / "all.0001.exr"), part = read_image(directory / "part.0001.exr");
  ASSERT_EQ(part.width, 6);
  ASSERT_EQ(part.height, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 6; ++x) expect_close(part.at(x, y), all.at(x + 3, y + 2));
  const ExrHeader header = read_exr_header(directory / "w.0001.exr");
  EXPECT_EQ(header.x, 3);
  EXPECT_EQ(header.y, 2);
  EXPECT_EQ(header.full_width, 12);
}

TEST(CommandLine, OptionsComeBeforeTheScene) {
  const TinyDirectory directory;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--frames", "1", "--seed", "9", "--iterations", "3", "--photons", "10"}).code,
            0);
  const ExrHeader header = read_exr_header(directory / "tiny.0001.exr");
  EXPECT_EQ(header.numbers.at("seed"), 9);
  EXPECT_EQ(header.integers.at("iterations"), 3);
  EXPECT_EQ(header.numbers.at("photons"), 30);
}

TEST(CommandLine, PngAndContactSheet) {
  const TinyDirectory directory;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--png", "--contact-sheet", "sheet.png"}).code, 0);
  for (const char* name : {"tiny.0001.exr", "tiny.0001.png", "tiny.0003.png", "sheet.png"})
    EXPECT_TRUE(directory.has(name));
  EXPECT_EQ(run(directory, {"tiny.dsc", "-o", "only.##.png"}).code, 0);
  EXPECT_TRUE(directory.has("only.01.png"));
  EXPECT_FALSE(directory.has("only.01.exr"));
}

TEST(CommandLine, QuickIsAQuarter) {
  const TinyDirectory directory;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--quick"}).code, 0);
  EXPECT_EQ(read_image(directory / "tiny.0001.exr").width, 3);
  EXPECT_EQ(read_exr_header(directory / "tiny.0001.exr").integers.at("iterations"), 1);
}

TEST(CommandLine, StatisticsAreATableOrJson) {
  const TinyDirectory directory;
  const Outcome table = run(directory, {"tiny.dsc", "--stats"});
  EXPECT_EQ(table.out, "");
  EXPECT_NE(table.err.find("photons stored"), std::string::npos) << table.err;
  const Outcome to_stdout = run(directory, {"tiny.dsc", "--stats=-"});
  EXPECT_TRUE(JsonCheck::valid(to_stdout.out)) << to_stdout.out;
  EXPECT_EQ(run(directory, {"tiny.dsc", "--stats=stats.json"}).code, 0);
  EXPECT_TRUE(JsonCheck::valid(contents(directory / "stats.json")));
}

TEST(CommandLine, ADirectoryThatIsMissingIsSaidBeforeRendering) {
  const TinyDirectory directory;
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"tiny.dsc", "-o", "none/x.exr"},
                                             {"tiny.dsc", "--contact-sheet", "none/x.png"},
                                             {"tiny.dsc", "--stats=none/x.json"}}) {
    const Outcome outcome = run(directory, words);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("none/x"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("iterations"), std::string::npos) << outcome.err;
    EXPECT_FALSE(directory.has("tiny.0001.exr"));
  }
}

TEST(CommandLine, NoFileReplacesOneThatTheSceneReads) {
  const TinyDirectory directory;
  run(directory, {"tiny.dsc", "--iterations", "1", "-o", "wood.##.png"});
  const std::string wood = contents(directory / "wood.02.png");
  put_file(directory / "part.dsc", "Texture \"wood\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.02.png\"\n");
  put_file(directory / "tiny.dsc", kTinyScene + "Include \"part.dsc\"\n");
  for (const auto& [option, file] : {std::pair{"-o", "wood.##.png"}, std::pair{"--contact-sheet", "wood.02.png"},
                                     std::pair{"--checkpoint", "part.dsc"}}) {
    const Outcome outcome = run(directory, {"tiny.dsc", option, file});
    EXPECT_EQ(outcome.code, 2) << file << outcome.err;
  }
  const Outcome outcome = run(directory, {"tiny.dsc", "-o", "wood.##.png"});
  EXPECT_NE(outcome.err.find("wood.02.png would be both a file that the scene reads and 2's image"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(contents(directory / "wood.02.png"), wood);
}

TEST(CommandLine, NoFileReplacesAnother) {
  const TinyDirectory directory;
  std::filesystem::create_symlink("tiny.0001.png", directory / "link.png");
  const std::vector<std::pair<std::vector<std::string>, std::string>> all = {
      {{"--video", "a.mp4", "--stats=./a.mp4"}, "a.mp4 would be both the statistics and the video"},
      {{"--png", "--contact-sheet", "tiny.0003.png"}, "tiny.0003.png would be both 3's PNG and the contact sheet"},
      {{"--png", "--contact-sheet", "link.png"}, "link.png would be both 1's PNG and the contact sheet"},
      {{"-o", "a.##.png", "--contact-sheet", "a.02.png"}, "2's image and the contact sheet"},
      {{"--stats=" + (directory / "tiny.0002.exr").string()}, "2's image and the statistics"},
      {{"--stats=tiny.dsc"}, "tiny.dsc would be both the scene and the statistics"}};
  for (const auto& [words, message] : all) {
    std::vector<std::string> arguments{"tiny.dsc"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const Outcome outcome = run(directory, arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_FALSE(directory.has("tiny.0001.exr"));
  }
}

TEST(CommandLine, WrongUseIsTwo) {
  const TinyDirectory directory;
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{},
                                             {"tiny.dsc", "--nonsense"},
                                             {"tiny.dsc", "--video", ""},
                                             {"tiny.dsc", "--contact-sheet", ""},
                                             {"tiny.dsc", "-o", ""},
                                             {"tiny.dsc", "--frames", "4"},
                                             {"tiny.dsc", "--integrator", "dspm"},
                                             {"tiny.dsc", "--accel", "kdtree"},
                                             {"tiny.dsc", "--pixelbounds", "20,30,0,4"},
                                             {"--describe", "material:wood"}}) {
    const Outcome outcome = run(directory, words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err, "");
    EXPECT_EQ(outcome.out, "");
  }
}

/// Scripts pass one set of options to all integrators.
TEST(CommandLine, PhotonsThatNobodyEmitsAreANote) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--integrator", "path", "--photons", "10"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("note: --photons has no effect: integrator \"path\" emits none\n"), outcome.err.npos)
      << outcome.err;
}

// dsppm's "indirect" is a text, and path's a switch.
TEST(CommandLine, ParametersThatAnotherIntegratorTakesOtherwiseAreANote) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--integrator", "path"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("\"indirect\" of integrator \"dsppm\" has no effect: \"path\" renders"), outcome.err.npos)
      << outcome.err;
}

TEST(CommandLine, AllErrorsOfASceneComeInOneGo) {
  const TinyDirectory directory;
  std::string scene = tiny_scene("\"float fov\"", "\"float fow\"");
  scene.replace(scene.find("reflectance"), 11, "reflectence");
  scene.replace(scene.find("\"integer photons\""), 17, "\"integer fotons\"");
  put_file(directory / "wrong.dsc", scene);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"wrong.dsc"}, {"wrong.dsc", "--check"}}) {
    const Outcome outcome = run(directory, words);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.out, "");
    for (const char* text :
         {"wrong.dsc:3:", "wrong.dsc:5:", "wrong.dsc:13:", "\"photons\"", "\"fov\"", "\"reflectance\""})
      EXPECT_NE(outcome.err.find(text), std::string::npos) << text << " in\n" << outcome.err;
    EXPECT_FALSE(directory.has("tiny.0001.exr"));
  }
}

TEST(CommandLine, CheckRendersNothing) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--check"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("scene ok: 3 frames, 12 x 8 pixels"), std::string::npos) << outcome.err;
  EXPECT_FALSE(directory.has("tiny.0001.exr"));
  EXPECT_EQ(run(directory, {"none.dsc", "--check"}).code, 1);
}

TEST(CommandLine, StandardInputIsAScene) {
  const TinyDirectory directory;
  put_file(directory / "input", kTinyScene);
  EXPECT_EQ(run(directory, {"-", "--frames", "1"}).code, 0);
  EXPECT_TRUE(directory.has("tiny.0001.exr"));
}

TEST(CommandLine, DefinesReplaceText) {
  const TinyDirectory directory;
  put_file(directory / "wide.dsc", tiny_scene("\"integer xresolution\" 12", "\"integer xresolution\" $width"));
  EXPECT_EQ(run(directory, {"wide.dsc", "--frames", "1", "-D", "width=20"}).code, 0);
  EXPECT_EQ(read_image(directory / "tiny.0001.exr").width, 20);
  EXPECT_EQ(run(directory, {"wide.dsc"}).code, 1);
}

TEST(CommandLine, FormattedTextIsASceneAgain) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--format"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  put_file(directory / "again.dsc", outcome.out);
  EXPECT_EQ(run(directory, {"again.dsc", "--format"}).out, outcome.out);
  EXPECT_EQ(run(directory, {"again.dsc", "--check"}).code, 0);
}

TEST(CommandLine, EveryPluginIsListedAndDescribed) {
  const TinyDirectory directory;
  const Outcome list = run(directory, {"--list"});
  EXPECT_EQ(list.code, 0) << list.err;
  for (const char* name :
       {"dsppm", "dielectric", "plymesh", "imagemap", "spot", "perspective", "gaussian", "two-level"})
    EXPECT_NE(list.out.find(name), std::string::npos) << name;
  const Outcome one = run(directory, {"--describe", "integrator:dsppm"});
  EXPECT_EQ(one.code, 0);
  EXPECT_NE(one.out.find("photons"), std::string::npos) << one.out;
  const Outcome both = run(directory, {"--describe", "diffuse"});
  EXPECT_EQ(both.code, 0);
  for (const char* name : {"material:diffuse (", "area light:diffuse ("})
    EXPECT_NE(both.out.find(name), std::string::npos) << both.out;
  for (const char* kind : {"", "material:"}) {
    const Outcome guess = run(directory, {"--describe", kind + std::string("dielectic")});
    EXPECT_NE(guess.err.find(kind + std::string("dielectric")), std::string::npos) << guess.err;
  }
}

TEST(CommandLine, APbrtFileIsRenderedByPathAndKeepsItsName) {
  const TinyDirectory directory;
  std::string scene = tiny_scene("Frames 3 \"float fps\" 25\n", "");
  scene.replace(scene.find("Integrator"), scene.find("LookAt") - scene.find("Integrator"),
                "Sampler \"halton\" \"integer pixelsamples\" 3 \"integer seed\" 8\nAccelerator \"bvh\"\n");
  scene.resize(scene.find("  DynamicBegin"));
  put_file(directory / "tiny.pbrt", scene);
  const Outcome outcome = run(directory, {"tiny.pbrt"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const ExrHeader header = read_exr_header(directory / "tiny.exr");
  EXPECT_EQ(header.texts.at("integrator"), "path");
  EXPECT_EQ(header.integers.at("iterations"), 3);
  EXPECT_EQ(header.numbers.at("seed"), 8);
  EXPECT_NE(outcome.err.find("the sampler \"halton\" is dspm's own"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("\"bvh\" has no effect"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace dspm::test
