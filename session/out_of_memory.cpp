#include "dspm/session/out_of_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <new>

#include "dspm/base/system/memory_use.h"
#include "dspm/base/system/readable.h"
#include "dspm/session/modules/all_plugins.h"
#include "dspm/session/modules/blame.h"

namespace dspm {

bool is_out_of_memory(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         dynamic_cast<const std::length_error*>(&error) != nullptr;
}

std::string out_of_memory(const std::string& step) {
  rlimit limit{};
  const bool limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  const std::string taken = limited ? fmt::format("{} of the {} that ulimit -v allows",
                                                  readable_bytes(peak_address_space()), readable_bytes(limit.rlim_cur))
                                    : readable_bytes(peak_memory());
  const LoadedModule* const module = module_that_threw();
  const std::string who = module != nullptr ? fmt::format("{} (in {})", step, in_words(*module)) : step;
  return fmt::format(
      "out of memory: {} needs more than is available, after {} were taken; --memory with what is available makes the "
      "run fit or says what it takes; a smaller image, fewer photons or fewer frames (--frames) take less",
      who, taken);
}

}  // namespace dspm
