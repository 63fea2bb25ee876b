// dspm --serve, as a viewer sees it who speaks HTTP.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "dspm/image/exr.h"
#include "tests/serve/http_client.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace live_run_test {

class LiveRun : public testing::Test {
 protected:
  void start(const Arguments& more = {}) {
    process_.emplace(directory, Arguments{"tiny.dsc", "--serve", "0"} + more);
    ASSERT_TRUE(says(directory, "the page is at"));
    const std::string text = contents(directory / "err.txt");
    const std::size_t url = text.find("http://");
    page = place_in(text.substr(url, text.find('\n', url) - url));
  }
  Outcome end() {
    ask(page, "POST", "/stop");
    const Outcome outcome = process_->wait();
    process_.reset();
    return outcome;
  }
  void TearDown() override {
    if (process_) process_->send(SIGKILL), process_->wait();
  }
  /// Reads the events until the text is among them.
  std::string events_until(const std::string& text) const {
    Connection events(page);
    events.send(request_text(page, "GET", "/events"));
    return events.read_until(text);
  }
  std::string pictures(const std::string& wishes) const { return ask(page, "POST", "/pictures", "", "1\n" + wishes); }

  TinyDirectory directory;
  std::optional<Process> process_;
  Place page{0};
};

TEST_F(LiveRun, ShowsAllFramesAndStaysUntilItIsStopped) {
  start();
  ASSERT_NE(events_until("\"phase\": \"done\"").find("\"phase\": \"done\""), std::string::npos);
  EXPECT_TRUE(directory.has("tiny.0003.exr")) << "the images are written before the page waits";
  const std::string run = ask(page, "GET", "/run");
  EXPECT_NE(run.find("\"label\": \"3\""), std::string::npos) << run;
  EXPECT_NE(run.find("\"fps\": 25"), std::string::npos) << run;
  const std::string answer = pictures("0 radiance 0 0 0\n1 radiance 0 0 0\n2 radiance 0 0 0\n");
  for (const char* frame : {"0 radiance 0 ", "1 radiance 0 ", "2 radiance 0 "})
    EXPECT_NE(answer.find(frame), std::string::npos) << frame;
  EXPECT_NE(answer.find(" 12 8 3 2 2 0 "), std::string::npos)
      << "12 x 8 pixels of 3 halves after 2 iterations, not coarse";
  EXPECT_EQ(end().code, 0);
}

TEST_F(LiveRun, GivesMoreIterationsWritesAndStops) {
  start();
  events_until("\"phase\": \"done\"");
  EXPECT_EQ(status_of(ask(page, "POST", "/more", "", "3")), 204);
  EXPECT_NE(events_until("\"iterations\": 5,").find("\"iterations\": 5,"), std::string::npos);
  const Outcome outcome = end();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_exr_header(directory / "tiny.0001.exr").integers.at("iterations"), 5);
}

TEST_F(LiveRun, MoreIterationsGiveTheImageOfALongerRun) {
  start();
  events_until("\"phase\": \"done\"");
  ask(page, "POST", "/more", "", "3");
  events_until("\"iterations\": 5,");
  end();
  const TinyDirectory other;
  ASSERT_EQ(run(other, {"tiny.dsc", "--iterations", "5"}).code, 0);
  EXPECT_EQ(read_image(directory / "tiny.0002.exr"), read_image(other / "tiny.0002.exr"));
}

TEST_F(LiveRun, PausesAndGoesOn) {
  start({"--iterations", "0"});
  events_until("\"step\": \"iteration ");
  EXPECT_EQ(status_of(ask(page, "POST", "/pause")), 204);
  const std::string paused = events_until("\"phase\": \"paused\"");
  ASSERT_NE(paused.find("\"phase\": \"paused\""), std::string::npos);
  EXPECT_EQ(status_of(ask(page, "GET", "/")), 200);
  EXPECT_NE(pictures("2 radiance 0 0 0\n").find("2 radiance 0 "), std::string::npos)
      << "pictures come while it is paused";
  EXPECT_EQ(status_of(ask(page, "POST", "/resume")), 204);
  EXPECT_EQ(status_of(ask(page, "POST", "/write")), 204);
  EXPECT_TRUE(appears(directory / "tiny.0003.exr"));
  const Outcome outcome = end();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(LiveRun, SameImagesAsWithoutAPage) {
  start({"--iterations", "3"});
  events_until("\"phase\": \"done\"");
  pictures("0 radiance 0 0 0\n");
  end();
  const TinyDirectory other;
  ASSERT_EQ(run(other, {"tiny.dsc", "--iterations", "3"}).code, 0);
  for (const char* image : kTinyImages) EXPECT_EQ(read_image(directory / image), read_image(other / image)) << image;
}

TEST_F(LiveRun, AnEditedSceneIsRenderedAnew) {
  start();
  events_until("\"phase\": \"done\"");
  put_file(directory / "tiny.dsc", tiny_scene("\"integer iterations\" 2", "\"integer iterations\" 4"));
  ASSERT_NE(events_until("\"iterations\": 4,").find("\"iterations\": 4,"), std::string::npos);
  const Outcome outcome = end();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_exr_header(directory / "tiny.0001.exr").integers.at("iterations"), 4);
}

// Each edit is told by another number of iterations, so that its end is known.
TEST_F(LiveRun, AfterAnyEditTheImagesAreThoseOfAFreshRun) {
  const auto mesh = [](const std::string& height) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 " +
           height + "\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  };
  std::filesystem::create_directory(directory / "meshes");
  put_file(directory / "a.ply", mesh("-1"));
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));  // files that were just saved are not kept
  const std::string part = "Material \"dielectric\" Shape \"plymesh\" \"string filename\" \"a.ply\" ";
  int iterations = 2;
  const auto scene = [&](const std::string& more, const std::string& from = "", const std::string& to = "") {
    std::string text = tiny_scene("\"integer iterations\" 2", fmt::format("\"integer iterations\" {}", iterations));
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return text + more;
  };
  put_file(directory / "tiny.dsc", scene(part));
  start();
  const auto expect_fresh = [&](const char* what) {
    ASSERT_TRUE(comes_true([&] {
      const std::string events = events_until("\"phase\"");
      return events.find("\"phase\": \"done\"") != std::string::npos &&
             events.find(fmt::format("\"of\": {},", iterations)) != std::string::npos;
    })) << what;
    const TinyDirectory other;
    std::filesystem::copy(directory / "a.ply", other / "a.ply");
    std::filesystem::copy(directory / "tiny.dsc", other / "tiny.dsc",
                          std::filesystem::copy_options::overwrite_existing);
    ASSERT_EQ(run(other, {"tiny.dsc"}).code, 0);
    for (const char* image : kTinyImages)
      EXPECT_EQ(read_image(directory / image), read_image(other / image)) << what << ": " << image;
  };
  const auto edit = [&](const char* what, const std::string& more, const std::string& from = "",
                        const std::string& to = "") {
    ++iterations;
    put_file(directory / "tiny.dsc", scene(more, from, to));
    expect_fresh(what);
  };
  expect_fresh("as it is");
  edit("a material", "Material \"diffuse\" Shape \"plymesh\" \"string filename\" \"a.ply\" ");
  edit("a key", part, "Translate 1 0 0", "Translate 1 .5 0");
  edit("a place", "Translate 0 .3 0 " + part);
  edit("another shape before", part, "  Material \"diffuse\"",
       "Shape \"sphere\" \"float radius\" .1 Material \"diffuse\"");
  put_file(directory / "a.ply", mesh("-2"));
  edit("a mesh file", part);
  edit("a light", part, "[5 5 5]", "[5 9 5]");
  EXPECT_EQ(end().code, 0);
}

TEST_F(LiveRun, AnEditInTheMiddleOfALongIterationEndsIt) {
  put_file(directory / "tiny.dsc", tiny_scene("\"integer photons\" 200", "\"integer photons\" 400000000"));
  start({"-t", "1"});
  events_until("coarse iterations");
  put_file(directory / "tiny.dsc", kTinyScene);
  EXPECT_NE(events_until("\"phase\": \"done\"").find("\"phase\": \"done\""), std::string::npos);
}

TEST_F(LiveRun, CoarseRunsAreShownInTheFullSizeAndStartAsTheLastRunHasLearned) {
  start({"-t", "1"});
  events_until("\"phase\": \"done\"");
  put_file(directory / "tiny.dsc", tiny_scene("\"integer photons\" 200", "\"integer photons\" 400000000"));
  const std::string events = events_until("\"coarse\": 1,  \"guided\": 1");  // for as long as these photons take
  EXPECT_NE(events.find("\"coarse\": 1,  \"guided\": 1"), std::string::npos) << events;
  EXPECT_NE(ask(page, "GET", "/run").find("\"width\": 12"), std::string::npos);
}

TEST_F(LiveRun, ErrorsStandOnThePageWithTheirPlaceUntilTheyAreMended) {
  start();
  events_until("\"phase\": \"done\"");
  put_file(directory / "tiny.dsc", tiny_scene("\"rgb reflectance\"", "\"rgb reflektance\""));
  const std::string events = events_until("reflektance");
  EXPECT_NE(events.find("event: problem\ndata: \"tiny.dsc:13:"), std::string::npos) << events;
  EXPECT_NE(events.find("^"), std::string::npos) << "the caret";
  EXPECT_NE(pictures("1 radiance 0 0 0\n").find("1 radiance 0 "), std::string::npos) << "the old picture stays";
  put_file(directory / "tiny.dsc", tiny_scene("\"integer iterations\" 2", "\"integer iterations\" 3"));
  const std::string mended = events_until("\"iterations\": 3,");
  EXPECT_NE(mended.find("event: problem\ndata: \"\"\n"), std::string::npos) << mended;
  EXPECT_EQ(end().code, 0);
}

TEST_F(LiveRun, APipeInPlaceOfTheSceneIsNotWaitedFor) {
  start();
  events_until("\"phase\": \"done\"");
  std::filesystem::remove(directory / "tiny.dsc");
  ASSERT_EQ(mkfifo((directory / "tiny.dsc").c_str(), 0600), 0);
  EXPECT_NE(events_until("not a regular file").find("not a regular file"), std::string::npos);
  process_->send(SIGINT);
  EXPECT_EQ(process_->wait().code, 130);
  process_.reset();
}

TEST_F(LiveRun, ASceneWithErrorsAtTheStartMayBeMended) {
  put_file(directory / "tiny.dsc", tiny_scene("Camera \"perspective\"", "Camera \"perspektive\""));
  start();
  EXPECT_NE(events_until("did you mean").find("perspektive"), std::string::npos);
  put_file(directory / "tiny.dsc", kTinyScene);
  EXPECT_NE(events_until("\"phase\": \"done\"").find("\"phase\": \"done\""), std::string::npos);
  EXPECT_EQ(end().code, 0);
}

TEST_F(LiveRun, ASceneThatStaysWrongIsAnError) {
  put_file(directory / "tiny.dsc", tiny_scene("Camera \"perspective\"", "Camera \"perspektive\""));
  start();
  events_until("did you mean");
  EXPECT_EQ(end().code, 1);
}

TEST_F(LiveRun, ACameraThatIsMovedGivesTheImageOfThatLookAt) {
  start();
  events_until("\"phase\": \"done\"");
  EXPECT_EQ(status_of(ask(page, "POST", "/camera", "", "1 0.5 -4 0 0 0 0 1 0")), 204);
  ASSERT_TRUE(comes_true([&] { return ask(page, "GET", "/run").find("0.5") != std::string::npos; }));
  events_until("\"coarse\": 0");
  ASSERT_TRUE(comes_true([&] { return events_until("\"phase\"").find("\"phase\": \"done\"") != std::string::npos; }));
  EXPECT_EQ(end().code, 0);
  const TinyDirectory other;
  put_file(other / "tiny.dsc", tiny_scene("LookAt 0 0 -4  0 0 0", "LookAt 1 0.5 -4  0 0 0"));
  ASSERT_EQ(run(other, {"tiny.dsc"}).code, 0);
  EXPECT_EQ(read_image(directory / "tiny.0002.exr"), read_image(other / "tiny.0002.exr"));
}

TEST_F(LiveRun, CtrlCEndsItWhileItWaits) {
  start();
  events_until("\"phase\": \"done\"");
  process_->send(SIGINT);
  const Outcome outcome = process_->wait();
  process_.reset();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
}

TEST(LiveOptions, WhatDoesNotFitIsRefused) {
  const TinyDirectory directory;
  const auto error = [&](const Arguments& more) {
    const Outcome outcome = run(directory, Arguments{"tiny.dsc"} + more);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(error({"--serve=nowhere"}).find("expected a port or an address"), std::string::npos);
  EXPECT_NE(error({"--serve", "--memory", "1G"}).find("exclude each other"), std::string::npos);
  EXPECT_NE(error({"--serve", "--check"}).find("nothing is rendered"), std::string::npos);
  EXPECT_NE(error({"--serve", "0", "-"}).find("standard input"), std::string::npos);
}

}  // namespace live_run_test
}  // namespace dspm::test
