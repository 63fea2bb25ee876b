// Shortens what messages quote of a file's data, which may be a megabyte in one word.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

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

/// Names of a file for a message: some of them if they are many.
inline std::string names_in_words(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNames = 20, kMostOfName = 40;
  std::string text = names.empty() ? "none" : "";
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
    text += (i > 0 ? ", " : "") + excerpt(names[i], kMostOfName);
  return names.size() > kMostNames ? text + " and " + std::to_string(names.size() - kMostNames) + " more" : text;
}

}  // namespace dspm::gltf
