#include <chrono>

#include "dspm/app/options/options.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/system/parallel.h"
#include "dspm/session/load.h"
#include "dspm/session/plan_parts.h"

namespace dspm {

std::string plan_of(const Options& options) {
  const auto begin = std::chrono::steady_clock::now();
  const ThreadLimit threads(options.threads);
  Messages messages(options.quiet);
  const LoadedScene loaded(options.scenes, options, messages);
  const std::chrono::duration<double> loading = std::chrono::steady_clock::now() - begin;
  return plan_parts(loaded, loading.count(), options.plan, messages);
}

}  // namespace dspm
