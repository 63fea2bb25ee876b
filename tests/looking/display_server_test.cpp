#include "dspm/looking/display_server.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "dspm/base/colour/rgb.h"
#include "tests/looking/tev_server.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace display_server_test {

using std::chrono::steady_clock;

/// Waits for it, ten seconds at most.
template <class Condition>
bool comes(const Condition& condition) {
  const auto end = steady_clock::now() + std::chrono::seconds(10);
  bool came = condition();
  for (; !came && steady_clock::now() < end; came = condition())
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return came;
}

Image ramp(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = Rgb(static_cast<float>(x), static_cast<float>(y), -0.5f);
  return image;
}

TEST(DisplayServer, AddressesAreHostAndPort) {
  using Pair = std::pair<std::string, std::string>;
  EXPECT_EQ(host_and_port("box:14158"), Pair("box", "14158"));
  EXPECT_EQ(host_and_port(":14158"), Pair("localhost", "14158"));
  EXPECT_EQ(host_and_port("[::1]:9"), Pair("::1", "9"));
  for (const char* wrong : {"", "box", "box:", "box:x", "box:70000", "box:123456"})
    EXPECT_THROW(host_and_port(wrong), std::runtime_error) << wrong;
}

TEST(DisplayServer, SendsWhatHasChanged) {
  const TevServer server;
  DisplayServer display(server.address());
  ASSERT_TRUE(comes([&] { return display.is_ready(); }));
  Image image = ramp(300, 200);  // 3 x 2 regions
  display.show("a", image, {"R", "G", "B"});
  display.show("a N", ramp(300, 200), {"N.X"});
  ASSERT_TRUE(comes([&] { return server.images()["a N"].updates == 6; })) << server.fault();
  const TevImage shown = server.images().at("a");
  EXPECT_EQ(shown.updates, 6);
  EXPECT_EQ(shown.planes.size(), 3u);
  for (int y = 0; y < 200; y += 13)
    for (int x = 0; x < 300; x += 7) {
      const auto i = static_cast<std::size_t>(y * 300 + x);
      EXPECT_EQ(shown.planes.at("R")[i], static_cast<float>(x));
      EXPECT_EQ(shown.planes.at("G")[i], static_cast<float>(y));
      EXPECT_EQ(shown.planes.at("B")[i], -0.5f);
    }
  EXPECT_EQ(server.images().at("a N").planes.size(), 1u);

  image.at(299, 199) = Rgb(7);
  ASSERT_TRUE(comes([&] { return display.is_ready(); }));
  display.show("a", image, {"R", "G", "B"});
  ASSERT_TRUE(comes([&] { return server.images()["a"].updates == 7; })) << "one region";
  EXPECT_EQ(server.images().at("a").planes.at("G").back(), 7);
  EXPECT_EQ(server.fault(), "");
}

TEST(DisplayServer, OneThatComesBackGetsEverythingAgain) {
  auto server = std::make_unique<TevServer>();
  const int port = server->port();
  DisplayServer display(server->address());
  ASSERT_TRUE(comes([&] { return display.is_ready(); }));
  display.show("a", ramp(10, 10), {"R", "G", "B"});
  ASSERT_TRUE(comes([&] { return server->images()["a"].updates == 1; }));
  server.reset();
  ASSERT_TRUE(comes([&] { return !display.is_ready(); }));
  EXPECT_TRUE(comes([&] { return !display.take_fault().empty(); }));
  display.show("a", ramp(10, 10), {"R", "G", "B"});  // nobody is there
  server = std::make_unique<TevServer>(false, port);
  ASSERT_TRUE(comes([&] { return display.is_ready(); }));
  display.show("a", ramp(10, 10), {"R", "G", "B"});
  EXPECT_TRUE(comes([&] { return server->images()["a"].updates == 1; }));
}

TEST(DisplayServer, ARenderSendsEveryFrameAndOutput) {
  const TinyDirectory directory;
  const TevServer server;
  const Outcome outcome = run(directory, {"tiny.dsc", "--float", "--aov", "Z", "--display-server", server.address()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(server.fault(), "");
  for (const std::string name : {"tiny.0001.exr", "tiny.0002.exr", "tiny.0003.exr"}) {
    ASSERT_TRUE(server.images().contains(name)) << name;
    EXPECT_TRUE(server.images().contains(name + " Z"));
    const TevImage shown = server.images().at(name);
    const Image file = read_image(directory / name);
    ASSERT_EQ(shown.width, file.width);
    for (std::size_t i = 0; i < file.pixels.size(); ++i) EXPECT_EQ(shown.planes.at("G")[i], file.pixels[i].g) << i;
  }
}

/// A server that is not there, and one that reads nothing: the images are the same, and it takes no longer than the grace.
TEST(DisplayServer, HarmsNothing) {
  const TinyDirectory directory;
  run(directory, {"tiny.dsc", "--quiet"});
  const std::string without = contents(directory / "tiny.0002.exr");
  int unused = 0;
  {
    const TevServer gone;
    unused = gone.port();
  }
  const TevServer slow(true);
  for (const std::string& address : {"127.0.0.1:" + std::to_string(unused), slow.address()}) {
    const auto begin = steady_clock::now();
    const Outcome outcome = run(directory, {"tiny.dsc", "--display-server", address});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(30));
    EXPECT_EQ(read_image(directory / "tiny.0002.exr").width, 12);
    EXPECT_EQ(contents(directory / "tiny.0002.exr").size(), without.size());
  }
}

}  // namespace display_server_test
}  // namespace dspm::test
