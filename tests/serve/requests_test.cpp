#include "dspm/looking/serve/requests.h"

#include <gtest/gtest.h>

namespace dspm {
namespace requests_test {

TEST(Requests, WishesAreLines) {
  const auto request = parse_wishes("281474976710655\n0 radiance 2 5 7\n63 N 0 0 18446744073709551615\n");
  ASSERT_TRUE(request);
  EXPECT_EQ(request->viewer, 281474976710655u);
  ASSERT_EQ(request->seen.size(), 2u);
  EXPECT_EQ(request->seen[0].wish, (Wish{0, "radiance", 2}));
  EXPECT_EQ(request->seen[0].version, 5u);
  EXPECT_EQ(request->seen[0].other, 7u);
  EXPECT_EQ(request->seen[1].wish, (Wish{63, "N", 0}));
  EXPECT_TRUE(parse_wishes("1\n"));
}

TEST(Requests, AnythingElseIsRefused) {
  for (const std::string& text :
       {std::string(), std::string("\n"), std::string("x\n"), std::string("1\n0 radiance 2 5"),
        std::string("1\n0 radiance 2 5 7 9\n"), std::string("1\n-1 radiance 2 5 7\n"), std::string("1\n0  2 5 7\n"),
        std::string("1\n0 radiance 17 5 7\n"), std::string("1\n0 radiance 2 -5 7\n"),
        std::string("1\n99999999999 a 2 5 7\n"), std::string("1\n\n"), "1\n0 " + std::string(65, 'x') + " 2 5 7\n"})
    EXPECT_FALSE(parse_wishes(text)) << text;
  std::string many = "1\n";
  for (std::size_t i = 0; i < kMostWishes; ++i) many += "1 radiance 0 0 0\n";
  EXPECT_TRUE(parse_wishes(many));
  EXPECT_FALSE(parse_wishes(many + "1 radiance 0 0 0\n"));
}

TEST(Requests, ACameraIsNineNumbers) {
  const auto place = parse_look_at("1 0.5 -4 0 0 0 0 1e0 0");
  ASSERT_TRUE(place);
  EXPECT_EQ((*place)[2], -4);
  for (const char* text : {"", "1 2 3", "1 0.5 -4 0 0 0 0 1 0 0", "1 0.5 -4 0 0 0 0 1 x", "nan 0 0 0 0 1 0 1 0",
                           "inf 0 0 0 0 1 0 1 0", "1e300 0 0 0 0 1 0 1 0", "0 0 0 0 0 0 0 1 0", "0 0 0 0 1 0 0 1 0"})
    EXPECT_FALSE(parse_look_at(text)) << text;
}

TEST(Requests, CountsHaveBounds) {
  EXPECT_EQ(parse_count("64", 1, 100), 64);
  for (const char* text : {"", "0", "101", " 1", "1 ", "1.5", "0x1", "99999999999"})
    EXPECT_FALSE(parse_count(text, 1, 100));
}

}  // namespace requests_test
}  // namespace dspm
