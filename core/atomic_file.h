// Files appear whole or not at all: what is written goes to a temporary name in the same directory, which takes the
// target's place in one step at the end. A run that fails or is killed leaves an older file of that name as it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/sudden_end.h"

namespace dspm {

/// A file that cannot be written: what() names it and the cause.
class WriteError : public std::runtime_error {
 public:
  WriteError(const std::filesystem::path& file, std::string cause);
  /// "No space left on device", and perhaps a way out.
  const std::string& cause() const { return cause_; }

 private:
  std::string cause_;
};

/// Errors are WriteErrors.
class AtomicFile {
 public:
  /// The directory must exist. The target may not be a directory, a device or write-protected; a symbolic link stays
  /// one.
  explicit AtomicFile(const std::filesystem::path& target);
  /// Without commit() nothing is left.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Room for as many bytes, where the file system can tell: a full disk or a quota is an error now, not later.
  void reserve(std::uint64_t bytes);
  void write(std::string_view bytes);
  /// The file until commit(), for another program that writes it.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Brings what was written to the disk: some learn only then that there is no room.
  void sync();
  /// Likewise everything, and puts it into the target's place.
  void commit();

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path shown_, target_, temporary_;
  int descriptor_ = -1;
  std::optional<Leftover> leftover_;
};

/// Links are followed: it is their file that is replaced, or made where there is none yet.
std::filesystem::path file_behind(const std::filesystem::path& target);

/// A whole file at once.
void write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace dspm
