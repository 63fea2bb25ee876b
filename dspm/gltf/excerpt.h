// What messages quote of a file's data, which may be a megabyte in one word.
#pragma once

#include <string>
#include <string_view>

namespace dspm::gltf {

/// Returns at most a line of it, without control characters.
inline std::string excerpt(std::string_view text, std::size_t most = 100) {
  const bool is_cut = text.size() > most;
  if (is_cut) {
    std::size_t end = most - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // whole characters of UTF-8
    text = text.substr(0, end);
  }
  std::string line(text);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  return is_cut ? line + "..." : line;
}

}  // namespace dspm::gltf
