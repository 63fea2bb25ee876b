// Files appear whole or not at all: output goes to a temporary file in the same directory, which replaces the target in
// one step at the end. A run that fails or is killed leaves an older file of that name untouched.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "dspm/base/system/sudden_end.h"

namespace dspm {

/// A file that cannot be written: what() names it and the cause.
class WriteError : public std::runtime_error {
 public:
  WriteError(const std::filesystem::path& file, std::string cause);
  /// Returns "No space left on device", and perhaps a way out.
  const std::string& cause() const { return cause_; }

 private:
  std::string cause_;
};

/// Throws WriteError on any error.
class AtomicFile {
 public:
  /// Begins a file. The directory must exist. The target may not be a directory, a device or write-protected; a
  /// symbolic link stays one.
  explicit AtomicFile(const std::filesystem::path& target);
  /// Leaves nothing without commit().
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Reserves room for this many bytes if the file system can: a full disk or a quota is an error now, not later.
  void reserve(std::uint64_t bytes);
  void write(std::string_view bytes);
  /// The name of the file until commit(), for another program to write.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes to the disk: some file systems report only then that they are full.
  void sync();
  /// Flushes to the disk and replaces the target.
  void commit();

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path shown_, target_, temporary_;
  int descriptor_ = -1;
  std::optional<Leftover> leftover_;
};

/// Follows symbolic links to the file that they mean, even if it does not exist yet.
std::filesystem::path file_behind(const std::filesystem::path& target);

/// Makes the folder, with those around it, if they are not there. Throws WriteError.
void make_folder(const std::filesystem::path& folder);

/// Writes a whole file at once.
void write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace dspm
