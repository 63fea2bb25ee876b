#include "dspm/base/params/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <utility>

#include "dspm/base/params/other_words.h"

namespace dspm {
namespace {

constexpr std::size_t kLineWidth = 100;  // longer lines (mesh data) are shown clipped around the column

std::string_view word_of(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

std::string_view line_of(std::string_view text, int number) {
  std::size_t begin = 0;
  for (int line = 1; line < number; ++line) {
    const std::size_t newline = text.find('\n', begin);
    if (newline == text.npos) return {};
    begin = newline + 1;
  }
  std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool continues_utf8(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Replaces control characters, which would upset a terminal, and tabs, which would shift the caret.
std::string printable(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = c == '\t' ? ' ' : '?';
  return result;
}

std::size_t display_width(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues_utf8));
}

/// Returns the line with its number, underlined on the line below.
std::string excerpt(const SourceLocation& where) {
  const std::string_view line = line_of(where.file->text, where.line);
  const std::size_t start = std::min(static_cast<std::size_t>(std::max(where.column - 1, 0)), line.size());
  std::size_t begin = 0, end = line.size();
  if (line.size() > kLineWidth) {
    begin = start > kLineWidth / 2 ? start - kLineWidth / 2 : 0;
    end = std::min(line.size(), begin + kLineWidth);
    while (begin > 0 && begin < start && continues_utf8(line[begin])) ++begin;
    while (end < line.size() && continues_utf8(line[end])) ++end;
  }
  const std::string_view left = begin > 0 ? "..." : "", right = end < line.size() ? "..." : "";
  const std::string_view before = line.substr(begin, start - begin);
  const std::string_view marked = line.substr(start, static_cast<std::size_t>(std::max(where.length, 1)));
  const std::size_t width = std::clamp<std::size_t>(display_width(marked.substr(0, end - start)), 1, kLineWidth);
  return fmt::format("{:5} | {}{}{}\n      | {:{}}^{:~<{}}\n", where.line, left,
                     printable(line.substr(begin, end - begin)), right, "", left.size() + display_width(before), "",
                     width - 1);
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Returns the number of insertions, deletions, replacements and swaps of neighbours that turn one word into the other
/// (case is ignored).
int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> two_back, previous(b.size() + 1), row(b.size() + 1);
  std::iota(previous.begin(), previous.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const char x = lower(a[i - 1]), y = lower(b[j - 1]);
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (x == y ? 0 : 1)});
      if (i > 1 && j > 1 && x == lower(b[j - 2]) && y == lower(a[i - 2]))
        row[j] = std::min(row[j], two_back[j - 2] + 1);
    }
    two_back = std::exchange(previous, row);
  }
  return previous[b.size()];
}

std::uint64_t letters_of(std::string_view word) {
  std::uint64_t letters = 0;
  for (const char c : word) letters |= std::uint64_t{1} << (static_cast<unsigned char>(lower(c)) % 64);
  return letters;
}

/// Returns a lower bound on the distance at a fraction of its cost: each letter that only one word has needs an edit of
/// its own.
int least_distance(std::string_view a, std::string_view b) {
  const std::uint64_t of_a = letters_of(a), of_b = letters_of(b);
  return std::max({std::abs(static_cast<int>(a.size()) - static_cast<int>(b.size())), std::popcount(of_a & ~of_b),
                   std::popcount(of_b & ~of_a)});
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  const SourceLocation& at = diagnostic.where;
  std::string text;
  if (at.file != nullptr) text = at.file->name + ":";
  if (at.file != nullptr && at.line > 0) text += fmt::format("{}:{}:", at.line, at.column);
  text +=
      fmt::format("{}{}: {}\n", text.empty() ? "" : " ", word_of(diagnostic.severity), printable(diagnostic.message));
  if (at.file != nullptr && at.line > 0) text += excerpt(at);
  if (!diagnostic.hint.empty()) text += "  " + printable(diagnostic.hint) + "\n";
  return text;
}

std::vector<std::string> nearest_names(std::string_view word, const std::vector<std::string>& candidates) {
  const int limit = std::clamp(static_cast<int>(word.size()) / 3, 1, 3);
  std::vector<std::pair<int, std::string>> near;
  for (const std::string& candidate : candidates) {
    if (least_distance(word, candidate) > limit) continue;
    const auto longer = std::max(word.size(), candidate.size());
    const int distance = edit_distance(word, candidate);
    if (distance <= limit && distance < static_cast<int>(longer)) near.emplace_back(distance, candidate);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& [distance, name] : near)
    if (names.size() < 3 && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  std::vector<std::string> names = meant_by(word, candidates);
  if (names.empty()) names = nearest_names(word, candidates);
  if (names.empty()) return {};
  std::string text = "did you mean ";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}\"{}\"", i == 0 ? "" : i + 1 == names.size() ? " or " : ", ", names[i]);
  return text + "?";
}

void Diagnostics::error(const SourceLocation& where, std::string message, std::string hint) {
  ++errors_;
  add(Severity::error, where, std::move(message), std::move(hint));
}

void Diagnostics::warning(const SourceLocation& where, std::string message, std::string hint) {
  add(Severity::warning, where, std::move(message), std::move(hint));
}

void Diagnostics::note(const SourceLocation& where, std::string message, std::string hint) {
  add(Severity::note, where, std::move(message), std::move(hint));
}

void Diagnostics::unsupported(const SourceLocation& where, std::string message, std::string hint) {
  if (lenient_) return warning(where, std::move(message), std::move(hint));
  error(where, std::move(message), std::move(hint));
}

void Diagnostics::append(Diagnostics part) {
  errors_ += part.errors_;
  all_.insert(all_.end(), std::make_move_iterator(part.all_.begin()), std::make_move_iterator(part.all_.end()));
}

void Diagnostics::throw_if_errors() const {
  if (errors_ == 0) return;
  std::string text;
  int shown = 0;
  for (const Diagnostic& diagnostic : all_)
    if (diagnostic.severity == Severity::error && shown++ < kErrorsShown) text += to_string(diagnostic);
  if (errors_ > kErrorsShown) text += fmt::format("... and {} more errors\n", errors_ - kErrorsShown);
  throw SceneError(text);
}

void Diagnostics::add(Severity severity, const SourceLocation& where, std::string message, std::string hint) {
  all_.push_back({severity, where, std::move(message), std::move(hint)});
}

}  // namespace dspm
