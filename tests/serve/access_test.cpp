// Who may use the page.
#include "dspm/looking/serve/access.h"

#include <gtest/gtest.h>

namespace dspm {
namespace access_test {

TEST(ServeAddress, ParsesPortsAndAddresses) {
  const auto expect = [](const char* text, const char* host, int port) {
    const auto address = parse_serve_address(text);
    ASSERT_TRUE(address) << text;
    EXPECT_EQ(address->host, host) << text;
    EXPECT_EQ(address->port, port) << text;
  };
  expect("8080", "127.0.0.1", 8080);
  expect("0", "127.0.0.1", 0);
  expect("0.0.0.0:81", "0.0.0.0", 81);
  expect("192.168.1.5", "192.168.1.5", 8780);
  expect("localhost:8080", "localhost", 8080);
  expect("[::1]:8080", "::1", 8080);
  expect("[::]", "::", 8780);
}

TEST(ServeAddress, RefusesAnythingElse) {
  for (const char* text : {"", ":", "-1", "65536", "8080x", "scene.dsc", "1.2.3", "1.2.3.4:", "1.2.3.4:x", "[::1",
                           "[::1]x", "::1", "1.2.3.4.5:80", "99999999999999999999", "[]", "[::1]:70000"})
    EXPECT_FALSE(parse_serve_address(text)) << text;
}

TEST(Access, ALocalPageIsForItsOwnNamesOnly) {
  const Access access({"127.0.0.1", 0}, 8780);
  EXPECT_EQ(access.url(), "http://127.0.0.1:8780" + access.prefix());
  const std::string run = access.prefix() + "run";
  for (const char* host : {"127.0.0.1:8780", "localhost:8780", "LOCALHOST:8780", "[::1]:8780"})
    EXPECT_EQ(access.refusal({host, "", "", run}), "") << host;
  // The third is what a browser sends if a foreign page's server points its own name to this machine.
  for (const char* host : {"", "127.0.0.1", "evil.example:8780", "127.0.0.1:8781", "127.0.0.1:8780.evil.example"})
    EXPECT_NE(access.refusal({host, "", "", run}), "") << host;
}

TEST(Access, OtherPagesAreRefused) {
  const Access access({"127.0.0.1", 0}, 8780);
  const auto refused = [&](const char* origin, const char* site) {
    const std::string stop = access.prefix() + "stop";
    return !access.refusal({"127.0.0.1:8780", origin, site, stop}).empty();
  };
  EXPECT_FALSE(refused("http://127.0.0.1:8780", "same-origin"));
  EXPECT_FALSE(refused("", "none"));
  EXPECT_TRUE(refused("http://evil.example", ""));
  EXPECT_TRUE(refused("null", ""));
  EXPECT_TRUE(refused("http://127.0.0.1:8781", ""));
  EXPECT_TRUE(refused("https://127.0.0.1:8780", ""));
  EXPECT_TRUE(refused("", "cross-site"));
  EXPECT_TRUE(refused("", "same-site"));
}

TEST(Access, NobodyIsLetInWithoutTheToken) {
  for (const char* address : {"0.0.0.0", "127.0.0.1"}) {
    const Access access({address, 0}, 8780), other({address, 0}, 8780);
    EXPECT_EQ(access.prefix().size(), 34u);
    EXPECT_NE(access.prefix(), other.prefix());
    const bool is_local = std::string(address) == "127.0.0.1";
    const RequestSource good{is_local ? "127.0.0.1:8780" : "render-1:8780",
                             is_local ? "http://127.0.0.1:8780" : "http://render-1:8780", "", access.prefix()};
    EXPECT_EQ(access.refusal(good), "");
    for (const std::string& path : {std::string("/"), std::string("/run"), other.prefix() + "run",
                                    access.prefix().substr(0, 32), access.prefix().substr(1)}) {
      RequestSource bad = good;
      bad.path = path;
      EXPECT_NE(access.refusal(bad), "") << path;
    }
  }
}

}  // namespace access_test
}  // namespace dspm
