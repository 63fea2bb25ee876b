#include "dspm/lang/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "dspm/lang/lookalikes.h"

namespace dspm {
namespace {

constexpr std::ptrdiff_t kLongestString = 4096;

bool ends_word(char c) { return is_blank(c) || c == '[' || c == ']' || c == '"' || c == '#'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool starts_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

const char* line_end(const char* at, const char* end) {
  const void* newline = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
  return newline == nullptr ? end : static_cast<const char*>(newline);
}

/// Skips a +, which std::from_chars does not accept; but it would accept the - of `+-1`.
const char* skip_plus(const char* at, const char* end) {
  return end - at > 1 && at[0] == '+' && at[1] != '-' ? at + 1 : at;
}

/// Returns the end of the string that begins at `quote`, after its closing quote; null if its line ends first.
const char* string_end(const char* quote, const char* end) {
  for (const char* p = quote + 1; p != end && *p != '\n'; ++p) {
    if (*p == '"') return p + 1;
    if (*p == '\\' && p + 1 != end && p[1] != '\n') ++p;
  }
  return nullptr;
}

}  // namespace

Lexer::Lexer(const SourceText& source) : source_(source), at_(source.text().data()), end_(at_ + source.text().size()) {}

void Lexer::fail(std::string_view piece, const std::string& message, std::string hint) const {
  throw SyntaxError(locate(piece), message, std::move(hint));
}

Token Lexer::next() {
  Token token = next_or_comment();
  while (token.kind == Token::Kind::comment) token = next_or_comment();
  return token;
}

const Token& Lexer::peek() {
  if (!peeked_) peeked_ = next();
  return *peeked_;
}

Token Lexer::next_or_comment() {
  if (peeked_) {
    const Token token = *peeked_;
    peeked_.reset();
    return token;
  }
  while (at_ != end_ && is_blank(*at_)) ++at_;
  if (at_ == end_) return {Token::Kind::end, view(end_, end_)};
  const char* const begin = at_;
  switch (*begin) {
    case '"': return read_string();
    case '[': ++at_; return {Token::Kind::open, view(begin, at_)};
    case ']': ++at_; return {Token::Kind::close, view(begin, at_)};
    case '#': {
      at_ = line_end(at_, end_);
      const char* last = at_;
      while (is_blank(last[-1])) --last;
      return {Token::Kind::comment, view(begin, last)};
    }
    default: break;
  }
  const std::string_view word = word_at(begin);
  at_ += word.size();
  refuse_lookalikes(word);
  return {starts_number(*begin) ? Token::Kind::number : Token::Kind::word, word};
}

Token Lexer::read_string() {
  const char* const begin = at_;
  const char* const closed = string_end(begin, end_);
  if (closed == nullptr) {
    at_ = line_end(begin, end_);
    fail(view(begin, begin + 1), "this string is not closed on its line");
  }
  at_ = closed;
  if (closed - begin > kLongestString)
    fail(view(begin, begin + 1), fmt::format("this string is longer than {} bytes", kLongestString),
         "names and file names must be shorter");
  if (std::find(begin, closed, '\0') != closed) fail(view(begin, begin + 1), "this string contains a zero byte");
  return {Token::Kind::string, view(begin, closed)};
}

std::string_view Lexer::word_at(const char* begin) const { return view(begin, std::find_if(begin, end_, ends_word)); }

void Lexer::skip_blank() {
  while (at_ != end_) {
    if (is_blank(*at_))
      ++at_;
    else if (*at_ == '#')
      at_ = line_end(at_, end_);
    else
      break;
  }
}

void Lexer::take_back_peeked() {
  if (peeked_) at_ = peeked_->text.data();
  peeked_.reset();
}

std::string_view Lexer::rest() {
  take_back_peeked();
  skip_blank();
  return view(at_, end_);
}

void Lexer::go_on_at(const char* place) {
  peeked_.reset();
  at_ = place;
}

bool Lexer::skip(std::string_view characters) {
  const bool is_next = rest().starts_with(characters);
  if (is_next) at_ += characters.size();
  return is_next;
}

bool Lexer::plain_numbers(std::vector<float>& values) {
  take_back_peeked();
  for (skip_blank(); at_ != end_ && starts_number(*at_); skip_blank()) {
    float value = 0;
    const auto [stop, error] = std::from_chars(skip_plus(at_, end_), end_, value);
    if (error != std::errc() || !(stop == end_ || ends_word(*stop)) || !std::isfinite(value)) return false;
    values.push_back(value);
    at_ = stop;
  }
  return true;
}

void Lexer::skip_to_directive() {
  take_back_peeked();
  for (skip_blank(); at_ != end_ && !is_upper(*at_); skip_blank()) {
    if (*at_ == '"') {
      const char* const closed = string_end(at_, end_);
      at_ = closed != nullptr ? closed : line_end(at_, end_);
    } else {
      at_ += std::max<std::size_t>(word_at(at_).size(), 1);
    }
  }
}

std::string Lexer::unquoted(const Token& string) const {
  std::string_view rest = string.text.substr(1, string.text.size() - 2);
  std::string result;
  for (std::size_t escape; (escape = rest.find('\\')) != rest.npos; rest.remove_prefix(escape + 2)) {
    constexpr std::string_view kLetters = "bfnrt\\'\"", kMeanings = "\b\f\n\r\t\\'\"";
    const std::size_t which = kLetters.find(rest[escape + 1]);
    if (which == kLetters.npos)
      fail(rest.substr(escape, 2), "unknown escape", "available: \\b \\f \\n \\r \\t \\\\ \\' \\\"");
    result.append(rest.substr(0, escape));
    result.push_back(kMeanings[which]);
  }
  return result.append(rest);
}

void Lexer::refuse_lookalikes(std::string_view word) const {
  if (const auto found = find_lookalike(word))
    fail(found->where, fmt::format("this is {}", found->name), fmt::format("write {}", found->instead));
}

template <class Number>
void Lexer::fail_number(std::string_view word) const {
  refuse_lookalikes(word);
  const std::string_view kind = std::is_integral_v<Number> ? "an integer" : "a number";
  if (word.empty()) fail(view(at_, std::min(at_ + 1, end_)), fmt::format("expected {}", kind));
  double value = 0;
  const char* const begin = skip_plus(word.data(), word.data() + word.size());
  const auto [stop, error] = std::from_chars(begin, word.data() + word.size(), value);
  const bool complete = stop == word.data() + word.size();
  if (complete && (error == std::errc::result_out_of_range || std::isfinite(value))) {
    if (std::is_integral_v<Number> && error == std::errc() && value == std::floor(value) && std::abs(value) < 1e15)
      fail(word, std::abs(value) >= 0x1p31 ? "this integer does not fit into 32 bits" : "expected an integer",
           std::abs(value) >= 0x1p31 ? "" : fmt::format("write {:.0f}", value));
    fail(word, std::is_integral_v<Number> ? "expected an integer" : "this number is too large");
  }
  if (complete && error == std::errc()) fail(word, "numbers must be finite");
  fail(word, fmt::format("expected {}", kind));
}

template <class Number>
Number Lexer::read_number() {
  const char* const begin = skip_plus(at_, end_);
  Number value{};
  const auto [stop, error] = std::from_chars(begin, end_, value);
  const bool complete = stop == end_ || ends_word(*stop);
  if constexpr (std::is_floating_point_v<Number>) {
    if (error == std::errc() && complete && std::isfinite(value)) [[likely]] {
      at_ = stop;
      return value;
    }
    if (error == std::errc::result_out_of_range && complete) {  // too large, or so small that it is 0
      const double exact = std::strtod(std::string(begin, stop).c_str(), nullptr);
      if (std::abs(exact) < 1) {
        at_ = stop;
        return static_cast<Number>(exact);
      }
    }
  } else if (error == std::errc() && complete) [[likely]] {
    at_ = stop;
    return value;
  }
  fail_number<Number>(word_at(at_));
}

template <class Number>
Number Lexer::number() {
  take_back_peeked();
  skip_blank();
  return read_number<Number>();
}

template <class Number>
void Lexer::numbers_to_bracket(std::vector<Number>& values) {
  take_back_peeked();
  const char* const begin = at_;
  // Most lists are short, and a vector that grows one by one would take several allocations for them.
  std::array<Number, 64> few;
  std::size_t count = 0;
  while (true) {
    skip_blank();
    if (at_ == end_) fail(view(begin - 1, begin), "this list is not closed");
    if (!starts_number(*at_)) {
      if (*at_ == ']') break;
      if (*at_ == '"' || *at_ == '[' || is_upper(*at_))
        fail(view(at_, at_ + 1), "expected a number, or ] to end the list");
    }
    few[count++] = read_number<Number>();
    if (count < few.size()) continue;
    values.insert(values.end(), few.begin(), few.end());
    count = 0;
  }
  values.insert(values.end(), few.begin(), few.begin() + static_cast<std::ptrdiff_t>(count));
  ++at_;
}

template double Lexer::number<double>();
template float Lexer::number<float>();
template int Lexer::number<int>();
template void Lexer::numbers_to_bracket<double>(std::vector<double>&);
template void Lexer::numbers_to_bracket<float>(std::vector<float>&);
template void Lexer::numbers_to_bracket<int>(std::vector<int>&);

}  // namespace dspm
