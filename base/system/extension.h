// The kind of file that a name stands for: programs of other systems write OUT.EXR.
#pragma once

#include <cctype>
#include <filesystem>
#include <string>

namespace dspm {

/// Returns the ending of the name in lower case, with its point: ".exr".
inline std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace dspm
