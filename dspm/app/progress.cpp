#include "dspm/app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "dspm/system/readable.h"
#include "dspm/system/standard_streams.h"

namespace dspm {
namespace {

constexpr double kSecondsBetweenBars = 0.2, kSecondsBetweenLines = 10;
constexpr int kBarWidth = 32;

std::string bar(double share) {
  const int filled = std::clamp(static_cast<int>(share * kBarWidth), 0, kBarWidth);
  return fmt::format("[{:=<{}}{:{}}]", "", filled, "", kBarWidth - filled);
}

}  // namespace

bool stderr_is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
}

Progress::Progress(const Extent& extent, bool quiet, bool terminal)
    : extent_(extent), quiet_(quiet), terminal_(terminal), next_(terminal_ ? 0 : kSecondsBetweenLines) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (width_ > 0) print_message(fmt::format("\r{:{}}\r", "", width_));
  width_ = 0;
}

void Progress::begin(int interval, int iterations) {
  trend_.clear();
  before_ += std::max(0.0, share_done(interval, iterations) - share_done(interval, 0));
}

void Progress::step(int interval, int iterations, std::optional<double> error) {
  if (error) trend_.add(iterations, *error);
  if (quiet_ || elapsed() < next_) return;
  next_ = elapsed() + (terminal_ ? kSecondsBetweenBars : kSecondsBetweenLines);
  const std::string line = text(interval, iterations);
  if (terminal_) {
    print_message(fmt::format("\r{:{}}", line, width_));
    width_ = std::max(width_, line.size());
  } else {
    print_message(fmt::format("dspm: {}\n", line));
  }
}

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

/// By iterations, error or time, whichever ends first.
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
  return terminal_ ? bar(outlook.share) + " " + line : line;
}

Progress::Outlook Progress::outlook(int interval, int iterations) const {
  Outlook outlook{share_done(interval, iterations), elapsed()};
  if (outlook.share > 0 && outlook.share < 1)
    outlook.seconds_left = outlook.seconds * (1 - outlook.share) / std::max(outlook.share - before_, 1e-9);
  return outlook;
}

}  // namespace dspm
