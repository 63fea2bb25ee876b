// The page's server and everything that may be asked of it.
#include "dspm/looking/serve/server.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "tests/serve/http_client.h"

namespace dspm::test {
namespace server_test {

struct Served : testing::Test {
  Gallery gallery;
  Board board;
  Orders orders;
  Server server{{"127.0.0.1", 0}, gallery, board, orders};
  Place page = place_in(server.url());

  int status(const std::string& method, const std::string& path, const std::string& headers = "",
             const std::string& body = "") const {
    return status_of(ask(page, method, path, headers, body));
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
  const std::string html = ask(page, "GET", "/");
  EXPECT_EQ(status_of(html), 200);
  EXPECT_NE(html.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_NE(html.find("<script type=\"module\" src=\"live.js\">"), std::string::npos);
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
  EXPECT_EQ(status("POST", "/stop", fmt::format("Origin: http://127.0.0.1:{}\r\n", page.port)), 204);
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
  Connection viewer(page);
  viewer.send(request_text(page, "GET", "/events"));
  const std::string text = viewer.read_until("first");
  EXPECT_NE(text.find("text/event-stream"), std::string::npos);
  EXPECT_NE(text.find("event: state\ndata: {\"iterations\": 1}\n\n"), std::string::npos) << text;
  board.add_line("second");
  EXPECT_NE(viewer.read_until("second").find("id: 2\ndata: \"second\"\n\n"), std::string::npos);
  Connection reconnected(page);
  reconnected.send(request_text(page, "GET", "/events", "Last-Event-ID: 1\r\n"));
  EXPECT_EQ(reconnected.read_until("second").find("first"), std::string::npos) << "it has that line already";
}

TEST_F(Served, PicturesComeWhenTheyChange) {
  gallery.begin_run(4);
  Connection viewer(page);
  viewer.send(request_text(page, "POST", "/pictures", "", "1\n2 radiance 0 0 0\n"));
  wait_for_wishes(1);
  put(2, 9);
  const std::string answer = viewer.read_all();
  EXPECT_NE(answer.find("2 radiance 0 1 0 0 3 2 9 0 1 10\nthe pixels"), std::string::npos) << answer;
  wait_for_wishes(0);
}

TEST_F(Served, TwoViewersSeeWhatEachLooksAt) {
  gallery.begin_run(4);
  Connection one(page), two(page);
  one.send(request_text(page, "POST", "/pictures", "", "1\n0 radiance 0 0 0\n"));
  two.send(request_text(page, "POST", "/pictures", "", "2\n3 radiance 0 0 0\n"));
  wait_for_wishes(2);
  put(3);
  EXPECT_NE(two.read_all().find("3 radiance"), std::string::npos);
  wait_for_wishes(1);
  put(0);
  EXPECT_NE(one.read_all().find("0 radiance"), std::string::npos);
}

TEST_F(Served, BadRequestsHarmNothing) {
  std::mt19937 random(3);
  const std::string good = request_text(page, "POST", "/pictures", "", "1\nx\n");
  for (int i = 0; i < 60; ++i) {
    std::string text = good;
    for (int k = 0; k < 4; ++k) text[random() % text.size()] = static_cast<char>(random());
    const Connection connection(page);
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
    slow.push_back(std::make_unique<Connection>(page));
    slow.back()->send("GET /run HT");  // and no more
    const Connection gone(page);
    gone.send(request_text(page, "GET", "/events"));
    const Connection also_gone(page);
    also_gone.send(request_text(page, "POST", "/pictures", "", fmt::format("{}\n0 radiance 0 0 0\n", 100 + i)));
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
    pages.push_back(std::make_unique<Connection>(page));
    pages.back()->send(request_text(page, "GET", "/events"));
    pages.back()->read_until("event:");
  }
  EXPECT_EQ(status("GET", "/events"), 503);
  EXPECT_EQ(status("GET", "/run"), 200);
  pages.clear();
  int last = 0;
  for (int i = 0; i < 100 && last != 200; ++i) {  // places are free once the server has seen that they are gone
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    Connection next(page);
    next.send(request_text(page, "GET", "/events"));
    last = status_of(next.read_until("\r\n\r\n"));
  }
  EXPECT_EQ(last, 200);
}

TEST_F(Served, WhoDoesNotKnowTheTokenIsRefused) {
  const Place without{page.port};
  EXPECT_EQ(page.prefix.size(), 34u);
  for (const char* path : {"/", "/run", "/events", "/live.js"})
    EXPECT_EQ(status_of(ask(without, "GET", path)), 403) << path;
  const std::string answer = ask(without, "POST", "/stop");
  EXPECT_EQ(status_of(answer), 403);
  EXPECT_NE(answer.find("use the whole address"), std::string::npos) << answer;
  EXPECT_FALSE(orders.is_stopping());
}

// What is refused is refused by its head: nothing of it is unpacked or kept.
TEST_F(Served, BodiesComeAsTheyAreWithTheirLength) {
  const std::string wishes = "1\n0 radiance 0 0 0\n";
  for (const char* encoding : {"br", "gzip", "deflate", "zstd", "br, br"})
    EXPECT_EQ(status("POST", "/pictures", fmt::format("Content-Encoding: {}\r\n", encoding), wishes), 415) << encoding;
  EXPECT_EQ(status("POST", "/pictures", "Transfer-Encoding: chunked\r\n", "5\r\n12345\r\n0\r\n\r\n"), 411);
  EXPECT_EQ(status("POST", "/pictures", "Transfer-Encoding: gzip, chunked\r\n"), 411);
  for (const char* length : {"65537", "1000000000000", "18446744073709551615"})
    EXPECT_EQ(status("POST", "/pictures", fmt::format("Content-Length: {}\r\n", length)), 413) << length;
  for (const char* length : {"-1", "x", "18446744073709551616", "1, 2"})
    EXPECT_EQ(status("POST", "/pictures", fmt::format("Content-Length: {}\r\n", length)), 400) << length;
  EXPECT_EQ(status("POST", "/more", "Expect: 100-continue\r\n", "32"), 100);
  EXPECT_EQ(orders.take_iterations(), 32);
}

TEST_F(Served, HeadsHaveABound) {
  std::string many, cookies;
  for (int i = 0; i < 200; ++i) many += fmt::format("X-{}: 1\r\n", i);
  const std::string cookie = "Cookie: " + std::string(4000, 'c') + "\r\n";
  EXPECT_EQ(status("GET", "/run", cookie + cookie), 200) << "those of other programs on this machine come along";
  EXPECT_EQ(status("GET", "/run", many), 431);
  EXPECT_EQ(status("GET", "/run", "X: " + std::string(1 << 20, 'x') + "\r\n"), 431);
  EXPECT_EQ(status("GET", "/" + std::string(1 << 20, 'a')), 414);
  EXPECT_EQ(status("GET", "/run", "Host: 127.0.0.1\r\nHost: evil.example\r\n"), 400);
  // Also without the token, by whoever reaches the port, and without an end.
  const Connection endless(page);
  endless.send("GET / HTTP/1.1\r\n");
  for (int i = 0; i < 2000; ++i) endless.send("X: " + std::string(1000, 'x') + "\r\n");
  EXPECT_TRUE(endless.is_ended_within(5));
}

TEST_F(Served, EveryAnswerHasTheHeadersOfThePolicy) {
  for (const std::string& answer :
       {ask(page, "GET", "/"), ask(page, "GET", "/nothing"), ask({page.port}, "GET", "/"), ask(page, "POST", "/pause"),
        ask(page, "GET", "/" + std::string(1 << 16, 'a')),
        ask(page, "GET", "/", "X: " + std::string(1 << 16, 'x') + "\r\n"),
        ask(page, "POST", "/more", "Content-Encoding: br\r\n", "1"), ask(page, "B@D", "/"), ask(page, "POST", "/more")})
    for (const char* header :
         {"Content-Security-Policy: default-src 'none'", "X-Content-Type-Options: nosniff",
          "Cross-Origin-Resource-Policy: same-origin", "Referrer-Policy: no-referrer", "Cache-Control: no-store"})
      EXPECT_NE(answer.find(header), std::string::npos) << header << "\n" << answer.substr(0, 300);
}

TEST_F(Served, OrdersNeverAddUpToMoreThanARunMayHave) {
  int refused = 0;
  for (int i = 0; i < 2200; ++i) refused += orders.add_iterations(1'000'000) ? 0 : 1;
  EXPECT_EQ(refused, 1200);
  EXPECT_EQ(status("POST", "/more", "", "1"), 409);
  EXPECT_EQ(orders.take_iterations(), 1'000'000'000);
}

TEST_F(Served, WhoOnlyHoldsAPlaceMakesRoom) {
  std::vector<std::unique_ptr<Connection>> idle;
  for (int i = 0; i < 200; ++i) {
    idle.push_back(std::make_unique<Connection>(page));
    idle.back()->send("GET /run HT");
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(status("GET", "/run"), 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  EXPECT_TRUE(idle.front()->is_ended_within(5));
}

// From byte to byte it is in time, as a whole it is not.
TEST_F(Served, ARequestHasTenSecondsAsAWhole) {
  const Connection slow(page);
  const auto begin = std::chrono::steady_clock::now();
  const std::string text = request_text(page, "GET", "/run");
  bool is_ended = false;
  for (std::size_t i = 0; i < text.size() && !is_ended; ++i)
    slow.send(text.substr(i, 1)), is_ended = slow.is_ended_within(0.5);
  EXPECT_TRUE(is_ended);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(14));
}

TEST(Server, APortThatIsTakenIsAnError) {
  Gallery gallery;
  Board board;
  Orders orders;
  const Server first({"127.0.0.1", 0}, gallery, board, orders);
  EXPECT_THROW(Server({"127.0.0.1", place_in(first.url()).port}, gallery, board, orders), std::runtime_error);
}

TEST(Server, OtherAddressesNeedTheToken) {
  Gallery gallery;
  Board board;
  Orders orders;
  const Server server({"0.0.0.0", 0}, gallery, board, orders);
  const Place page = place_in(server.url()), without{page.port};
  EXPECT_EQ(status_of(ask(without, "GET", "/")), 403);
  EXPECT_EQ(status_of(ask(without, "POST", "/stop")), 403);
  EXPECT_EQ(status_of(ask(page, "GET", "/")), 200);
  EXPECT_EQ(status_of(ask(page, "GET", "/live.js")), 200);
}

TEST(Server, EndsWhileViewersWaitAndSlowOnesAsk) {
  const auto begin = std::chrono::steady_clock::now();
  Gallery gallery;
  Board board;
  Orders orders;
  auto server = std::make_unique<Server>(ServeAddress{"127.0.0.1", 0}, gallery, board, orders);
  const Place page = place_in(server->url());
  Connection events(page), pictures(page), slow(page), deaf(page);
  events.send(request_text(page, "GET", "/events"));
  events.read_until("event:");
  pictures.send(request_text(page, "POST", "/pictures", "", "1\n0 radiance 0 0 0\n"));
  slow.send("GET /run HT");
  for (int i = 0; i < 1000; ++i) deaf.send(request_text(page, "GET", "/live.js"));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

}  // namespace server_test
}  // namespace dspm::test
