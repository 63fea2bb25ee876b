#include "app/messages.h"

namespace dspm {

void Messages::show(const Diagnostics& diagnostics) {
  for (const Diagnostic& each : diagnostics.all()) {
    if (each.severity == Severity::error || (each.severity == Severity::note && quiet_)) continue;
    const std::string text = to_string(each);
    if (shown_.insert(text).second) print_message(text);
  }
}

}  // namespace dspm
