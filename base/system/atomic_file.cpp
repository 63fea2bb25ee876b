#include "dspm/base/system/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "dspm/base/system/file_access.h"

namespace dspm {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40;

/// Returns a name that differs between processes and between files of one process, so that none renames a file that
/// another is writing.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> files{0};
  fs::path name = target;
  name += ".part-" + std::to_string(getpid()) + "-" + std::to_string(files++);
  return name;
}

}  // namespace

fs::path file_behind(const fs::path& target) {
  std::error_code none;
  if (const fs::path real = fs::canonical(target, none); !none) return real;
  fs::path file = target;
  for (int links = 0; links < kMostLinks && fs::is_symlink(file, none); ++links)
    file = file.parent_path() / fs::read_symlink(file, none);
  return file;
}

WriteError::WriteError(const fs::path& file, std::string cause)
    : std::runtime_error("cannot write " + file.string() + ": " + cause), cause_(std::move(cause)) {}

AtomicFile::AtomicFile(const fs::path& target) : shown_(target), target_(file_behind(target)) {
  try {
    expect_allowed(target_);
  } catch (const std::runtime_error& error) {
    throw WriteError(shown_, error.what());
  }
  std::error_code ignored;
  const fs::path directory = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  if (!fs::is_directory(directory, ignored)) throw WriteError(shown_, "there is no directory " + directory.string());
  const bool exists = fs::exists(target_, ignored);
  if (exists && !fs::is_regular_file(target_, ignored)) throw WriteError(shown_, "it is not a regular file");
  // The file could still be replaced; but one that is write-protected is meant to be kept.
  if (exists && faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
  if (fs::is_symlink(target_, ignored)) fail(ELOOP);
  temporary_ = temporary_name(target_);
  leftover_.emplace(temporary_);  // first: another thread may end the program suddenly, and it would miss the file
  const LeftoverBegins begins;
  descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void AtomicFile::reserve(std::uint64_t bytes) {
  if (bytes == 0) return;
  // Not posix_fallocate, which writes byte by byte if the file system has no such function.
  int result = 0;
  do result = fallocate(descriptor_, 0, 0, static_cast<off_t>(bytes));
  while (result != 0 && errno == EINTR);
  if (result != 0 && errno != EOPNOTSUPP) fail(errno);
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) fail(errno);
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::sync() {
  if (fsync(descriptor_) != 0) fail(errno);
}

void AtomicFile::commit() {
  sync();
  if (close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void AtomicFile::fail(int error) const { throw WriteError(shown_, std::generic_category().message(error)); }

void make_folder(const fs::path& folder) try {
  expect_allowed(folder);
  fs::create_directories(folder);
} catch (const fs::filesystem_error& error) {
  throw WriteError(folder, error.code().message());
} catch (const std::runtime_error& error) {
  throw WriteError(folder, error.what());
}

void write_file(const fs::path& target, std::string_view bytes) {
  AtomicFile file(target);
  file.write(bytes);
  file.commit();
}

}  // namespace dspm
