// Sections of ELF files, the format of programs and shared libraries.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dspm {

/// The bytes of that section, or nothing where the file has none; the file is only read, nothing of it runs. Throws
/// std::runtime_error with the reason where it cannot be read or is no shared library for this kind of machine.
std::optional<std::string> elf_section(const std::filesystem::path& file, std::string_view name);

}  // namespace dspm
