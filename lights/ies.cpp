#include "dspm/lights/ies.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace dspm {
namespace {

constexpr int kMostAngles = 10'000;
constexpr std::size_t kMostValues = 4'000'000;

/// The numbers after the line of TILT; commas count as blanks.
class Numbers {
 public:
  explicit Numbers(std::string_view rest) : rest_(rest) {}

  float next(const char* what) {
    const auto is_blank = [](char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); };
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
    if (rest_.starts_with('+')) rest_.remove_prefix(1);
    float value = 0;
    const auto [stop, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() || !std::isfinite(value))
      throw std::runtime_error(fmt::format("{}: expected {}, but found \"{}\"",
                                           rest_.empty() ? "it ends too early" : "it is damaged", what,
                                           rest_.substr(0, std::min<std::size_t>(rest_.find_first_of("\r\n"), 20))));
    rest_.remove_prefix(static_cast<std::size_t>(stop - rest_.data()));
    return value;
  }

  int count(const char* what) {
    const float value = next(what);
    if (!(value >= 1 && value <= float{kMostAngles}) || value != std::floor(value))
      throw std::runtime_error(fmt::format("{} {} are not a number from 1 to {}", value, what, kMostAngles));
    return static_cast<int>(value);
  }

  std::vector<float> list(std::size_t count, const char* what) {
    // As long as the text may hold them: a blank and a digit each.
    if (count > kMostValues || count > rest_.size() / 2 + 1)
      throw std::runtime_error(fmt::format("it ends too early: it says that {} {} follow", count, what));
    std::vector<float> values(count);
    for (float& value : values) value = next(what);
    return values;
  }

 private:
  std::string_view rest_;
};

/// The text after the line of TILT, and that line's value. Before it are labels and keywords, which say nothing of
/// light.
struct Body {
  std::string_view tilt, rest;
};

Body body_of(std::string_view text) {
  const std::string_view key = "TILT=";
  std::size_t at = text.starts_with(key) ? 0 : text.find("\nTILT=");
  if (at == text.npos) throw std::runtime_error("it has no line TILT=...");
  at = text.find(key, at) + key.size();
  const std::size_t end = std::min(text.find('\n', at), text.size());
  std::string_view tilt = text.substr(at, end - at);
  while (tilt.ends_with(' ') || tilt.ends_with('\r')) tilt.remove_suffix(1);
  return {tilt, text.substr(end)};
}

/// Skips factors for a lamp that is mounted at other angles than it was measured at: they are not used.
void skip_tilt(std::string_view tilt, Numbers& numbers) {
  if (tilt != "INCLUDE") return;
  numbers.next("the lamp's geometry");
  const auto count = static_cast<std::size_t>(numbers.count("tilt angles"));
  numbers.list(2 * count, "tilt angles and factors");
}

void check_ascending(const std::vector<float>& angles, const char* what) {
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (!(angles[i] > angles[i - 1])) throw std::runtime_error(fmt::format("its {} do not ascend", what));
}

void check_angles(const Photometry& p) {
  check_ascending(p.vertical, "vertical angles");
  check_ascending(p.horizontal, "horizontal angles");
  if (p.vertical.front() < 0 || p.vertical.back() > 180)
    throw std::runtime_error("its vertical angles must lie in 0..180 degrees");
  if (p.is_symmetric()) return;
  const float first = p.horizontal.front(), last = p.horizontal.back();
  const bool whole = first == 0 && (last == 90 || last >= 180);
  if (!(whole && last <= 360) && !(first == 90 && last == 270))
    throw std::runtime_error(
        fmt::format("its horizontal angles reach from {} to {}, but must from 0 to 90, 180 or 360, or from 90 to 270",
                    first, last));
}

/// The entries between which x lies, and how far; x must be within them.
struct Between {
  std::size_t index;
  float rest;
};

Between between(const std::vector<float>& angles, float x) {
  if (angles.size() == 1) return {0, 0};
  const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, x);
  const auto index = static_cast<std::size_t>(above - angles.begin()) - 1;
  return {index, std::clamp((x - angles[index]) / (angles[index + 1] - angles[index]), 0.f, 1.f)};
}

/// Returns the angle in 0..360 at which the same was measured.
float mirrored(const std::vector<float>& horizontal, float around) {
  const float last = horizontal.back();
  if (last == 90 && around > 180) around = 360 - around;
  if (last == 90 && around > 90) around = 180 - around;
  if (last == 180 && around > 180) around = 360 - around;
  if (horizontal.front() == 90 && around < 90) around = 180 - around;
  if (horizontal.front() == 90 && around > 270) around = 540 - around;
  return around;
}

}  // namespace

bool is_ies(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // a byte order mark
  const std::string_view head = bytes.substr(0, 20'000);
  return head.starts_with("IESNA") || head.starts_with("IES:") || head.starts_with("TILT=") ||
         head.find("\nTILT=") != head.npos || head.find("\rTILT=") != head.npos;
}

Photometry parse_ies(std::string_view text) {
  const Body body = body_of(text);
  Numbers numbers(body.rest);
  skip_tilt(body.tilt, numbers);
  numbers.next("the number of lamps"), numbers.next("the lumens of a lamp");
  float factor = numbers.next("the multiplier of candelas");
  Photometry p;
  const auto n = static_cast<std::size_t>(numbers.count("vertical angles"));
  const auto m = static_cast<std::size_t>(numbers.count("horizontal angles"));
  if (numbers.next("the type of photometry") != 1)
    throw std::runtime_error("its photometry is of type A or B, but dspm reads type C");
  for (const char* what : {"the unit", "the width", "the length", "the height"}) numbers.next(what);
  factor *= numbers.next("the ballast factor");
  factor *= numbers.next("the ballast-lamp factor");
  numbers.next("the input watts");
  p.vertical = numbers.list(n, "vertical angles");
  p.horizontal = numbers.list(m, "horizontal angles");
  check_angles(p);
  p.candela = numbers.list(n * m, "candelas");
  for (float& value : p.candela) {
    value *= factor;
    if (!(value >= 0) || !std::isfinite(value)) throw std::runtime_error("its candelas must not be negative");
  }
  return p;
}

float Photometry::intensity(float from_down, float around) const {
  if (from_down < vertical.front() || from_down > vertical.back()) return 0;
  const Between v = between(vertical, from_down);
  // A file that ends before 360 goes on to its first plane.
  around = mirrored(horizontal, around);
  Between h = between(horizontal, around);
  std::size_t next = is_symmetric() ? 0 : h.index + 1;
  if (around > horizontal.back() && !is_symmetric()) {
    h = {horizontal.size() - 1, (around - horizontal.back()) / (360 - horizontal.back())};
    next = 0;
  }
  const auto plane = [&](std::size_t index) {
    const float* values = candela.data() + index * vertical.size() + v.index;
    return v.rest > 0 ? std::lerp(values[0], values[1], v.rest) : values[0];
  };
  return std::lerp(plane(h.index), plane(next), h.rest);
}

}  // namespace dspm
