#include "dspm/base/system/sudden_end.h"

#include <signal.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstring>

namespace dspm {

// A signal may come at any moment, on any thread: the handler uses fixed slots, never anything that may be freed.
struct Leftover::Slot {
  std::atomic<bool> taken{false}, ready{false};
  pid_t program = 0;
  char file[PATH_MAX] = "";

  static std::array<Slot, 8> all;
};
std::array<Leftover::Slot, 8> Leftover::Slot::all;

Leftover::Slot* Leftover::take() {
  for (Slot& slot : Slot::all)
    if (!slot.taken.exchange(true)) return &slot;
  return nullptr;
}

Leftover::Leftover(const std::filesystem::path& file) : slot_(take()) {
  const std::size_t bytes = std::strlen(file.c_str()) + 1;
  if (slot_ == nullptr || bytes > sizeof slot_->file) return;
  std::memcpy(slot_->file, file.c_str(), bytes);
  slot_->ready = true;
}

Leftover::Leftover(pid_t program) : slot_(take()) {
  if (slot_ == nullptr) return;
  slot_->program = program;
  slot_->ready = true;
}

Leftover::~Leftover() {
  if (slot_ == nullptr) return;
  slot_->ready = false;
  slot_->program = 0;
  slot_->taken = false;
}

namespace {

std::atomic<bool> ends{false};
std::atomic<int> beginning{0};

/// Waits, but not for long: it may be the interrupted thread itself that creates one.
void wait_for_beginning() {
  constexpr timespec kMoment{0, 1'000'000};
  for (int moment = 0; moment < 100 && beginning > 0; ++moment) nanosleep(&kMoment, nullptr);
}

}  // namespace

LeftoverBegins::LeftoverBegins() {
  ++beginning;
  if (!ends) return;
  --beginning;
  for (;;) pause();
}

LeftoverBegins::~LeftoverBegins() { --beginning; }

void remove_leftovers() {
  ends = true;
  wait_for_beginning();
  for (const Leftover::Slot& slot : Leftover::Slot::all)
    if (slot.ready && slot.program != 0) kill(slot.program, SIGKILL);
  for (const Leftover::Slot& slot : Leftover::Slot::all)
    if (slot.ready && slot.program == 0) unlink(slot.file);
}

void end_suddenly(int code) {
  remove_leftovers();
  for (;;) syscall(SYS_exit_group, code);  // not _exit(), which last words take for a module's
}

}  // namespace dspm
