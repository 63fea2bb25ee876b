// The page's server and everything that may be asked of it.
#include "dspm/serve/server.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "tests/serve/http_client.h"

namespace dspm::test {
namespace {

struct Served : testing::Test {
  Gallery gallery;
  Board board;
  Orders orders;
  Server server{{"127.0.0.1", 0}, gallery, board, orders};
  int port = port_in(server.url());

  int status(const std::string& method, const std::string& path, const std::string& headers = "",
             const std::string& body = "") const {
    return status_of(ask(port, method, path, headers, body));
  }
  void put(int frame, int iterations = 1) {
    Picture picture;
    picture.wish = {frame, kRadiance, 0}, picture.iterations = iterations, picture.pixels = "the pixels";
    std::vector<Picture> pictures;
    pictures.push_back(std::move(picture));
    gallery.put(std::move(pictures));
  }
  void wait_for_wishes(std::size_t count) const {
    for (int i = 0; i < 5000 && gallery.wanted().size() != count; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(gallery.wanted().size(), count);
  }
};

TEST_F(Served, AllFilesThatThePageNames) {
  const std::string page = ask(port, "GET", "/");
  EXPECT_EQ(status_of(page), 200);
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_NE(page.find("<script type=\"module\" src=\"live.js\">"), std::string::npos);
  for (const char* file : {"/live.css", "/live.js", "/pictures.js", "/tone.js", "/painter_gl.js", "/painter_2d.js"})
    EXPECT_EQ(status("GET", file), 200) << file;
  EXPECT_EQ(status("GET", "/index.htm"), 404);
  EXPECT_EQ(status("GET", "/../../etc/passwd"), 404);
  EXPECT_EQ(status("GET", "/%2e%2e/%2e%2e/etc/passwd"), 404);
}

TEST_F(Served, OtherPagesAndOtherNamesAreRefused) {
  EXPECT_EQ(status("POST", "/stop", "Origin: http://evil.example\r\n"), 403);
  EXPECT_EQ(status("POST", "/stop", "Sec-Fetch-Site: cross-site\r\n"), 403);
  EXPECT_EQ(status("POST", "/stop", "Host: evil.example\r\n"), 403);
  EXPECT_EQ(status("GET", "/run", "Host: evil.example\r\n"), 403);
  EXPECT_EQ(status("GET", "/stop"), 404) << "a link must not stop a render";
  EXPECT_EQ(status("OPTIONS", "/stop", "Origin: http://evil.example\r\n"), 403);
  EXPECT_FALSE(orders.is_stopping());
  EXPECT_EQ(status("POST", "/stop", fmt::format("Origin: http://127.0.0.1:{}\r\n", port)), 204);
  EXPECT_TRUE(orders.is_stopping());
}

TEST_F(Served, OrdersArrive) {
  EXPECT_EQ(status("POST", "/pause"), 204);
  EXPECT_TRUE(orders.is_paused());
  EXPECT_EQ(status("POST", "/resume"), 204);
  EXPECT_FALSE(orders.is_paused());
  EXPECT_EQ(status("POST", "/write"), 204);
  EXPECT_TRUE(orders.take_write());
  EXPECT_FALSE(orders.take_write());
  EXPECT_EQ(status("POST", "/more", "", "32"), 204);
  EXPECT_EQ(orders.take_iterations(), 32);
  for (const char* count : {"", "0", "-5", "x", "1e3", "99999999999999"})
    EXPECT_EQ(status("POST", "/more", "", count), 400);
  EXPECT_EQ(orders.take_iterations(), 0);
}

TEST_F(Served, TheStateAndTheLogAreEvents) {
  board.add_line("first \"line\"\n");
  board.set_state("{\"iterations\": 1}");
  Connection viewer(port);
  viewer.send(request_text(port, "GET", "/events"));
  const std::string text = viewer.read_until("first");
  EXPECT_NE(text.find("text/event-stream"), std::string::npos);
  EXPECT_NE(text.find("event: state\ndata: {\"iterations\": 1}\n\n"), std::string::npos) << text;
  board.add_line("second");
  EXPECT_NE(viewer.read_until("second").find("id: 2\ndata: \"second\"\n\n"), std::string::npos);
  Connection reconnected(port);
  reconnected.send(request_text(port, "GET", "/events", "Last-Event-ID: 1\r\n"));
  EXPECT_EQ(reconnected.read_until("second").find("first"), std::string::npos) << "it has that line already";
}

TEST_F(Served, PicturesComeWhenTheyChange) {
  gallery.begin_run(4);
  Connection viewer(port);
  viewer.send(request_text(port, "POST", "/pictures", "", "1\n2 radiance 0 0 0\n"));
  wait_for_wishes(1);
  put(2, 9);
  const std::string answer = viewer.read_all();
  EXPECT_NE(answer.find("2 radiance 0 1 0 0 3 2 9 0 1 10\nthe pixels"), std::string::npos) << answer;
  wait_for_wishes(0);
}

TEST_F(Served, TwoViewersSeeWhatEachLooksAt) {
  gallery.begin_run(4);
  Connection one(port), two(port);
  one.send(request_text(port, "POST", "/pictures", "", "1\n0 radiance 0 0 0\n"));
  two.send(request_text(port, "POST", "/pictures", "", "2\n3 radiance 0 0 0\n"));
  wait_for_wishes(2);
  put(3);
  EXPECT_NE(two.read_all().find("3 radiance"), std::string::npos);
  wait_for_wishes(1);
  put(0);
  EXPECT_NE(one.read_all().find("0 radiance"), std::string::npos);
}

TEST_F(Served, BadRequestsHarmNothing) {
  std::mt19937 random(3);
  const std::string good = request_text(port, "POST", "/pictures", "", "1\nx\n");
  for (int i = 0; i < 60; ++i) {
    std::string text = good;
    for (int k = 0; k < 4; ++k) text[random() % text.size()] = static_cast<char>(random());
    const Connection connection(port);
    connection.send(text);
  }
  EXPECT_EQ(status("POST", "/pictures", "", "1\nx\n"), 400);
  EXPECT_EQ(status("POST", "/pictures", "", std::string(1 << 20, '1')), 413);
  EXPECT_GE(status("GET", "/" + std::string(1 << 16, 'a')), 400);
  EXPECT_NE(status("GET", "/run", "Range: bytes=0-18446744073709551615\r\n"), 0);
  EXPECT_EQ(status("GET", "/run"), 200);
}

TEST_F(Served, SlowAndVanishingClientsHoldUpNobody) {
  std::vector<std::unique_ptr<Connection>> slow;
  for (int i = 0; i < 8; ++i) {
    slow.push_back(std::make_unique<Connection>(port));
    slow.back()->send("GET /run HT");  // and no more
    const Connection gone(port);
    gone.send(request_text(port, "GET", "/events"));
    const Connection also_gone(port);
    also_gone.send(request_text(port, "POST", "/pictures", "", fmt::format("{}\n0 radiance 0 0 0\n", 100 + i)));
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(status("GET", "/run"), 200);
  gallery.begin_run(4);
  put(0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST_F(Served, TooManyPagesAreRefused) {
  std::vector<std::unique_ptr<Connection>> pages;
  for (int i = 0; i < 16; ++i) {
    pages.push_back(std::make_unique<Connection>(port));
    pages.back()->send(request_text(port, "GET", "/events"));
    pages.back()->read_until("event:");
  }
  EXPECT_EQ(status("GET", "/events"), 503);
  EXPECT_EQ(status("GET", "/run"), 200);
  pages.clear();
  int last = 0;
  for (int i = 0; i < 100 && last != 200; ++i) {  // places are free once the server has seen that they are gone
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    Connection next(port);
    next.send(request_text(port, "GET", "/events"));
    last = status_of(next.read_until("\r\n\r\n"));
  }
  EXPECT_EQ(last, 200);
}

TEST(Server, APortThatIsTakenIsAnError) {
  Gallery gallery;
  Board board;
  Orders orders;
  const Server first({"127.0.0.1", 0}, gallery, board, orders);
  EXPECT_THROW(Server({"127.0.0.1", port_in(first.url())}, gallery, board, orders), std::runtime_error);
}

TEST(Server, OtherAddressesNeedTheToken) {
  Gallery gallery;
  Board board;
  Orders orders;
  const Server server({"0.0.0.0", 0}, gallery, board, orders);
  const std::string url = server.url();
  const int port = port_in(url);
  const std::string path = url.substr(url.find('/', 8));
  EXPECT_EQ(status_of(ask(port, "GET", "/")), 403);
  EXPECT_EQ(status_of(ask(port, "POST", "/stop")), 403);
  EXPECT_EQ(status_of(ask(port, "GET", path)), 200);
  EXPECT_EQ(status_of(ask(port, "GET", path + "live.js")), 200);
}

TEST(Server, EndsWhileViewersWait) {
  const auto begin = std::chrono::steady_clock::now();
  Gallery gallery;
  Board board;
  Orders orders;
  auto server = std::make_unique<Server>(ServeAddress{"127.0.0.1", 0}, gallery, board, orders);
  Connection events(port_in(server->url())), pictures(port_in(server->url()));
  events.send(request_text(port_in(server->url()), "GET", "/events"));
  events.read_until("event:");
  pictures.send(request_text(port_in(server->url()), "POST", "/pictures", "", "1\n0 radiance 0 0 0\n"));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

}  // namespace
}  // namespace dspm::test
