// Sections of ELF files, the format of programs and shared libraries.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dspm {

/// The bytes of that section, or nothing if the file has none. The file is only read, none of its code runs. Throws
/// std::runtime_error with the reason if it cannot be read or is not a shared library for this kind of machine.
std::optional<std::string> elf_section(const std::filesystem::path& file, std::string_view name);

}  // namespace dspm
