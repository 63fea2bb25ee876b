#include "dspm/session/distinct_files.h"

#include <fmt/format.h>

#include <map>

#include "dspm/base/params/errors.h"
#include "dspm/base/system/atomic_file.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

fs::path place_of(const fs::path& file) { return fs::weakly_canonical(fs::absolute(file_behind(file))); }

}  // namespace

bool is_same_file(const fs::path& a, const fs::path& b) { return place_of(a) == place_of(b); }

void expect_distinct(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written) {
  std::map<fs::path, std::string> seen;
  for (const NamedFile& file : read) seen.emplace(place_of(file.path), file.what);
  for (const NamedFile& file : written) {
    const auto [other, is_new] = seen.emplace(place_of(file.path), file.what);
    if (!is_new)
      throw UsageError(fmt::format("{} would be both {} and {}", file.path.string(), other->second, file.what));
  }
}

}  // namespace dspm
