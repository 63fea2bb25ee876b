// Decides which files the program may touch: all, or with `--sandbox` those in one directory. All code that opens a
// file whose name comes from outside checks here first: read_bytes for reading, AtomicFile for writing, and the module
// loader.
#pragma once

#include <filesystem>

namespace dspm {

/// Confines files until the process ends: links, `..` and absolute names cannot lead outside. Throws std::runtime_error
/// if there is no such directory.
void confine_files(const std::filesystem::path& directory);
bool files_are_confined();

/// Reads only regular files from now on, for programs that read a file again: a pipe in its place would keep them
/// waiting for its other end.
void refuse_pipes();
/// Returns whether pipes and devices may be read, as `dspm <(make-scene)` wants it.
bool may_read_pipes();

/// Throws std::runtime_error if the file, with links resolved, lies outside. The message does not name the file.
void expect_allowed(const std::filesystem::path& file);

/// Returns whether the file exists. Files outside always seem to, and are refused when opened: so a scene cannot find
/// out which ones do exist.
bool seems_to_exist(const std::filesystem::path& file);

}  // namespace dspm
