#include "dspm/session/modules/module.h"

#include <fmt/format.h>

namespace dspm {

std::string_view ModuleRegistry::host_version() { return kVersion; }

void ModuleRegistry::refuse(std::string_view kind, std::string_view name, std::string_view other) const {
  const std::string owner = other.empty() ? "dspm itself" : std::string(other);
  const std::string way_out = other.empty() ? "give it another name" : "load only one of the two";
  throw ModuleError(fmt::format("{} already has the {} \"{}\": {}", owner, kind, name, way_out));
}

}  // namespace dspm
