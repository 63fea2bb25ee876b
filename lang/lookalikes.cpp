#include "dspm/lang/lookalikes.h"

#include <algorithm>

namespace dspm {
namespace {

constexpr Lookalike kLookalikes[] = {
    {"\xC2\xA0", "a no-break space (U+00A0)", "a space"},
    {"\xE2\x80\xAF", "a narrow no-break space (U+202F)", "a space"},
    {"\xE2\x80\x82", "an en space (U+2002)", "a space"},
    {"\xE2\x80\x83", "an em space (U+2003)", "a space"},
    {"\xE2\x80\x89", "a thin space (U+2009)", "a space"},
    {"\xE3\x80\x80", "an ideographic space (U+3000)", "a space"},
    {"\xE2\x80\x8B", "a zero-width space (U+200B)", "a space, or nothing"},
    {"\xEF\xBB\xBF", "a byte order mark (U+FEFF) within the text", "a space, or nothing"},
    {"\xC2\x85", "a next-line character (U+0085)", "a line end"},
    {"\xE2\x80\xA8", "a line separator (U+2028)", "a line end"},
    {"\xE2\x80\x9C", "a typographic quote (U+201C)", "\""},
    {"\xE2\x80\x9D", "a typographic quote (U+201D)", "\""},
    {"\xE2\x80\x9E", "a typographic quote (U+201E)", "\""},
    {"\xE2\x88\x92", "a minus sign (U+2212)", "-"},
    {"\xE2\x80\x93", "a dash (U+2013)", "-"},
};

}  // namespace

std::optional<Lookalike> find_lookalike(std::string_view word) {
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (std::all_of(word.begin(), word.end(), is_ascii)) return std::nullopt;
  std::optional<Lookalike> first;
  for (const Lookalike& each : kLookalikes) {
    const std::size_t at = word.find(each.where);
    if (at == word.npos || (first && first->where.data() <= word.data() + at)) continue;
    first = {word.substr(at, each.where.size()), each.name, each.instead};
  }
  return first;
}

}  // namespace dspm
