// A stamp is told from one that is not this dspm's.
#include "dspm/session/modules/stamp.h"

#include <gtest/gtest.h>

#include <cstring>

namespace dspm {
namespace stamp_test {

std::string bytes_of(const ModuleStamp& stamp) { return {reinterpret_cast<const char*>(&stamp), sizeof(stamp)}; }
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Stamp, IsAnElfNote) {
  const ModuleStamp stamp = current_stamp();
  EXPECT_EQ(stamp.name_bytes, std::strlen(stamp.name) + 1);
  EXPECT_EQ(12 + sizeof(stamp.name) + stamp.content_bytes, sizeof(stamp));
}

TEST(Stamp, ItsOwnFits) { EXPECT_EQ(why_unfit(bytes_of(current_stamp())), ""); }

TEST(Stamp, APatchFits) {
  ModuleStamp stamp = current_stamp();
  ++stamp.version[2];
  EXPECT_EQ(why_unfit(bytes_of(stamp)), "");
}

TEST(Stamp, OtherVersionsDoNot) {
  for (const int part : {0, 1}) {
    ModuleStamp stamp = current_stamp();
    stamp.version[part] += 3;
    const std::string why = why_unfit(bytes_of(stamp));
    EXPECT_TRUE(contains(why, part == 0 ? "dspm 3.3.0" : "dspm 0.6.0") && contains(why, "this is dspm 0.3.0")) << why;
    EXPECT_TRUE(contains(why, "rebuild it")) << why;
  }
}

TEST(Stamp, OtherHeadersDoNot) {
  ModuleStamp stamp = current_stamp();
  ++stamp.interface;
  const std::string why = why_unfit(bytes_of(stamp));
  EXPECT_TRUE(contains(why, "headers") && contains(why, "rebuild it")) << why;
}

TEST(Stamp, OtherStringsOrCompilersDoNot) {
  ModuleStamp stamp = current_stamp();
  stamp.new_strings = 0;
  EXPECT_TRUE(contains(why_unfit(bytes_of(stamp)), "another C++ ABI")) << why_unfit(bytes_of(stamp));
  stamp = current_stamp();
  ++stamp.cxx_abi;
  EXPECT_TRUE(contains(why_unfit(bytes_of(stamp)), "another C++ ABI")) << why_unfit(bytes_of(stamp));
}

TEST(Stamp, EveryTypeCounts) {
  for (std::size_t i = 0; i < std::size(kStampedTypes); ++i) {
    ModuleStamp stamp = current_stamp();
    ++stamp.sizes[i];
    EXPECT_TRUE(contains(why_unfit(bytes_of(stamp)), std::string(kStampedTypes[i].name))) << i;
  }
}

TEST(Stamp, PartsOfOneDoNotFit) {
  const std::string whole = bytes_of(current_stamp());
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_NE(why_unfit(whole.substr(0, size)), "") << size;
}

}  // namespace stamp_test
}  // namespace dspm
