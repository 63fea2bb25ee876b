#include "dspm/base/system/files_read.h"

#include <zlib.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace dspm {
namespace {

std::mutex mutex;
std::map<std::filesystem::path, std::uint64_t>& all() {
  static std::map<std::filesystem::path, std::uint64_t> files;
  return files;
}

thread_local FilesReadHere* reading_here = nullptr;

}  // namespace

FilesReadHere::FilesReadHere() : files_(std::in_place), around_(std::exchange(reading_here, this)) {}
FilesReadHere::~FilesReadHere() { reading_here = around_; }

std::uint64_t digest(std::string_view bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  const auto checksum = static_cast<std::uint64_t>(crc32_z(0, data, bytes.size()));
  return static_cast<std::uint64_t>(bytes.size()) << 32 | checksum;
}

void note_file_read(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(path, error);
  if (error) return note_inner_file_read();  // a pipe, or gone already
  const std::uint64_t read = digest(bytes);
  if (reading_here != nullptr && reading_here->files_) reading_here->files_->emplace(real, read);
  const std::lock_guard lock(mutex);
  all().emplace(real, read);
}

void note_inner_file_read() {
  if (reading_here != nullptr) reading_here->files_.reset();
}

void note_files_known(const std::map<std::filesystem::path, std::uint64_t>& files) {
  const std::lock_guard lock(mutex);
  all().insert(files.begin(), files.end());
}

void forget_files_read() {
  const std::lock_guard lock(mutex);
  all().clear();
}

std::map<std::filesystem::path, std::uint64_t> files_read() {
  const std::lock_guard lock(mutex);
  return all();
}

}  // namespace dspm
