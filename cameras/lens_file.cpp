#include "dspm/cameras/lens_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace dspm {
namespace {

constexpr std::size_t kMostSurfaces = 200, kNumbersEach = 4;
constexpr float kLargest = 1e6f;  // mm

std::string_view after_blanks(std::string_view text) {
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size()));
    if (!text.starts_with('#')) return text;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

/// Takes a number off the front of the text.
float next_number(std::string_view& text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  float value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto used = static_cast<std::size_t>(end - text.data());
  const bool ends = used == text.size() || std::string_view(" \t\r\n\v\f#").find(text[used]) != std::string_view::npos;
  if (error != std::errc() || !ends || !(std::abs(value) <= kLargest))
    throw std::runtime_error(fmt::format("\"{}\" is no number that a lens has",
                                         text.substr(0, std::min<std::size_t>(text.find_first_of(" \t\r\n#"), 20))));
  text.remove_prefix(used);
  return value;
}

LensSurface surface_of(const float* numbers, std::size_t number) {
  const LensSurface surface{numbers[0] / 1000, numbers[1] / 1000, numbers[2], numbers[3] / 2000};
  if (!(surface.aperture > 0)) throw std::runtime_error(fmt::format("surface {} has no aperture", number));
  if (surface.thickness < 0 || surface.eta < 0)
    throw std::runtime_error(fmt::format("surface {} has a thickness or an index below 0", number));
  if (surface.eta > 10) throw std::runtime_error(fmt::format("surface {} has an index of {}", number, surface.eta));
  return surface;
}

}  // namespace

std::vector<LensSurface> parse_lens(std::string_view text) {
  std::vector<float> numbers;
  for (text = after_blanks(text); !text.empty(); text = after_blanks(text)) {
    numbers.push_back(next_number(text));
    if (numbers.size() > kNumbersEach * kMostSurfaces)
      throw std::runtime_error(fmt::format("it has more than {} surfaces", kMostSurfaces));
  }
  if (numbers.empty() || numbers.size() % kNumbersEach != 0)
    throw std::runtime_error(
        fmt::format("it has {} numbers, but a lens has four for each of its surfaces", numbers.size()));
  std::vector<LensSurface> surfaces;
  for (std::size_t i = 0; i < numbers.size(); i += kNumbersEach)
    surfaces.push_back(surface_of(numbers.data() + i, i / kNumbersEach + 1));
  return surfaces;
}

}  // namespace dspm
