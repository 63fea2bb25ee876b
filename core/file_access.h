// Which files the program may touch: all, or with `--sandbox` those in one directory. Whatever opens a file whose name
// comes from outside asks here first: read_bytes for all that is read, AtomicFile for all that is written, and the
// loader of modules.
#pragma once

#include <filesystem>

namespace dspm {

/// From here on, and until the process ends: links, `..` and absolute names lead nowhere else. Throws
/// std::runtime_error where there is no such directory.
void confine_files(const std::filesystem::path& directory);
bool files_are_confined();

/// Throws std::runtime_error with a sentence that does not name the file where it lies outside, links resolved.
void expect_allowed(const std::filesystem::path& file);

/// What lies outside seems to be there, and is refused when it is opened: nobody learns what else there is.
bool seems_to_exist(const std::filesystem::path& file);

}  // namespace dspm
