#include "dspm/base/system/inner_files.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <mutex>
#include <utility>

#include "dspm/base/system/files_read.h"

namespace dspm {
namespace {

struct Bytes {
  std::function<std::string()> now;
  std::function<std::string(double)> later = {};
};
using Shared = std::shared_ptr<const Bytes>;  // its address tells one offer from another

struct Offered {
  std::mutex mutex;
  std::map<std::string, Shared> files;  // by absolute path
};

Offered& offered() {
  static Offered all;
  return all;
}

std::string key_of(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::absolute(path, ignored).lexically_normal().string();
}

/// An inner file, and how many frames later.
struct Found {
  Shared bytes;
  std::optional<double> later = std::nullopt;
};

Found find(const std::filesystem::path& path) {
  Offered& all = offered();
  const std::lock_guard lock(all.mutex);
  if (all.files.empty()) return {};
  const std::string key = key_of(path);
  if (const auto found = all.files.find(key); found != all.files.end()) return {found->second};
  const std::size_t sign = key.rfind('@');
  if (sign == key.npos) return {};
  const auto found = all.files.find(key.substr(0, sign));
  double frames = 0;
  const char *const begin = key.data() + sign + 1, *const end = key.data() + key.size();
  const auto [stop, error] = std::from_chars(begin, end, frames);
  if (found == all.files.end() || !found->second->later || error != std::errc() || stop != end) return {};
  return {found->second, frames};
}

void offer(const std::string& key, Shared bytes) {
  Offered& all = offered();
  const std::lock_guard lock(all.mutex);
  all.files[key] = std::move(bytes);
}

}  // namespace

void offer_inner_file(const std::filesystem::path& path, std::function<std::string()> bytes,
                      std::function<std::string(double frames)> later) {
  offer(key_of(path), std::make_shared<const Bytes>(Bytes{std::move(bytes), std::move(later)}));
}

bool is_inner_file(const std::filesystem::path& path) { return find(path).bytes != nullptr; }

bool is_moving_file(const std::filesystem::path& path) {
  const Shared bytes = find(path).bytes;
  return bytes != nullptr && bytes->later != nullptr;
}

std::string name_later(const std::string& name, double frames) { return fmt::format("{}@{}", name, frames); }

std::optional<std::string> inner_file(const std::filesystem::path& path) {
  const auto [bytes, later] = find(path);
  if (bytes == nullptr) return std::nullopt;
  return later ? bytes->later(*later) : bytes->now();
}

struct FilesInMemory::Offer {
  std::string key;
  Shared bytes;
};

FilesInMemory::FilesInMemory(std::map<std::filesystem::path, std::string> files) {
  for (auto& [path, text] : files) {
    const std::string key = key_of(path);
    note_files_known({{key, digest(text)}});
    offers_.push_back({key, std::make_shared<const Bytes>(Bytes{[text = std::move(text)] { return text; }})});
    offer(key, offers_.back().bytes);
  }
}

FilesInMemory::~FilesInMemory() {
  Offered& all = offered();
  const std::lock_guard lock(all.mutex);
  for (const Offer& mine : offers_)
    if (const auto found = all.files.find(mine.key); found != all.files.end() && found->second == mine.bytes)
      all.files.erase(found);
}

}  // namespace dspm
