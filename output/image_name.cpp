#include "dspm/output/image_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace dspm {

namespace {

struct NumberPlace {
  std::size_t begin, length, digits;
};

/// Finds "%d", "%4d" or "%04d".
std::optional<NumberPlace> find_percent(const std::string& name) {
  for (std::size_t begin = name.find('%'); begin != std::string::npos; begin = name.find('%', begin + 1)) {
    const std::size_t end = name.find_first_not_of("0123456789", begin + 1);
    const std::size_t digits = end == std::string::npos ? 0 : end - begin - 1;
    if (digits > 2 || end == std::string::npos || name[end] != 'd') continue;
    return NumberPlace{begin, digits + 2, digits == 0 ? 0 : std::stoul(name.substr(begin + 1, digits))};
  }
  return std::nullopt;
}

std::optional<NumberPlace> find_hashes(const std::string& name) {
  const std::size_t begin = name.find("##");
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
  return NumberPlace{begin, end - begin, end - begin};
}

}  // namespace

std::filesystem::path image_name(const std::filesystem::path& pattern, std::optional<Moment> moment,
                                 std::string_view label) {
  std::string name = pattern.filename().string();
  const std::size_t stem = pattern.stem().string().size();
  std::optional<NumberPlace> place = find_percent(name);
  if (!place) place = find_hashes(name);
  if (!place && moment) place = find_hashes(name.insert(stem, ".####"));

  if (!place) {
    if (!label.empty()) name.insert(stem, fmt::format(".{}", label));
    return pattern.parent_path() / name;
  }
  name = fmt::format("{}{}{}{:0{}}{}", name.substr(0, place->begin), label, label.empty() ? "" : ".",
                     moment.value_or(Moment()).number(), place->digits, name.substr(place->begin + place->length));
  return pattern.parent_path() / name;
}

}  // namespace dspm
