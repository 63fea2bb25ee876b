#include "dspm/output/trial_writes.h"

#include <fmt/format.h>

#include <set>
#include <string>

#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/readable.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

// One block: empty files can be made on a full disk.
const std::string kTrial(4096, '\0');

fs::path directory_of(const fs::path& file) {
  const fs::path behind = file_behind(file);
  return behind.has_parent_path() ? behind.parent_path() : fs::path(".");
}

}  // namespace

void try_writes(const std::vector<fs::path>& files) {
  std::set<fs::path> directories;
  for (const fs::path& file : files) {
    AtomicFile trial(file);
    if (!directories.insert(directory_of(file)).second) continue;
    trial.write(kTrial);
    trial.sync();
  }
}

void warn_of_little_space(const fs::path& file, std::uint64_t bytes, const std::string& what, Messages& messages) {
  const fs::path directory = directory_of(file);
  std::error_code unknown;
  const std::uint64_t free = fs::space(directory, unknown).available;
  if (unknown || free >= bytes) return;
  messages.warn(fmt::format("{} may take {}, but only {} are left in {}", what, readable_bytes(bytes),
                            readable_bytes(free), fs::absolute(directory, unknown).lexically_normal().string()),
                "images that do not fit are not written; make room, or write elsewhere with --outfile");
}

}  // namespace dspm
