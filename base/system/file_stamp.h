// A stamp changes when a file is saved.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>

namespace dspm {

struct FileStamp {
  std::uint64_t number = 0;                          // of the file
  std::int64_t size = 0, modified = 0, changed = 0;  // bytes; nanoseconds, of the contents and of anything
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
using FileStamps = std::map<std::filesystem::path, FileStamp>;

/// Returns all zeros if there is no such file.
FileStamp stamp_of(const std::filesystem::path& file);
/// Returns whether what was read from `begin` on, before the stamp was taken, may differ from what the stamp stands
/// for: by the coarsest clock of a file system, it was saved since.
bool may_be_newer(const FileStamp& stamp, std::chrono::system_clock::time_point begin);

}  // namespace dspm
