// Files appear whole or not at all: what is written goes to a temporary name in the same directory, which takes the
// target's place in one step at the end. A run that fails or is killed leaves an older file of that name as it was.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/sudden_end.h"

namespace dspm {

/// Errors are std::runtime_error and name the target and the cause.
class AtomicFile {
 public:
  /// The directory must exist. The target may not be a directory or a device; a symbolic link stays one.
  explicit AtomicFile(const std::filesystem::path& target);
  /// Without commit() nothing is left.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  /// The file until commit(), for another program that writes it.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Brings everything to the disk and puts it into the target's place.
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
