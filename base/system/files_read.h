// The files read since the program began, and digests of their contents. A checkpoint uses them to detect changes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

namespace dspm {

/// Detects accidental differences; not safe against deliberate ones.
std::uint64_t digest(std::string_view bytes);

/// Records that a file was read. The first read of each file counts. Thread-safe.
void note_file_read(const std::filesystem::path& path, std::string_view bytes);
/// Records that a file within another, already recorded file was read, or one that has no path. Thread-safe.
void note_inner_file_read();

/// Records what this thread reads while the object exists. If there are several, only the latest one records.
class FilesReadHere {
 public:
  FilesReadHere();
  ~FilesReadHere();
  FilesReadHere(const FilesReadHere&) = delete;
  FilesReadHere& operator=(const FilesReadHere&) = delete;

  /// Digests by canonical path; nullopt if a file without a path was read.
  const std::optional<std::map<std::filesystem::path, std::uint64_t>>& files() const { return files_; }

 private:
  friend void note_file_read(const std::filesystem::path&, std::string_view);
  friend void note_inner_file_read();

  std::optional<std::map<std::filesystem::path, std::uint64_t>> files_;
  FilesReadHere* const around_;
};

/// Counts these files as read without reading them. The digests are by canonical path.
void note_files_known(const std::map<std::filesystem::path, std::uint64_t>& files);

/// Forgets all reads: from here on, the next read of each file counts.
void forget_files_read();

/// The digest of each file, by its canonical path.
std::map<std::filesystem::path, std::uint64_t> files_read();

}  // namespace dspm
