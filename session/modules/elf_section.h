// Sections of ELF files, the format of programs and shared libraries.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dspm {

/// Returns the bytes of that section; nullopt if the file has none. The file is only read, and none of its code runs.
/// Throws std::runtime_error with the reason if it cannot be read or is not a shared library for this kind of machine.
std::optional<std::string> elf_section(const std::filesystem::path& file, std::string_view name);

}  // namespace dspm
