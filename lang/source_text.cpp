#include "dspm/lang/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace dspm {
namespace {

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

int as_int(std::size_t n) {
  return static_cast<int>(std::min<std::size_t>(n, static_cast<std::size_t>(std::numeric_limits<int>::max())));
}

/// Returns the next `$` from `from` on that is not in a comment; `in_string` carries over.
std::size_t find_dollar(std::string_view text, std::size_t from, bool& in_string) {
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '$') return i;
    if (c == '\\' && in_string) {
      ++i;
    } else if (c == '"') {
      in_string = !in_string;
    } else if (c == '\n') {
      in_string = false;  // a string ends with its line at the latest
    } else if (c == '#' && !in_string) {
      i = text.find('\n', i);
      if (i == text.npos) return i;
    }
  }
  return text.npos;
}

}  // namespace

bool is_define_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), is_name_character);
}

bool refers_to(std::string_view text, std::string_view define) {
  const std::string reference = fmt::format("${}", define);
  for (std::size_t at = 0; (at = text.find(reference, at)) != text.npos;) {
    at += reference.size();
    if (at == text.size() || !is_name_character(text[at])) return true;
  }
  return false;
}

SourceText::SourceText(const SourceFile& file) : file_(file), text_(file.text) {
  std::vector<std::size_t> starts{0};
  const char *begin = text_.data(), *end = begin + text_.size();
  for (const char* p = begin; p != end; ++p) {
    p = static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(end - p)));
    if (p == nullptr) break;
    starts.push_back(static_cast<std::size_t>(p + 1 - begin));
  }
  line_starts_ = std::make_shared<const std::vector<std::size_t>>(std::move(starts));
}

SourceText::SourceText(const SourceText& whole, const TextPart& part, const Defines& defines, Diagnostics& diagnostics)
    : file_(whole.file_),
      begin_(part.begin),
      text_(std::string_view(file_.text).substr(part.begin, part.end - part.begin)),
      line_starts_(whole.line_starts_) {
  if (text_.find('$') != text_.npos) replace(defines, diagnostics);
}

void SourceText::replace(const Defines& defines, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const auto& [name, value] : defines) known.push_back(name);
  const std::string_view original_text = text_;
  bool in_string = false;
  std::size_t done = 0;
  for (std::size_t i; (i = find_dollar(original_text, done, in_string)) != original_text.npos;) {
    if (diagnostics.error_count() >= kErrorsShown) break;
    std::size_t end = i + 1;
    while (end < original_text.size() && is_name_character(original_text[end])) ++end;
    const std::string_view name = original_text.substr(i + 1, end - i - 1);
    const auto found = defines.find(name);
    if (found == defines.end()) {
      const std::string guess = did_you_mean(name, known);
      diagnostics.error(
          locate_original(begin_ + i, begin_ + end), fmt::format("${} has no value", name),
          guess.empty() ? fmt::format("give it one: Default {} 1 before it, or -D {}=1 on the command line", name, name)
                        : guess);
    }
    const std::string_view value = found == defines.end() ? "1" : std::string_view(found->second);
    replaced_.append(original_text.substr(done, i - done));
    replacements_.push_back({replaced_.size(), replaced_.size() + value.size(), i, end});
    replaced_.append(value);
    done = end;
  }
  replaced_.append(original_text.substr(done));
  text_ = replaced_;
}

std::size_t SourceText::original(std::size_t offset, bool is_end) const {
  const auto after = std::upper_bound(replacements_.begin(), replacements_.end(), offset,
                                      [](std::size_t o, const Replacement& r) { return o < r.begin; });
  if (after == replacements_.begin()) return offset;
  const Replacement& last = *(after - 1);
  if (offset < last.end) return is_end && offset > last.begin ? last.original_end : last.original_begin;
  return last.original_end + (offset - last.end);
}

SourceLocation SourceText::locate(std::string_view piece) const {
  const std::size_t begin = static_cast<std::size_t>(piece.data() - text_.data());
  return locate_original(begin_ + original(begin, false), begin_ + original(begin + piece.size(), true));
}

SourceLocation SourceText::locate_original(std::size_t begin, std::size_t end) const {
  const auto after = std::upper_bound(line_starts_->begin(), line_starts_->end(), begin);
  const std::size_t line_start = *(after - 1);
  return {&file_, as_int(static_cast<std::size_t>(after - line_starts_->begin())), as_int(begin - line_start + 1),
          as_int(std::max<std::size_t>(end - std::min(begin, end), 1))};
}

}  // namespace dspm
