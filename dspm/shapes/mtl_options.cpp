#include "dspm/shapes/mtl_options.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace dspm {
namespace {

constexpr std::string_view kSpace = " \t\r";

bool is_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && stop == word.data() + word.size();
}

/// What a missing number is; null: not an option with three numbers.
const char* usual_number(std::string_view option) {
  return option == "-s" ? " 1" : option == "-o" || option == "-t" ? " 0" : nullptr;
}

std::string complete_line(std::string_view line) {
  std::string result;
  const char* usual = nullptr;
  int missing = 0;
  while (true) {
    const std::size_t begin = std::min(line.find_first_not_of(kSpace), line.size());
    const std::string_view space = line.substr(0, begin);
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(kSpace));
    if (missing > 0 && is_number(word))
      --missing;
    else
      for (; missing > 0; --missing) result += usual;
    result += space;
    if (word.empty()) return result;
    result += word;
    line.remove_prefix(word.size());
    if (usual_number(word) != nullptr) usual = usual_number(word), missing = 3;
  }
}

}  // namespace

std::string with_all_numbers(const std::string& mtl) {
  std::string result;
  for (std::string_view rest = mtl; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    const bool has_options = line.find(" -") != line.npos || line.find("\t-") != line.npos;
    result += has_options ? complete_line(line) : std::string(line);
    if (end == rest.npos) break;
    result += '\n';
    rest.remove_prefix(end + 1);
  }
  return result;
}

}  // namespace dspm
