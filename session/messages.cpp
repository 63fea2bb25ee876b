#include "dspm/session/messages.h"

#include "dspm/base/system/standard_streams.h"

namespace dspm {

void Messages::print(std::string_view text) const { print_message(text); }

void Messages::show(const Diagnostics& diagnostics) {
  for (const Diagnostic& each : diagnostics.all()) {
    if (each.severity == Severity::error || (each.severity == Severity::note && quiet_)) continue;
    const std::string text = to_string(each);
    if (shown_.insert(text).second) print(text);
  }
}

void Messages::warn(std::string message, std::string hint) {
  Diagnostics diagnostics;
  diagnostics.warning({}, std::move(message), std::move(hint));
  show(diagnostics);
}

}  // namespace dspm
