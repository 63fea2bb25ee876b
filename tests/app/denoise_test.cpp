// --denoise: two images of each frame, by dspm's own filter and by a script in place of oidnDenoise.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "tests/support/fake_program.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

using Names = std::vector<std::string>;

const Names kDenoisedImages = {"tiny.denoised.0001.exr", "tiny.denoised.0002.exr", "tiny.denoised.0003.exr"};

Outcome render(const TemporaryDirectory& directory, const Names& more) {
  return run(directory, Names{"tiny.dsc", "--iterations", "6", "--float"} + more);
}

/// Keeps its arguments, and leaves the colours that it is given.
const std::string kCopy = R"(
printf '%s\n' "$@" >"$here/arguments"
colour=; out=
while [ $# -gt 0 ]; do
  [ "$1" = --hdr ] && colour=$2
  [ "$1" = -o ] && out=$2
  shift
done
cp "$colour" "$out"
)";

TEST(Denoise, WritesBothImages) {
  const TinyDirectory without, with;
  ASSERT_EQ(render(without, {"--contact-sheet", "sheet.png"}).code, 0);
  const Outcome outcome = render(with, {"--denoise", "--png", "--contact-sheet", "sheet.png", "--index", "all.csv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (std::size_t f = 0; f < kDenoisedImages.size(); ++f) {
    const Image plain = read_image(with / kTinyImages[f]);
    EXPECT_EQ(plain, read_image(without / kTinyImages[f]));
    EXPECT_NE(plain, read_image(with / kDenoisedImages[f]));
    const ExrHeader header = read_exr_header(with / kDenoisedImages[f]);
    EXPECT_EQ(header.channels, (Names{"B", "G", "R"}));
    EXPECT_EQ(header.texts.at("denoised"), "joint filter");
    EXPECT_EQ(header.integers.at("iterations"), 6);
    EXPECT_EQ(read_exr_header(with / kTinyImages[f]).channels, (Names{"B", "G", "R"}));
  }
  EXPECT_TRUE(with.has("tiny.0003.png"));
  EXPECT_TRUE(with.has("tiny.denoised.0003.png"));
  EXPECT_NE(contents(with / "all.csv").find("tiny.denoised.0002.exr"), std::string::npos);
  EXPECT_NE(read_image(with / "sheet.png"), read_image(without / "sheet.png"));
}

TEST(Denoise, AfterOneIterationNothingIsKnownOfNoise) {
  const TinyDirectory directory;
  ASSERT_EQ(run(directory, {"tiny.dsc", "--iterations", "1", "--denoise"}).code, 0);
  EXPECT_EQ(read_image(directory / kTinyImages[0]), read_image(directory / kDenoisedImages[0]));
}

TEST(Denoise, AFrameIsFilteredByItself) {
  const TinyDirectory together, alone;
  ASSERT_EQ(render(together, {"--denoise"}).code, 0);
  ASSERT_EQ(render(alone, {"--denoise", "--frames", "2"}).code, 0);
  const Image a = read_image(together / kDenoisedImages[1]), b = read_image(alone / kDenoisedImages[1]);
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.pixels[i][c], b.pixels[i][c], 1e-3f * std::abs(b.pixels[i][c]) + 1e-5f);
}

TEST(Denoise, GoesOnToTheSameBits) {
  const TinyDirectory at_once, in_two;
  ASSERT_EQ(render(at_once, {"--denoise", "--nthreads", "3"}).code, 0);
  const Names start = {"tiny.dsc", "--float", "--denoise", "--checkpoint", "a.ck", "--iterations", "3"};
  ASSERT_EQ(run(in_two, start + Names{"--nthreads", "1"}).code, 0);
  const Outcome outcome = render(in_two, {"--denoise", "--resume", "a.ck"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string& image : kDenoisedImages) EXPECT_EQ(read_image(at_once / image), read_image(in_two / image));
}

TEST(Denoise, TheNameOfATemplateStays) {
  const TinyDirectory directory;
  ASSERT_EQ(run(directory, {"tiny.dsc", "--denoise", "-o", "look_{frame}.exr"}).code, 0);
  EXPECT_TRUE(directory.has("look_0001.exr"));
  EXPECT_TRUE(directory.has("look_0001.denoised.exr"));
}

TEST(Denoise, AnotherWordIsAnError) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--denoise=optix"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--denoise=optix: it is oidn"), std::string::npos) << outcome.err;
}

TEST(DenoiseByOidn, GivesItLayersAndTakesItsImage) {
  const TinyDirectory directory;
  const FakeProgram oidn("oidnDenoise", kCopy);
  const Outcome outcome = render(directory, {"--denoise", "oidn"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_image(directory / kTinyImages[2]), read_image(directory / kDenoisedImages[2]));
  EXPECT_EQ(read_exr_header(directory / kDenoisedImages[2]).texts.at("denoised"), "oidn");
  const std::string arguments = oidn.arguments();
  for (const char* option : {"--hdr\n", "--alb\n", "--nrm\n", "-o\n"})
    EXPECT_NE(arguments.find(option), std::string::npos) << arguments;
  EXPECT_EQ(directory.file_count(), 1 + 2 * 3 + 2);  // the scene, two images a frame, and what the test itself keeps
}

TEST(DenoiseByOidn, IsMissedBeforeRendering) {
  const TinyDirectory directory;
  const FakeProgram none("oidnDenoise", "");
  const Outcome outcome = render(directory, {"--denoise", "oidn"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("oidnDenoise is missing"), std::string::npos) << outcome.err;
  EXPECT_FALSE(directory.has(kTinyImages[0]));
}

TEST(DenoiseByOidn, LeavesThePlainImagesWhereItFails) {
  const TinyDirectory directory;
  const std::string fail_late = R"([ -e "$here/once" ] && { echo 'no memory' >&2; exit 3; }
touch "$here/once"
)";
  const FakeProgram oidn("oidnDenoise", fail_late + kCopy);
  const Outcome outcome = render(directory, {"--denoise", "oidn"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("exit code 3, saying: no memory"), std::string::npos) << outcome.err;
  EXPECT_TRUE(directory.has(kTinyImages[2]));
  EXPECT_FALSE(directory.has(kDenoisedImages[2]));
}

}  // namespace
}  // namespace dspm::test
