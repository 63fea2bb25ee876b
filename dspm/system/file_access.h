// Which files the program may touch: all, or with `--sandbox` those in one directory. All code that opens a file whose
// name comes from outside checks here first: read_bytes for reading, AtomicFile for writing, and the module loader.
#pragma once

#include <filesystem>

namespace dspm {

/// Holds until the process ends: links, `..` and absolute names cannot lead outside. Throws std::runtime_error if there
/// is no such directory.
void confine_files(const std::filesystem::path& directory);
bool files_are_confined();

/// Throws std::runtime_error if the file, with links resolved, lies outside. The message does not name the file.
void expect_allowed(const std::filesystem::path& file);

/// Files outside always seem to exist, and are refused when opened: so a scene cannot find out which ones do exist.
bool seems_to_exist(const std::filesystem::path& file);

}  // namespace dspm
