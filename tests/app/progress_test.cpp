#include "dspm/app/run/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "dspm/base/system/activity.h"
#include "tests/output/json_check.h"

namespace dspm {
namespace {

/// Tests do not run on a terminal: lines come now and then, never a bar, and nothing at once.
TEST(Progress, IsSilentWhereNothingIsDue) {
  testing::internal::CaptureStderr();
  {
    Progress progress({.iterations = 10, .time_limit = 0, .intervals = 1}, progress_kind(""));
    for (int i = 1; i <= 10; ++i) progress.step(0, i);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

std::string first_bar(const Progress::Extent& extent, int interval, int iterations) {
  testing::internal::CaptureStderr();
  {
    Progress progress(extent, ProgressKind::bar);
    progress.step(interval, iterations);
  }
  const std::string text = testing::internal::GetCapturedStderr();
  return text.substr(1, text.find(',') - 1);  // after \r, before the time
}

TEST(Progress, FillsItsBar) {
  const std::string half(16, '='), quarter(8, '=');
  EXPECT_EQ(first_bar({.iterations = 10}, 0, 5), "[" + half + std::string(16, ' ') + "] iteration 5/10");
  EXPECT_EQ(first_bar({.iterations = 10}, 0, 10), "[" + half + half + "] iteration 10/10");
  EXPECT_EQ(first_bar({.iterations = 8, .intervals = 2}, 1, 4),
            "[" + half + quarter + std::string(8, ' ') + "] iteration 4/8 of frame interval 2/2");
}

/// What standard error gets while it is a terminal of that width.
std::string on_terminal(std::size_t columns, const std::function<void()>& print) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  EXPECT_EQ(grantpt(master) + unlockpt(master), 0);
  const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY), before = dup(STDERR_FILENO);
  const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
  ioctl(terminal, TIOCSWINSZ, &size);
  dup2(terminal, STDERR_FILENO);
  print();
  dup2(before, STDERR_FILENO);
  char bytes[4096];
  const ssize_t count = read(master, bytes, sizeof bytes);
  for (const int descriptor : {terminal, before, master}) close(descriptor);
  return {bytes, static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
}

/// A line that wraps is not overwritten: every step would leave one behind.
TEST(Progress, FitsIntoTheTerminalsLine) {
  const auto print = [] {
    Progress progress({.iterations = 256, .intervals = 1, .until_error = 0.02}, ProgressKind::bar);
    progress.step(0, 128, 0.05);
  };
  for (const std::size_t columns : {10u, 40u, 60u, 200u}) {
    const std::string text = on_terminal(columns, print);
    EXPECT_EQ(text.find('['), columns == 200 ? 1 : text.npos) << text;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line, '\r');) EXPECT_LT(line.size(), columns) << line;
    EXPECT_NE(text.find("iteration"), text.npos) << text;
  }
}

TEST(Progress, ForetellsWhenAnErrorIsReached) {
  ErrorTrend trend;
  EXPECT_FALSE(trend.iterations_until(0.01));
  trend.add(16, 0.04);
  EXPECT_DOUBLE_EQ(*trend.iterations_until(0.02), 64);  // as for independent iterations
  trend.add(17, 0.04);                                  // not estimated anew
  trend.add(64, 0.02);
  EXPECT_DOUBLE_EQ(*trend.iterations_until(0.01), 256);
  EXPECT_DOUBLE_EQ(*trend.iterations_until(0.02), 64);
  EXPECT_DOUBLE_EQ(*trend.iterations_until(0.03), 64);
  trend.add(128, 0.02 * std::pow(2, -0.35));  // slower
  EXPECT_NEAR(*trend.iterations_until(0.01), 64 * std::pow(2, 1 / 0.35), 1e-6);
}

TEST(Progress, ShowsTheError) {
  testing::internal::CaptureStderr();
  {
    Progress progress({.iterations = 0, .intervals = 1, .until_error = 0.02}, ProgressKind::bar);
    progress.step(0, 16, 0.04);
  }
  const std::string text = testing::internal::GetCapturedStderr(), quarter(8, '=');
  EXPECT_EQ(text.substr(1, text.find(", 0") - 1),
            "[" + quarter + std::string(24, ' ') + "] iteration 16, error 4% of 2%")
      << text;
}

TEST(Progress, HasNoBarWithoutAnEnd) { EXPECT_EQ(first_bar({.iterations = 0}, 0, 5), "iteration 5"); }

TEST(Progress, SpeaksJsonToPrograms) {
  testing::internal::CaptureStderr();
  {
    Progress progress({.iterations = 4, .intervals = 2, .until_error = 0.02}, progress_kind("json"));
    progress.step(0, 4, 0.08);
    progress.written(0, {"1", "oak \"A\" 2"}, true);
    progress.step(1, 2);
  }
  std::istringstream text(testing::internal::GetCapturedStderr());
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 5u);
  for (const std::string& line : lines) EXPECT_TRUE(test::JsonCheck::valid(line)) << line;
  EXPECT_EQ(lines[0], R"({"event": "begin", "intervals": 2, "iterations": 4, "until_error": 0.02})");
  EXPECT_TRUE(lines[1].starts_with(R"({"event": "iteration", "interval": 1, "iterations": 4, "seconds": )"))
      << lines[1];
  EXPECT_NE(lines[1].find(R"("error": 0.08, "share_done": 0.5000, )"), std::string::npos) << lines[1];
  EXPECT_EQ(lines[2], R"({"event": "images", "interval": 1, "frames": ["1", "oak \"A\" 2"], "last": true})");
  EXPECT_NE(lines[3].find(R"("interval": 2, "iterations": 2, )"), std::string::npos);
  EXPECT_NE(lines[3].find(R"("share_done": 0.7500, "seconds_left": )"), std::string::npos) << lines[3];
  EXPECT_TRUE(lines[4].starts_with(R"({"event": "end", "seconds": )")) << lines[4];
}

TEST(Progress, SaysWhatAnIterationIsBusyWith) {
  testing::internal::CaptureStderr();
  {
    Progress progress({.iterations = 4}, ProgressKind::json);
    const Activity outer("learning"), inner("looking");
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find(R"({"event": "busy", "with": "learning", "seconds": 0.0)"), std::string::npos) << text;
  EXPECT_EQ(text.find("looking"), std::string::npos) << text;
  testing::internal::CaptureStderr();
  {
    Progress progress({.iterations = 4}, ProgressKind::bar);
    const Activity activity("learning");
  }
  EXPECT_TRUE(testing::internal::GetCapturedStderr().starts_with("\rlearning, 0.0s"));
  testing::internal::CaptureStderr();
  { const Activity activity("learning"); }  // nobody listens any more
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace dspm
