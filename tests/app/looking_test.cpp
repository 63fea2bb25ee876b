// Views, sizes, sheets and comparisons as a user asks for them.
#include <gtest/gtest.h>

#include "dspm/image/image.h"
#include "tests/output/json_check.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

TEST(Looking, TheViewDoesNotTouchTheExr) {
  const TinyDirectory directory;
  ASSERT_EQ(run(directory, {"tiny.dsc", "--png", "--quiet"}).code, 0);
  const Image radiance = read_image(directory / "tiny.0002.exr");
  const std::string png = contents(directory / "tiny.0002.png");
  const Outcome outcome = run(directory, {"tiny.dsc", "--png", "--view", "filmic", "--exposure", "2", "--png-bits",
                                          "16", "--png-space", "display-p3", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_image(directory / "tiny.0002.exr"), radiance);
  EXPECT_NE(contents(directory / "tiny.0002.png"), png);
}

TEST(Looking, TheResolutionAndAQuickLook) {
  const TinyDirectory directory;
  ASSERT_EQ(run(directory, {"tiny.dsc", "--resolution", "50%", "--quiet"}).code, 0);
  EXPECT_EQ(read_image(directory / "tiny.0001.exr").width, 6);
  ASSERT_EQ(run(directory, {"tiny.dsc", "--resolution", "30x8", "--quiet"}).code, 0);
  EXPECT_EQ(read_image(directory / "tiny.0001.exr").width, 30);
  ASSERT_EQ(run(directory, {"tiny.dsc", "--contact-sheet", "whole.png", "--quiet"}).code, 0);
  const Outcome quick = run(directory, {"tiny.dsc", "--contact-sheet", "quick.png", "--quick"});
  ASSERT_EQ(quick.code, 0) << quick.err;
  EXPECT_EQ(read_image(directory / "quick.png").width, read_image(directory / "whole.png").width);
}

TEST(Looking, ImagesThatExist) {
  const TinyDirectory directory;
  ASSERT_EQ(run(directory, {"tiny.dsc", "--quiet"}).code, 0);
  const Outcome compared = run(directory, {"--compare", "tiny.0001.exr", "tiny.0002.exr"});
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_NE(compared.out.find("FLIP"), std::string::npos) << compared.out;
  EXPECT_TRUE(directory.has("tiny.0002-against-tiny.0001.png"));
  const Outcome flicker = run(directory, {"--flicker", "tiny.####.exr", "-o", "where.png"});
  EXPECT_EQ(flicker.code, 0) << flicker.err;
  EXPECT_NE(flicker.out.find("3 frames"), std::string::npos) << flicker.out;
  EXPECT_TRUE(directory.has("where.png"));
  const Outcome sheet = run(directory, {"--sheet", "page.webp", "--labels", "tiny.####.exr", "tiny.0001.exr"});
  EXPECT_EQ(sheet.code, 0) << sheet.err;
  EXPECT_NE(sheet.err.find("4 images: page.webp"), std::string::npos) << sheet.err;
  EXPECT_EQ(run(directory, {"tiny.0001.exr"}).code, 2) << "what is to be made of it?";
  EXPECT_EQ(run(directory, {"--compare", "tiny.0001.exr"}).code, 2);
  EXPECT_EQ(run(directory, {"--compare", "tiny.0001.exr", "none.exr"}).code, 1);
  EXPECT_EQ(run(directory, {"--sheet", "tiny.0001.exr", "tiny.0001.exr"}).code, 2);
}

TEST(Looking, ProgressForPrograms) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--progress", "json", "--quiet"});
  ASSERT_EQ(outcome.code, 0);
  std::istringstream text(outcome.err);
  int iterations = 0;
  for (std::string line; std::getline(text, line);) {
    EXPECT_TRUE(JsonCheck::valid(line)) << line;
    iterations += line.find("\"iteration\"") != line.npos ? 1 : 0;
  }
  EXPECT_EQ(iterations, 2);
}

TEST(Looking, WithoutATerminalThePreviewIsASentence) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--preview", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("--preview shows nothing: this terminal knows neither"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace dspm::test
