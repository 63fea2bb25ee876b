#include "dspm/app/run/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "dspm/base/system/activity.h"
#include "dspm/base/system/json.h"
#include "dspm/base/system/readable.h"
#include "dspm/base/system/standard_streams.h"
#include "dspm/looking/terminal.h"

namespace dspm {
namespace {

constexpr double kSecondsBetweenBars = 0.2, kSecondsBetweenLines = 10;
constexpr int kBarWidth = 32;

/// Returns the most characters of a line that can be overwritten: one that wraps cannot.
std::size_t longest_line() {
  if (isatty(STDERR_FILENO) == 0) return std::string::npos;
  return static_cast<std::size_t>(std::max(size_of_terminal(STDERR_FILENO).columns - 1, 1));
}

std::string bar(double share) {
  const int filled = std::clamp(static_cast<int>(share * kBarWidth), 0, kBarWidth);
  return fmt::format("[{:=<{}}{:{}}]", "", filled, "", kBarWidth - filled);
}

std::string quoted_in_json(const std::string& text) {
  JsonWriter json;
  json.value(text);
  return json.text();
}

/// If there is room for a bar, and something to show.
std::string with_bar(const std::string& line, double share) {
  const std::string both = bar(share) + " " + line;
  return share > 0 && both.size() <= longest_line() ? both : line;
}

}  // namespace

bool stderr_is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
}

ProgressKind progress_kind(std::string_view word) {
  if (word == "none") return ProgressKind::none;
  if (word == "json") return ProgressKind::json;
  if (word == "lines" || (word.empty() && !stderr_is_terminal())) return ProgressKind::lines;
  return ProgressKind::bar;
}

Progress::Progress(const Extent& extent, ProgressKind kind)
    : extent_(extent), kind_(kind), next_(kind == ProgressKind::lines ? kSecondsBetweenLines : 0) {
  Activity::listen([this](const char* activity) { note(activity); });
  if (kind_ != ProgressKind::json) return;
  std::string line = fmt::format(R"({{"event": "begin", "intervals": {})", extent.intervals);
  if (extent.iterations > 0) line += fmt::format(R"(, "iterations": {})", extent.iterations);
  if (extent.time_limit > 0) line += fmt::format(R"(, "time_limit": {})", extent.time_limit);
  if (extent.until_error > 0) line += fmt::format(R"(, "until_error": {})", extent.until_error);
  print_message(line + "}\n");
}

Progress::~Progress() {
  Activity::listen({});
  clear();
  if (kind_ == ProgressKind::json)
    print_message(fmt::format("{{\"event\": \"end\", \"seconds\": {:.3f}}}\n", elapsed()));
}

void Progress::clear() {
  if (width_ > 0) print_message(fmt::format("\r{:{}}\r", "", std::min(width_, longest_line())));
  width_ = 0;
}

void Progress::begin(int interval, int iterations) {
  trend_.clear();
  before_ += std::max(0.0, share_done(interval, iterations) - share_done(interval, 0));
}

void Progress::step(int interval, int iterations, std::optional<double> error) {
  if (error) trend_.add(iterations, *error);
  if (kind_ == ProgressKind::json) return print_message(json(interval, iterations));
  if (kind_ == ProgressKind::none || !is_due()) return;
  const std::string line = text(interval, iterations);
  if (kind_ == ProgressKind::lines) return print_message(fmt::format("dspm: {}\n", line));
  show(with_bar(line, share_done(interval, iterations)));
}

void Progress::note(const char* activity) {
  if (kind_ == ProgressKind::none || !is_due()) return;
  const std::string line = fmt::format("{}, {}", activity, readable_time(elapsed()));
  switch (kind_) {
    case ProgressKind::json:
      return print_message(
          fmt::format("{{\"event\": \"busy\", \"with\": \"{}\", \"seconds\": {:.3f}}}\n", activity, elapsed()));
    case ProgressKind::lines: return print_message(fmt::format("dspm: {}\n", line));
    default: return show(line);
  }
}

void Progress::show(const std::string& bar) {
  const std::string shown = bar.substr(0, longest_line());
  print_message(fmt::format("\r{:{}}", shown, std::min(width_, longest_line())));
  width_ = shown.size();
}

void Progress::written(int interval, const std::vector<std::string>& frames, bool last) {
  if (kind_ != ProgressKind::json) return;
  std::vector<std::string> quoted;
  for (const std::string& frame : frames) quoted.push_back(quoted_in_json(frame));
  print_message(fmt::format("{{\"event\": \"images\", \"interval\": {}, \"frames\": [{}], \"last\": {}}}\n",
                            interval + 1, fmt::join(quoted, ", "), last));
}

bool Progress::is_due() {
  if (elapsed() < next_) return false;
  next_ = elapsed() + (kind_ == ProgressKind::lines ? kSecondsBetweenLines : kSecondsBetweenBars);
  return true;
}

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

/// Counts by iterations, error or time, whichever ends first.
double Progress::share_done(int interval, int iterations) const {
  double share = 0;
  if (extent_.iterations > 0) share = iterations / double(extent_.iterations);
  if (extent_.until_error > 0)
    if (const auto all = trend_.iterations_until(extent_.until_error)) share = std::max(share, iterations / *all);
  if (extent_.iterations > 0 || extent_.until_error > 0) share = (interval + std::min(share, 1.0)) / extent_.intervals;
  if (extent_.time_limit > 0) share = std::max(share, elapsed() / extent_.time_limit);
  return std::min(share, 1.0);
}

std::string Progress::text(int interval, int iterations) const {
  std::string line = fmt::format("iteration {}", iterations);
  if (extent_.iterations > 0) line += fmt::format("/{}", extent_.iterations);
  if (extent_.intervals > 1) line += fmt::format(" of frame interval {}/{}", interval + 1, extent_.intervals);
  if (trend_.now() && extent_.until_error > 0)
    line += fmt::format(", error {} of {}", readable_share(*trend_.now()), readable_share(extent_.until_error));
  const Outlook outlook = this->outlook(interval, iterations);
  line += fmt::format(", {}", readable_time(outlook.seconds));
  if (outlook.share == 0) return line;
  if (outlook.seconds_left) line += fmt::format(", {} left", readable_time(*outlook.seconds_left));
  return line;
}

std::string Progress::json(int interval, int iterations) const {
  const Outlook outlook = this->outlook(interval, iterations);
  std::string line = fmt::format(R"({{"event": "iteration", "interval": {}, "iterations": {}, "seconds": {:.3f})",
                                 interval + 1, iterations, outlook.seconds);
  if (trend_.now()) line += fmt::format(R"(, "error": {:.6g})", *trend_.now());
  if (outlook.share > 0)
    line += fmt::format(R"(, "share_done": {:.4f}, "seconds_left": {:.3f})", outlook.share,
                        outlook.seconds_left.value_or(0));
  return line + "}\n";
}

Progress::Outlook Progress::outlook(int interval, int iterations) const {
  Outlook outlook{share_done(interval, iterations), elapsed()};
  if (outlook.share > 0 && outlook.share < 1)
    outlook.seconds_left = outlook.seconds * (1 - outlook.share) / std::max(outlook.share - before_, 1e-9);
  return outlook;
}

}  // namespace dspm
