// Texts as programs write them.
#include "dspm/base/system/plain_text.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dspm {
namespace {

using namespace std::string_literals;

TEST(PlainText, LinesEndAlikeAndAMarkIsGone) {
  for (const char* text : {"a\nb\n\nc", "a\r\nb\r\n\r\nc", "a\rb\r\rc",
                           "\xEF\xBB\xBF"
                           "a\r\nb\n\rc"})
    EXPECT_EQ(plain_text(text), "a\nb\n\nc");
  EXPECT_EQ(plain_text(""), "");
  EXPECT_EQ(plain_text("\r"), "\n");
  EXPECT_EQ(plain_text("\xC3\xA4\xEF\xBB\xBF"), "\xC3\xA4\xEF\xBB\xBF") << "within the text it is no mark";
}

TEST(PlainText, SaysWhatIsNoPlainText) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      plain_text(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  };
  for (const std::string& text : {"\xFF\xFE"
                                  "v\0 \0"s,
                                  "\xFE\xFF\0v"s, "v\0 \0001\0"s, "\0v\0 "s})
    EXPECT_EQ(message(text), "it is text in UTF-16: save it as UTF-8");
  EXPECT_EQ(message("\xFF\xFE\0\0v\0\0\0"s), "it is text in UTF-32: save it as UTF-8");
  EXPECT_EQ(message("a\0\0b"s), "none");
}

}  // namespace
}  // namespace dspm
