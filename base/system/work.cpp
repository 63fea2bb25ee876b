#include "dspm/base/system/work.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dspm {
namespace {

using detail::WorkAccount;

std::atomic<bool> is_counting{false};

thread_local WorkAccount outside_of_loops;
thread_local WorkAccount* current = nullptr;  // null: outside_of_loops

WorkAccount* account() { return current != nullptr ? current : &outside_of_loops; }

double now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::int64_t nanoseconds(double seconds) { return std::llround(1e9 * seconds); }

}  // namespace

void count_work() {
  is_counting = true;
  account()->go_on();
}

Work work_done() {
  if (!is_counting) return {};
  account()->pause();
  account()->go_on();
  return account()->work;
}

namespace detail {

void WorkAccount::pause() {
  const double seconds = now(CLOCK_THREAD_CPUTIME_ID) - since;
  work += {seconds, seconds};
}

void WorkAccount::go_on() { since = now(CLOCK_THREAD_CPUTIME_ID); }

LoopWork::LoopWork() {
  if (!is_counting) return;
  account_ = account();
  account_->pause();
}

LoopWork::~LoopWork() {
  if (account_ == nullptr) return;
  account_->work += {1e-9 * static_cast<double>(all_), 1e-9 * static_cast<double>(span_)};
  account_->go_on();
}

LoopWork::Chunk::Chunk(LoopWork& loop) : loop_(loop) {
  if (loop.account_ == nullptr) return;
  outer_ = std::exchange(current, &account_);
  account_.go_on();
}

LoopWork::Chunk::~Chunk() {
  if (loop_.account_ == nullptr) return;
  account_.pause();
  current = outer_;
  loop_.all_ += nanoseconds(account_.work.all);
  const std::int64_t own = nanoseconds(account_.work.span);
  std::int64_t longest = loop_.span_;
  while (longest < own && !loop_.span_.compare_exchange_weak(longest, own)) {}
}

}  // namespace detail

LibraryWork::LibraryWork(int threads) : threads_(threads) {
  if (!is_counting) return;
  account_ = account();
  account_->pause();
  processor_ = now(CLOCK_PROCESS_CPUTIME_ID);
  begin_ = std::chrono::steady_clock::now();
}

LibraryWork::~LibraryWork() {
  if (account_ == nullptr) return;
  const double all = now(CLOCK_PROCESS_CPUTIME_ID) - processor_;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  const double span = threads_ > 1 ? (threads_ * seconds - all) / (threads_ - 1) : all;
  account_->work += {all, std::clamp(span, 0.0, all)};
  account_->go_on();
}

}  // namespace dspm
