#include "dspm/app/run/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "dspm/base/system/activity.h"
#include "dspm/base/system/readable.h"
#include "dspm/base/system/standard_streams.h"
#include "dspm/session/modules/all_plugins.h"
#include "dspm/session/modules/blame.h"

namespace dspm {
namespace {

constexpr double kLongest = 1e8;  // seconds, about three years: the clock can count them

template <class Body>
std::thread started(const Body& body) {
  try {
    return std::thread(body);
  } catch (const std::system_error& error) {
    throw std::runtime_error(
        fmt::format("no thread can be started ({}): too little memory (ulimit -v), or too many processes (ulimit -u)",
                    error.code().message()));
  }
}

}  // namespace

Watch::Watch(double patience)
    : patience_(
          std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(patience, kLongest)))),
      begin_(Clock::now()),
      next_(begin_ + patience_),
      thread_(started([this] { run(); })) {}

Watch::~Watch() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Watch::begin(std::string step, std::string own) {
  const std::lock_guard lock(mutex_);
  step_ = std::move(step), own_ = std::move(own);
  begin_ = Clock::now(), next_ = begin_ + patience_;
}

void Watch::run() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    if (changed_.wait_until(lock, next_) != std::cv_status::timeout || Clock::now() < next_) continue;
    if (!step_.empty()) print_message(complaint());
    next_ = begin_ + 2 * (next_ - begin_);
  }
}

std::string Watch::complaint() const {
  std::string who;
  for (const LoadedModule* module : modules_at_work()) who += (who.empty() ? "" : "; ") + in_words(*module);
  if (who.empty()) who = own_;
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const char* const activity = Activity::now();
  return fmt::format("dspm: {} has not ended after {}{}{}\n", activity != nullptr ? activity : step_,
                     readable_time(seconds), who.empty() ? "" : ", at work: ", who);
}

}  // namespace dspm
