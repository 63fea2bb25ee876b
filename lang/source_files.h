// The files of a scene: each is read once, found next to the file that names it, and bounded in how often it returns.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dspm/base/params/errors.h"

namespace dspm {

/// Returns the file's identity, which two names of the same file share.
std::string identity_of(const std::filesystem::path& path);

class SourceFiles {
 public:
  explicit SourceFiles(std::string main_name) : main_name_(std::move(main_name)) {}

  const std::string& main_name() const { return main_name_; }
  /// Reads a file; "-" is standard input. Throws std::runtime_error.
  const SourceFile& load(const std::string& path);
  /// Takes a text in memory as if it were that file's. Throws std::runtime_error if it is not plain text.
  void put(const std::string& path, std::string text);
  /// Returns the path of a file: next to the file that names it, else next to the main file.
  std::filesystem::path find(const std::string& name, const SourceFile& file) const;
  /// Returns the bytes that were loaded again, if they are too many for the bytes that were read; otherwise 0.
  std::size_t excessive_repeats() const;
  /// Lets all files be read once more.
  void start_again();

  /// Returns the files in the order in which they were loaded.
  std::vector<std::shared_ptr<const SourceFile>> take() { return std::move(files_); }
  const std::vector<std::shared_ptr<const SourceFile>>& all() const { return files_; }

 private:
  struct Loaded {
    const SourceFile* file = nullptr;
    bool is_read = false;  // since the start
  };

  std::string main_name_;
  std::vector<std::shared_ptr<const SourceFile>> files_;
  std::map<std::string, Loaded> loaded_;      // by identity
  std::size_t read_once_ = 0, repeated_ = 0;  // bytes
};

}  // namespace dspm
