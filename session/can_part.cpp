#include "dspm/session/can_part.h"

#include <fmt/format.h>

#include "dspm/base/params/errors.h"
#include "dspm/base/system/readable.h"
#include "dspm/integrators/integrator.h"
#include "dspm/session/modules/all_plugins.h"

namespace dspm {

void expect_parts(const Job& job, const Integrator& integrator, const std::string& asked_by) {
  if (const std::string why = integrator.why_not_in_parts(); !why.empty())
    throw UsageError(
        fmt::format("{}: {} cannot be rendered in parts: {}", asked_by, in_words("integrator", job.integrator), why));
}

void expect_enough_iterations(int all, const Part& part, const std::string& asked_by) {
  if (all < part.of)
    throw UsageError(fmt::format("{}: {} cannot make so many parts; ask for fewer, or for more --iterations", asked_by,
                                 counted(static_cast<std::size_t>(all), "iteration")));
}

}  // namespace dspm
