#include "dspm/looking/serve/requests.h"

#include <charconv>
#include <cmath>

#include "dspm/base/math/transform.h"

namespace dspm {
namespace {

constexpr int kMostFrames = 1 << 20, kMostHalvings = 16;
constexpr std::size_t kLongestName = 64;

/// Cuts the text off up to `end`, which goes as well.
std::string_view take_until(std::string_view& text, char end) {
  const std::size_t length = std::min(text.find(end), text.size());
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return word;
}

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

std::optional<Gallery::Seen> parse_wish(std::string_view line) {
  const auto frame = parse_count(take_until(line, ' '), 0, kMostFrames);
  const std::string_view output = take_until(line, ' ');
  const auto halvings = parse_count(take_until(line, ' '), 0, kMostHalvings);
  const auto version = parse_number<std::uint64_t>(take_until(line, ' '));
  const auto other = parse_number<std::uint64_t>(line);
  if (!frame || !halvings || !version || !other || output.empty() || output.size() > kLongestName) return {};
  return Gallery::Seen{{*frame, std::string(output), *halvings}, *version, *other};
}

}  // namespace

std::optional<int> parse_count(std::string_view text, int lowest, int highest) {
  const std::optional<int> count = parse_number<int>(text);
  return count && *count >= lowest && *count <= highest ? count : std::nullopt;
}

std::optional<std::array<double, 9>> parse_look_at(std::string_view text) {
  constexpr double kFarthest = 1e12;
  std::array<double, 9> v{};
  for (double& number : v) {
    const auto parsed = parse_number<double>(take_until(text, ' '));
    if (!parsed || !(std::abs(*parsed) < kFarthest)) return {};
    number = *parsed;
  }
  const bool spans = Matrix4::look_at({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}).has_value();
  return text.empty() && spans ? std::optional(v) : std::nullopt;
}

std::optional<Gallery::Request> parse_wishes(std::string_view text) {
  Gallery::Request request;
  const auto viewer = parse_number<std::uint64_t>(take_until(text, '\n'));
  if (!viewer) return {};
  request.viewer = *viewer;
  while (!text.empty()) {
    const auto wish = parse_wish(take_until(text, '\n'));
    if (!wish || request.seen.size() == kMostWishes) return {};
    request.seen.push_back(*wish);
  }
  return request;
}

}  // namespace dspm
