#include "dspm/base/system/json.h"

#include <gtest/gtest.h>

#include <limits>

namespace dspm {
namespace json_test {

TEST(Json, WritesNestedValues) {
  JsonWriter json;
  json.begin_object();
  json.member("count", std::uint64_t{18446744073709551615u});
  json.member("seconds", 0.5);
  json.key("frames").begin_array();
  json.value(1);
  json.value(2);
  json.end_array();
  json.key("nothing").begin_array();
  json.end_array();
  json.key("inner").begin_object();
  json.member("name", "x");
  json.end_object();
  json.end_object();
  EXPECT_EQ(json.text(), R"({
  "count": 18446744073709551615,
  "seconds": 0.5,
  "frames": [
    1,
    2
  ],
  "nothing": [],
  "inner": {
    "name": "x"
  }
})");
}

TEST(Json, EscapesTextAndHasNoWordForInfinity) {
  JsonWriter text, number;
  text.value("a\"b\\c\nd\x01 \xc3\xa4");
  EXPECT_EQ(text.text(), "\"a\\\"b\\\\c\\u000ad\\u0001 \xc3\xa4\"");
  JsonWriter bytes;
  bytes.value("\xff\xc3(\xe2\x82\xac\xed\xa0\x80\xc0\xaf\xf4\x90\x80\x80\xc3");
  std::string replaced = "\"\\ufffd\\ufffd(\xe2\x82\xac";
  for (int i = 0; i < 10; ++i) replaced += "\\ufffd";
  EXPECT_EQ(bytes.text(), replaced + "\"");
  number.value(std::numeric_limits<double>::infinity());
  EXPECT_EQ(number.text(), "null");
}

}  // namespace json_test
}  // namespace dspm
