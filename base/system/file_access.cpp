#include "dspm/base/system/file_access.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>

#include "dspm/base/system/inner_files.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> pipes_are_refused = false;

/// The root, canonical; empty if everything is allowed.
fs::path& root() {
  static fs::path path;
  return path;
}

/// Returns whether the name holds a zero byte: the system would cut it off there, and so take it for that of another
/// file.
bool holds_zero(const fs::path& file) { return file.native().find('\0') != std::string::npos; }

/// Returns whether the name climbs out of a folder that does not exist (yet): the meaning of such a name is known only
/// once the folder is made.
bool leaves_nothing(const fs::path& file) {
  fs::path so_far;
  bool missing = false;
  for (const fs::path& part : file) {
    if (missing && part == "..") return true;
    std::error_code ignored;
    missing = !fs::exists(so_far /= part, ignored);
  }
  return false;
}

bool is_allowed(const fs::path& file) {
  if (!files_are_confined()) return true;
  if (holds_zero(file) || leaves_nothing(file)) return false;
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(file, error), error);
  if (error) return false;
  return std::mismatch(root().begin(), root().end(), real.begin(), real.end()).first == root().end();
}

}  // namespace

void confine_files(const fs::path& directory) {
  std::error_code error;
  const fs::path real = fs::canonical(directory, error);
  if (error || !fs::is_directory(real, error))
    throw std::runtime_error(fmt::format("there is no directory {}", directory.string()));
  root() = real;
}

bool files_are_confined() { return !root().empty(); }

void refuse_pipes() { pipes_are_refused = true; }
bool may_read_pipes() { return !files_are_confined() && !pipes_are_refused; }

void expect_allowed(const fs::path& file) {
  if (holds_zero(file)) throw std::runtime_error("its name contains a zero byte");
  if (!is_allowed(file)) throw std::runtime_error(fmt::format("it lies outside the sandbox {}", root().string()));
}

bool seems_to_exist(const fs::path& file) {
  std::error_code ignored;
  return !is_allowed(file) || is_inner_file(file) || fs::exists(file, ignored);
}

}  // namespace dspm
