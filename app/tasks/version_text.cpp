#include "dspm/app/tasks/version_text.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "dspm/accel/embree_version.h"
#include "dspm/app/tasks/optional_parts.h"
#include "dspm/base/system/version.h"

namespace dspm {
namespace {

#ifdef __clang__
constexpr std::string_view kCompiler = "clang++ " __clang_version__;
#else
constexpr std::string_view kCompiler = "g++ " __VERSION__;
#endif

}  // namespace

std::string build_in_words() {
  constexpr std::string_view kFlags = DSPM_BUILD_FLAGS;
  return fmt::format("{}, {}{}{}", kCompiler, DSPM_BUILD_TYPE, kFlags.empty() ? "" : " with ", kFlags);
}

std::string version_text() {
  std::vector<std::string> has, lacks;
  for (const OptionalPart& part : built_parts()) (part.is_built ? has : lacks).push_back(part.name);
  std::string text = fmt::format("dspm {}\nbuilt by: {}\nEmbree: {}\n", kVersion, build_in_words(), embree_version());
  if (!has.empty()) text += fmt::format("with: {}\n", fmt::join(has, ", "));
  if (!lacks.empty()) text += fmt::format("without: {} (dspm --doctor says what brings it)\n", fmt::join(lacks, ", "));
  return text;
}

}  // namespace dspm
