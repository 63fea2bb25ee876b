#include "dspm/lang/source_files.h"

#include "dspm/base/system/file_access.h"
#include "dspm/base/system/plain_text.h"
#include "dspm/base/system/read_file.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

// Text may be read again up to this size, or up to this many times the size of all text read once. Otherwise a megabyte
// included often would fill the memory.
constexpr std::size_t kMostRepeated = std::size_t{2} << 20, kMostRepeats = 4;

}  // namespace

std::string identity_of(const fs::path& path) {
  if (path == "-") return "-";
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return (error ? path : canonical).string();
}

const SourceFile& SourceFiles::load(const std::string& path) {
  const std::string id = identity_of(path);
  if (!loaded_.contains(id)) put(path, path == "-" ? read_input(path) : read_file(path));
  Loaded& loaded = loaded_[id];
  (loaded.is_read ? repeated_ : read_once_) += loaded.file->text.size();
  loaded.is_read = true;
  return *loaded.file;
}

void SourceFiles::put(const std::string& path, std::string text) {
  files_.push_back(std::make_shared<const SourceFile>(
      SourceFile{path == "-" ? "standard input" : path, plain_text(std::move(text))}));
  loaded_[identity_of(path)].file = files_.back().get();
}

fs::path SourceFiles::find(const std::string& name, const SourceFile& file) const {
  const fs::path beside = fs::path(file.name).parent_path() / name;
  const fs::path beside_main = fs::path(main_name_).parent_path() / name;
  const bool is_beside_main = !seems_to_exist(beside) && seems_to_exist(beside_main);
  return (is_beside_main ? beside_main : beside).lexically_normal();
}

std::size_t SourceFiles::excessive_repeats() const {
  return repeated_ > kMostRepeated && repeated_ / kMostRepeats > read_once_ ? repeated_ : 0;
}

void SourceFiles::start_again() {
  read_once_ = repeated_ = 0;
  for (auto& [id, loaded] : loaded_) loaded.is_read = false;
}

}  // namespace dspm
