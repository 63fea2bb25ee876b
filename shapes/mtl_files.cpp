#include "dspm/shapes/mtl_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>
#include <vector>

#include "dspm/base/system/plain_text.h"
#include "dspm/shapes/obj_statements.h"

namespace dspm {
namespace {

bool ends_name(std::string_view word) {
  if (word.size() < 4) return false;
  std::string ending(word.substr(word.size() - 4));
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".mtl";
}

}  // namespace

void MtlFiles::read_named(std::string_view names) {
  constexpr std::size_t kMostWords = 16;
  std::vector<std::string_view> words;
  for (std::string_view word = next_word(names); !word.empty(); word = next_word(names)) words.push_back(word);
  const auto name = [&](std::size_t first, std::size_t end) {
    const char* const begin = words[first].data();
    return std::string_view(begin, static_cast<std::size_t>(words[end - 1].data() + words[end - 1].size() - begin));
  };
  for (std::size_t first = 0; first < words.size();) {
    std::size_t end = std::min(words.size(), first + kMostWords);
    while (end > first && !read(name(first, end))) --end;
    if (end == first && words[first].starts_with('#')) return;
    if (end == first) {
      while (end < words.size() && !ends_name(words[end])) ++end;
      end = std::min(end + 1, words.size());
      if (!read(without_folders(name(first, end))))
        out_.complaints.push_back(fmt::format("there is no material file \"{}\"", name(first, end)));
    }
    first = end;
  }
}

/// Returns false if there is no such file.
bool MtlFiles::read(std::string_view name) {
  for (const std::string& spelling : spellings_of(name)) {
    if (read_.contains(spelling)) return true;
    const std::optional<std::string> text = companion_(spelling);  // an error if it may not be read
    if (!text) continue;
    read_.insert(spelling);
    try {
      for (FileMaterial& material : read_mtl(plain_text(*text), directory_ / spelling, out_.complaints, left_out_))
        out_.materials.push_back(std::move(material));
    } catch (const std::runtime_error& error) {
      out_.complaints.push_back(fmt::format("the material file \"{}\" cannot be read: {}", spelling, error.what()));
    }
    return true;
  }
  return false;
}

void MtlFiles::complain_of_what_is_left_out() {
  for (std::string& sentence : in_words(left_out_)) out_.complaints.push_back(std::move(sentence));
}

}  // namespace dspm
