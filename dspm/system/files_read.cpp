#include "dspm/system/files_read.h"

#include <zlib.h>

#include <algorithm>
#include <mutex>

namespace dspm {
namespace {

std::mutex mutex;
std::map<std::filesystem::path, std::uint64_t>& all() {
  static std::map<std::filesystem::path, std::uint64_t> files;
  return files;
}

}  // namespace

std::uint64_t digest(std::string_view bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  const auto checksum = static_cast<std::uint64_t>(crc32_z(0, data, bytes.size()));
  return static_cast<std::uint64_t>(bytes.size()) << 32 | checksum;
}

void note_file_read(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(path, error);
  if (error) return;  // a pipe, or gone already
  const std::uint64_t read = digest(bytes);
  const std::lock_guard lock(mutex);
  all().emplace(real, read);
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
