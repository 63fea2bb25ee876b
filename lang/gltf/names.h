// Names for what a glTF file leaves nameless, or names twice.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <string_view>

namespace dspm::gltf {

class Names {
 public:
  /// Returns `wanted`, or `instead` if that is empty, with a number if it has been taken.
  std::string add(const std::string& wanted, const std::string& instead) {
    const std::string name = shortened(wanted.empty() ? instead : wanted);
    std::string unique = name;
    for (int i = 2; !taken_.insert(unique).second; ++i) unique = fmt::format("{} {}", name, i);
    return unique;
  }

 private:
  static std::string shortened(const std::string& name) {
    constexpr std::size_t kLongest = 60;  // bytes; names of images hold those of variations
    std::size_t end = std::min(name.size(), kLongest);
    while (end < name.size() && end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;
    return name.substr(0, end);
  }

  std::set<std::string> taken_;
};

/// Removes what a file's name cannot hold.
inline std::string for_file(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ' || std::string_view("/\\:*?\"<>|%#$").find(c) != std::string_view::npos)
      c = '_';
  return name;
}

/// Makes a name for a variation, which becomes a part of files' names; blanks are welcome there.
inline std::string for_variation(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ' || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos)
      c = '_';
  return name;
}

}  // namespace dspm::gltf
