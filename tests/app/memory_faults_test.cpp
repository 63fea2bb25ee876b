// Memory that ends: whatever the limit on the address space, a run ends in whole images or in an error, never by a
// signal, and leaves no part of a file.
#include <gtest/gtest.h>

#include "dspm/image/image.h"
#include "tests/support/process.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DSPM_ADDRESS_SPACE_OF_ITS_OWN 1  // a sanitizer takes more than any limit of these
#endif

namespace dspm::test {
namespace {

constexpr double kMegabyte = 1e6;

/// Holds the tiny scene with more pixels and photons.
class Directory : public TinyDirectory {
 public:
  Directory() {
    std::string scene = tiny_scene(R"("integer photons" 200)", R"("integer photons" 50000)");
    const std::string size = "12 \"integer yresolution\" 8";
    put_file(*this / "tiny.dsc", scene.replace(scene.find(size), size.size(), "192 \"integer yresolution\" 128"));
  }
  std::vector<Image> images() const {
    std::vector<Image> images;
    for (const char* name : kTinyImages)
      if (has(name)) images.push_back(read_image(*this / name));
    return images;
  }
  void expect_no_parts() const {
    for (const auto& entry : std::filesystem::directory_iterator(*this / ""))
      EXPECT_EQ(entry.path().filename().string().find(".part-"), std::string::npos) << entry.path();
  }
};

class AddressSpace : public ::testing::TestWithParam<const char*> {};

TEST_P(AddressSpace, ALimitIsNoSignal) {
#ifdef DSPM_ADDRESS_SPACE_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const Directory undisturbed;
  ASSERT_EQ(run(undisturbed, {"tiny.dsc"}).code, 0);
  const std::vector<Image> images = undisturbed.images();
  int failed = 0, done = 0;
  for (double bytes = 10 * kMegabyte; done < 6; bytes *= 1.12) {  // more memory than enough changes nothing
    ASSERT_LT(bytes, 4000 * kMegabyte);
    const Directory directory;
    if (run_below(directory, bytes, {"--version"}).code != 0) continue;  // the libraries alone are too much
    const Outcome outcome = run_below(directory, bytes, {"tiny.dsc", "--nthreads", GetParam(), "--write-every", "1"});
    directory.expect_no_parts();
    ++(outcome.code == 0 ? done : failed);
    if (outcome.code == 0) {
      EXPECT_TRUE(directory.images() == images) << bytes;
      continue;
    }
    EXPECT_EQ(outcome.code, 1) << bytes << ": " << outcome.err;
    EXPECT_TRUE(outcome.err.find("memory") != outcome.err.npos || outcome.err.find("thread") != outcome.err.npos)
        << outcome.err;
    for (const Image& image : directory.images()) EXPECT_EQ(image.width, 192);
  }
  EXPECT_GT(failed, 1);
}

INSTANTIATE_TEST_SUITE_P(Threads, AddressSpace, ::testing::Values("1", "2", "16"));

}  // namespace
}  // namespace dspm::test
