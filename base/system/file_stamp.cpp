#include "dspm/base/system/file_stamp.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>

namespace dspm {
namespace {

std::int64_t in_nanoseconds(const timespec& time) { return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec; }

}  // namespace

FileStamp stamp_of(const std::filesystem::path& file) {
  struct stat status = {};
  if (stat(file.c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_size, in_nanoseconds(status.st_mtim), in_nanoseconds(status.st_ctim)};
}

bool may_be_newer(const FileStamp& stamp, std::chrono::system_clock::time_point begin) {
  using namespace std::chrono;
  constexpr nanoseconds kCoarsest = seconds(2);  // FAT's
  const nanoseconds since = duration_cast<nanoseconds>(begin.time_since_epoch()) - kCoarsest;
  return std::max(stamp.modified, stamp.changed) >= since.count();
}

}  // namespace dspm
