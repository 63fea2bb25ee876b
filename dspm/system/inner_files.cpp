#include "dspm/system/inner_files.h"

#include <map>
#include <mutex>
#include <utility>

namespace dspm {
namespace {

using Bytes = std::function<std::string()>;

struct Offered {
  std::mutex mutex;
  std::map<std::string, Bytes> files;  // by absolute path
};

Offered& offered() {
  static Offered all;
  return all;
}

std::string key_of(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::absolute(path, ignored).lexically_normal().string();
}

Bytes find(const std::filesystem::path& path) {
  Offered& all = offered();
  const std::lock_guard lock(all.mutex);
  if (all.files.empty()) return {};
  const auto found = all.files.find(key_of(path));
  return found == all.files.end() ? Bytes() : found->second;
}

}  // namespace

void offer_inner_file(const std::filesystem::path& path, Bytes bytes) {
  Offered& all = offered();
  const std::lock_guard lock(all.mutex);
  all.files[key_of(path)] = std::move(bytes);
}

bool is_inner_file(const std::filesystem::path& path) { return find(path) != nullptr; }

std::optional<std::string> inner_file(const std::filesystem::path& path) {
  const Bytes bytes = find(path);
  return bytes ? std::optional(bytes()) : std::nullopt;
}

}  // namespace dspm
