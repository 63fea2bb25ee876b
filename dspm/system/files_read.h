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

/// Thread-safe. The first read of a file counts.
void note_file_read(const std::filesystem::path& path, std::string_view bytes);
/// Likewise, of a file within another, which was noted; or of one that has no path.
void note_inner_file_read();

/// What this thread reads as long as it lives. The latest counts.
class FilesReadHere {
 public:
  FilesReadHere();
  ~FilesReadHere();
  FilesReadHere(const FilesReadHere&) = delete;
  FilesReadHere& operator=(const FilesReadHere&) = delete;

  /// By canonical path; nothing if there were files without one.
  const std::optional<std::map<std::filesystem::path, std::uint64_t>>& files() const { return files_; }

 private:
  friend void note_file_read(const std::filesystem::path&, std::string_view);
  friend void note_inner_file_read();

  std::optional<std::map<std::filesystem::path, std::uint64_t>> files_;
  FilesReadHere* const around_;
};

/// They count as read, although nobody did. Digests by canonical path.
void note_files_known(const std::map<std::filesystem::path, std::uint64_t>& files);

/// From here on, the next read of each file counts.
void forget_files_read();

/// The digest of each file, by its canonical path.
std::map<std::filesystem::path, std::uint64_t> files_read();

}  // namespace dspm
