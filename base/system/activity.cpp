#include "dspm/base/system/activity.h"

#include <atomic>
#include <utility>

namespace dspm {
namespace {

std::atomic<const char*> running = nullptr;

std::function<void(const char*)>& listener() {
  static std::function<void(const char*)> function;
  return function;
}

}  // namespace

Activity::Activity(const char* name) : is_outer_(running == nullptr) {
  if (!is_outer_) return;
  running = name;
  goes_on();
}

Activity::~Activity() {
  if (is_outer_) running = nullptr;
}

const char* Activity::now() { return running; }

void Activity::goes_on() {
  if (const char* const name = running; name != nullptr && listener()) listener()(name);
}

void Activity::listen(std::function<void(const char* name)> listens) { listener() = std::move(listens); }

}  // namespace dspm
