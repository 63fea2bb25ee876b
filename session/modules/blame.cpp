#include "dspm/session/modules/blame.h"

#include <dirent.h>
#include <execinfo.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <thread>

namespace dspm {
namespace {

constexpr int kDeepest = 64;

const LoadedModule* module_at(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (const LoadedModule& module : loaded_modules())
    if (module.begin <= at && at < module.end) return &module;
  return nullptr;
}

/// The latest exceptions and the modules that threw them. A few are enough: exceptions are rare and soon handled.
class ThrownObjects {
 public:
  void add(const void* object, const LoadedModule* module) {
    Entry& entry = entries_[next_++ % entries_.size()];
    entry.object = nullptr;
    entry.module = module;
    entry.object = object;
  }
  const LoadedModule* find(const void* object) const {
    const unsigned next = next_;
    for (unsigned back = 1; back <= entries_.size(); ++back)  // newest first: addresses are reused
      if (const Entry& entry = entries_[(next - back) % entries_.size()]; entry.object == object) return entry.module;
    return nullptr;
  }

 private:
  struct Entry {
    std::atomic<const void*> object = nullptr;
    std::atomic<const LoadedModule*> module = nullptr;
  };
  std::array<Entry, 64> entries_;
  std::atomic<unsigned> next_ = 0;
};
ThrownObjects thrown;

std::atomic<std::uint64_t> busy = 0;  // a bit for each module
static_assert(kMostModules <= 64);
std::atomic<int> answers = 0;

void on_question(int) {
  const int kept = errno;
  if (const LoadedModule* module = module_on_stack()) busy |= std::uint64_t{1} << (module - loaded_modules().data());
  ++answers;
  errno = kept;
}

/// Returns how many other threads of this process could be asked.
int ask_all_threads(int signal) {
  DIR* const tasks = opendir("/proc/self/task");
  if (tasks == nullptr) return 0;
  const auto self = static_cast<pid_t>(syscall(SYS_gettid));
  int asked = 0;
  while (const dirent* entry = readdir(tasks)) {
    const auto thread = static_cast<pid_t>(std::atoi(entry->d_name));
    if (thread > 0 && thread != self) asked += syscall(SYS_tgkill, getpid(), thread, signal) == 0 ? 1 : 0;
  }
  closedir(tasks);
  return asked;
}

}  // namespace

const LoadedModule* module_on_stack() {
  if (loaded_modules().empty()) return nullptr;
  std::array<void*, kDeepest> frames;
  const int depth = backtrace(frames.data(), kDeepest);
  for (int i = 0; i < depth; ++i)
    if (const LoadedModule* module = module_at(frames[static_cast<std::size_t>(i)])) return module;
  return nullptr;
}

void note_throw(const void* object) { thrown.add(object, module_on_stack()); }

const LoadedModule* module_that_threw() {
  const std::exception_ptr current = std::current_exception();
  const void* object = nullptr;
  static_assert(sizeof(current) == sizeof(object));  // libstdc++ keeps nothing else in it
  std::memcpy(&object, &current, sizeof(object));
  return object != nullptr ? thrown.find(object) : nullptr;
}

std::vector<const LoadedModule*> modules_at_work() {
  std::vector<const LoadedModule*> found;
  if (loaded_modules().empty()) return found;
  const int signal = SIGRTMIN + 7;
  struct sigaction action = {}, before;
  action.sa_handler = on_question;
  action.sa_flags = SA_RESTART;
  std::array<void*, 1> first_use;  // it loads libgcc, which a signal handler must not
  backtrace(first_use.data(), 1);
  busy = 0, answers = 0;
  if (sigaction(signal, &action, &before) != 0) return found;
  const int asked = ask_all_threads(signal);
  for (int wait = 0; wait < 100 && answers < asked; ++wait) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (answers == asked) sigaction(signal, &before, nullptr);  // a late answer must find its handler
  const std::uint64_t bits = busy;
  for (const LoadedModule& module : loaded_modules())
    if ((bits >> (&module - loaded_modules().data()) & 1) != 0) found.push_back(&module);
  return found;
}

}  // namespace dspm
