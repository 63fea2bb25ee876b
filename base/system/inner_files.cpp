#include "dspm/base/system/inner_files.h"

#include <map>
#include <mutex>
#include <utility>

#include "dspm/base/system/files_read.h"

namespace dspm {
namespace {

using Bytes = std::function<std::string()>;
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

Shared find(const std::filesystem::path& path) {
  Offered& all = offered();
  const std::lock_guard lock(all.mutex);
  if (all.files.empty()) return {};
  const auto found = all.files.find(key_of(path));
  return found == all.files.end() ? nullptr : found->second;
}

void offer(const std::string& key, Shared bytes) {
  Offered& all = offered();
  const std::lock_guard lock(all.mutex);
  all.files[key] = std::move(bytes);
}

}  // namespace

void offer_inner_file(const std::filesystem::path& path, Bytes bytes) {
  offer(key_of(path), std::make_shared<const Bytes>(std::move(bytes)));
}

bool is_inner_file(const std::filesystem::path& path) { return find(path) != nullptr; }

std::optional<std::string> inner_file(const std::filesystem::path& path) {
  const Shared bytes = find(path);
  return bytes ? std::optional((*bytes)()) : std::nullopt;
}

struct FilesInMemory::Offer {
  std::string key;
  Shared bytes;
};

FilesInMemory::FilesInMemory(std::map<std::filesystem::path, std::string> files) {
  for (auto& [path, text] : files) {
    const std::string key = key_of(path);
    note_files_known({{key, digest(text)}});
    offers_.push_back({key, std::make_shared<const Bytes>([text = std::move(text)] { return text; })});
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
