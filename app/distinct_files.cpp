#include "app/distinct_files.h"

#include <fmt/format.h>

#include <map>

#include "app/options.h"
#include "core/atomic_file.h"

namespace dspm {

void expect_distinct(const std::vector<NamedFile>& files) {
  std::map<std::filesystem::path, std::string> seen;
  for (const NamedFile& file : files) {
    const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(file_behind(file.path)));
    const auto [other, is_new] = seen.emplace(place, file.what);
    if (!is_new)
      throw UsageError(fmt::format("{} would be both {} and {}", file.path.string(), other->second, file.what));
  }
}

}  // namespace dspm
