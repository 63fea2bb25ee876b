#include "dspm/output/whole_mp4.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_directory.h"

namespace dspm {
namespace whole_mp4_test {

using namespace std::string_literals;

bool is_whole(const std::string& bytes) {
  const test::TemporaryDirectory directory;
  test::put_file(directory / "a.mp4", bytes);
  return is_whole_mp4(directory / "a.mp4");
}

const std::string kType = "\0\0\0\x0c"s + "ftypisom", kIndex = "\0\0\0\x08"s + "moov", kData = "\0\0\0\x0a"s + "mdat..",
                  kLongData = "\0\0\0\x01"s + "mdat" + "\0\0\0\0\0\0\0\x12"s + "..";

TEST(WholeMp4, IsARowOfBoxes) {
  EXPECT_TRUE(is_whole(kType + kIndex + kData));
  EXPECT_TRUE(is_whole(kType + "\0\0\0\x08"s + "free" + kLongData + kIndex));
}

TEST(WholeMp4, NeedsIndexAndData) {
  EXPECT_FALSE(is_whole(""));
  EXPECT_FALSE(is_whole(kType + kData));
  EXPECT_FALSE(is_whole(kType + kIndex));
  EXPECT_FALSE(is_whole(kIndex + kData));
}

TEST(WholeMp4, EndsWhereItsBoxesEnd) {
  const std::string whole = kType + kIndex + kLongData;
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) EXPECT_FALSE(is_whole(whole.substr(0, bytes))) << bytes;
  EXPECT_FALSE(is_whole(whole + "\0"s));
  EXPECT_FALSE(is_whole(kType + kIndex + "\0\0\0\0"s + "mdat.."));  // up to the end: never finished
  EXPECT_FALSE(is_whole("garbage that is long enough for a box or two"));
  EXPECT_FALSE(is_whole_mp4("/no/such/file.mp4"));
}

}  // namespace whole_mp4_test
}  // namespace dspm
