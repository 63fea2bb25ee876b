#include "dspm/app/options/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

constexpr int kMaxFrameNumber = 1'000'000;

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == text.npos) return parts;
    begin = end + 1;
  }
}

/// Reads four numbers between commas.
template <class Number>
std::optional<std::array<Number, 4>> four(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ',');
  std::array<Number, 4> values{};
  if (parts.size() != values.size()) return std::nullopt;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<Number> value = number<Number>(parts[i]);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return values;
}

double seconds_of(char unit) {
  switch (unit) {
    case 's': return 1;
    case 'm': return 60;
    case 'h': return 3600;
    default: return 0;
  }
}

/// Returns 1 for "" and "B", 1e9 for "G" and "GB", 2^30 for "Gi" and "GiB", in any letter case; otherwise 0.
double bytes_of(std::string_view unit) {
  if (!unit.empty() && (unit.back() == 'B' || unit.back() == 'b')) unit.remove_suffix(1);
  if (unit.empty()) return 1;
  const std::size_t power = std::string_view("KMGT").find(static_cast<char>(std::toupper(unit.front())));
  const bool binary = unit.size() == 2 && (unit[1] == 'i' || unit[1] == 'I');
  if (power == std::string_view::npos || (unit.size() > 1 && !binary)) return 0;
  return std::pow(binary ? 1024. : 1000., static_cast<double>(power) + 1);
}

/// Frames of the file: "12", "1-8" or "1-32:4".
struct FrameRange {
  int first, last, step;
};

std::optional<FrameRange> frame_range(std::string_view text) {
  const std::size_t dash = text.find('-'), colon = dash == text.npos ? dash : text.find(':', dash);
  const auto first = number<int>(text.substr(0, dash));
  const auto last = dash == text.npos ? first : number<int>(text.substr(dash + 1, colon - dash - 1));
  const auto step = colon == text.npos ? 1 : number<int>(text.substr(colon + 1));
  if (!first || !last || !step || *first < 0 || *last < *first || *last > kMaxFrameNumber || *step < 1)
    return std::nullopt;
  return FrameRange{*first, *last, *step};
}

/// Turns `-Seed=3` into `seed`, for comparison.
std::string plain_name(std::string_view argument) {
  std::string name;
  for (const char c : argument.substr(0, argument.find('=')))
    if (c != '-' && c != '_') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

}  // namespace

std::vector<Moment> parse_frames(std::string_view text) {
  std::vector<bool> wanted;  // a flag per frame: a list would grow with each repeated range
  for (const std::string_view part : split(text, ',')) {
    const auto range = frame_range(part);
    if (!range) throw UsageError(fmt::format("--frames {}: expected frames, such as 1-8,12 or 1-32:4", text));
    wanted.resize(std::max(wanted.size(), static_cast<std::size_t>(range->last) + 1));
    for (std::int64_t frame = range->first; frame <= range->last; frame += range->step)
      wanted[static_cast<std::size_t>(frame)] = true;
  }
  std::vector<Moment> moments;
  for (std::size_t frame = 0; frame < wanted.size(); ++frame)
    if (wanted[frame]) moments.push_back(Moment::numbered(static_cast<int>(frame)));
  return moments;
}

std::vector<std::string> parse_names(const char* option, std::string_view text) {
  std::vector<std::string> names;
  for (const std::string_view name : split(text, ',')) names.emplace_back(name);
  if (std::find(names.begin(), names.end(), "") != names.end())
    throw UsageError(fmt::format("{} {}: expected names with commas between them, such as N,albedo", option, text));
  return names;
}

double parse_duration(const char* option, std::string_view text) {
  double seconds = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find_first_of("smh"), rest.size());
    const auto value = number<double>(rest.substr(0, end));
    const double unit = end < rest.size() ? seconds_of(rest[end]) : rest.size() == text.size() ? 1 : 0;
    if (!value || unit == 0 || !(*value >= 0) || !std::isfinite(*value)) {
      seconds = 0;
      break;
    }
    seconds += unit * *value;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (!(seconds > 0 && std::isfinite(seconds)))
    throw UsageError(fmt::format("{} {}: expected a time such as 30s, 10m or 1h30m", option, text));
  return seconds;
}

Interval parse_interval(const char* option, std::string_view text) {
  if (const auto iterations = number<int>(text)) {
    if (*iterations < 1) throw UsageError(fmt::format("{} {}: expected at least 1 iteration", option, text));
    return {.iterations = *iterations};
  }
  return {.seconds = parse_duration(option, text)};
}

double parse_share(const char* option, std::string_view text) {
  const bool percent = text.ends_with('%');
  const double share = number<double>(text.substr(0, text.size() - percent)).value_or(0) / (percent ? 100 : 1);
  if (!(share > 0 && share < 1))
    throw UsageError(fmt::format("{} {}: expected an error between 0 and 1 such as 2% or 0.02", option, text));
  return share;
}

std::size_t parse_bytes(const char* option, std::string_view text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const double bytes = number<double>(text.substr(0, end)).value_or(0) * bytes_of(text.substr(end));
  if (!(bytes >= 1 && bytes < 1e18))
    throw UsageError(fmt::format("{} {}: expected memory such as 2G or 800M", option, text));
  return static_cast<std::size_t>(bytes);
}

std::array<double, 4> parse_crop_window(std::string_view text) {
  const auto window = four<double>(text);
  const auto in_order = [](double low, double high) { return 0 <= low && low < high && high <= 1; };
  if (!window || !in_order((*window)[0], (*window)[1]) || !in_order((*window)[2], (*window)[3]))
    throw UsageError(fmt::format("--cropwindow {}: expected x0,x1,y0,y1 in 0..1, x0 < x1 and y0 < y1", text));
  return *window;
}

std::array<int, 4> parse_pixel_bounds(std::string_view text) {
  const auto bounds = four<int>(text);
  if (!bounds || (*bounds)[0] >= (*bounds)[1] || (*bounds)[2] >= (*bounds)[3])
    throw UsageError(fmt::format("--pixelbounds {}: expected x0,x1,y0,y1 in pixels, x0 < x1 and y0 < y1", text));
  return *bounds;
}

Parts parse_parts(std::string_view text) {
  constexpr std::string_view kFrames = "frames:";
  Parts parts;
  bool has_iterations = false, has_frames = false;
  for (std::string_view word : split(text, ',')) {
    const bool of_frames = word.starts_with(kFrames);
    if (of_frames) word.remove_prefix(kFrames.size());
    const std::vector<std::string_view> numbers = split(word, '/');
    const auto at = [&](std::size_t i) { return numbers.size() == 2 ? number<int>(numbers[i]).value_or(0) : 0; };
    const Part part{at(0), at(1)};
    if (part.number < 1 || part.number > part.of || std::exchange(of_frames ? has_frames : has_iterations, true))
      throw UsageError(fmt::format("--part {}: expected a number out of so many, such as 3/8 or frames:3/8", text));
    if (part.of > Part::kMost) throw UsageError(fmt::format("--part {}: at most {} parts", text, Part::kMost));
    (of_frames ? parts.frames : parts.iterations) = part;
  }
  return parts;
}

Resolution parse_resolution(std::string_view text) {
  constexpr double kMostPercent = 10'000;
  Resolution resolution;
  if (text.ends_with('%')) {
    const double percent = number<double>(text.substr(0, text.size() - 1)).value_or(0);
    if (percent <= kMostPercent) resolution.share = percent / 100;
  } else if (const std::size_t cross = text.find('x'); cross != text.npos) {
    resolution.width = number<int>(text.substr(0, cross)).value_or(0);
    resolution.height = number<int>(text.substr(cross + 1)).value_or(0);
  }
  const auto is_side = [](int size) { return 1 <= size && size <= 65536; };
  if (!(resolution.share > 0) && !(is_side(resolution.width) && is_side(resolution.height)))
    throw UsageError(fmt::format("--resolution {}: expected a share such as 50%, or pixels such as 800x600", text));
  return resolution;
}

std::vector<std::string> canonical_spelling(const std::vector<std::string>& arguments,
                                            const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (auto argument = arguments.begin(); argument != arguments.end(); ++argument) {
    result.push_back(*argument);
    if (*argument == "--") return result.insert(result.end(), argument + 1, arguments.end()), result;
    if (argument->size() < 3 || argument->front() != '-') continue;
    for (const std::string& name : names)
      if (plain_name(*argument) == plain_name(name))
        result.back() = "--" + name + argument->substr(std::min(argument->find('='), argument->size()));
  }
  return result;
}

}  // namespace dspm
