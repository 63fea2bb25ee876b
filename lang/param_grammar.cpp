#include "dspm/lang/param_grammar.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>

#include "dspm/base/math/moments.h"
#include "dspm/lang/directives.h"

namespace dspm {
namespace {

struct TypeWord {
  std::string_view word;
  ParamType type;
  std::size_t dimension = 1;  // numbers per value
};

constexpr TypeWord kTypes[] = {
    {"bool", ParamType::boolean},     {"integer", ParamType::integer},     {"float", ParamType::number},
    {"string", ParamType::text},      {"point2", ParamType::point2, 2},    {"vector2", ParamType::vector2, 2},
    {"point3", ParamType::point3, 3}, {"vector3", ParamType::vector3, 3},  {"normal", ParamType::normal, 3},
    {"rgb", ParamType::rgb, 3},       {"blackbody", ParamType::blackbody}, {"spectrum", ParamType::spectrum},
    {"texture", ParamType::texture},
};

/// The current word for a type that pbrt-v1 to v3 called differently.
std::string_view new_type(std::string_view word) {
  return word == "point"                    ? "point3"
         : word == "vector"                 ? "vector3"
         : word == "normal3"                ? "normal"
         : word == "color" || word == "xyz" ? "rgb"
                                            : "";
}

struct Declaration {
  const TypeWord* type = nullptr;
  std::string_view name, key;  // key: from `@` on
  bool is_xyz = false;
};

/// Splits type, blanks and name; `type` is null if the first word is not a type.
Declaration split(std::string_view inside, OldTypes old_types) {
  const auto skip = [&](auto is_end) {
    const std::size_t length =
        static_cast<std::size_t>(std::find_if(inside.begin(), inside.end(), is_end) - inside.begin());
    const std::string_view part = inside.substr(0, length);
    inside.remove_prefix(length);
    return part;
  };
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  const auto is_no_blank = [&](char c) { return !is_blank(c); };
  skip(is_no_blank);
  std::string_view word = skip(is_blank);
  const bool is_geometric = word == "point" || word == "vector" || word == "normal3";
  const bool is_xyz = word == "xyz";
  const bool is_colour = word == "color" || is_xyz;
  if ((old_types != OldTypes::errors && is_geometric) || (old_types == OldTypes::v3 && is_colour))
    word = new_type(word);
  skip(is_no_blank);
  const std::string_view full_name = skip(is_blank);
  const auto type =
      std::find_if(std::begin(kTypes), std::end(kTypes), [&](const TypeWord& t) { return t.word == word; });
  const std::size_t at = std::min(full_name.find('@'), full_name.size());
  return {type == std::end(kTypes) ? nullptr : type, full_name.substr(0, at), full_name.substr(at), is_xyz};
}

[[noreturn]] void fail_type(const Lexer& lexer, const Token& string, std::string_view inside) {
  lexer.refuse_lookalikes(inside);
  const std::string_view word = inside.substr(0, inside.find_first_of(" \t"));
  if (word.size() == inside.size())
    lexer.fail(string.text, fmt::format("expected a type and a name, as in \"float {}\"", inside));
  std::vector<std::string> words;
  for (const TypeWord& type : kTypes) words.emplace_back(type.word);
  if (const std::string_view now = new_type(word); !now.empty())
    throw SyntaxError(lexer.locate(string.text), fmt::format("unknown parameter type \"{}\"", word),
                      fmt::format("did you mean \"{}\"?", now), std::string(word));
  std::string hint = did_you_mean(word, words);
  if (hint.empty())
    hint =
        "available: bool, integer, float, string, point2, vector2, point3, vector3, normal, rgb, "
        "blackbody, spectrum, texture";
  lexer.fail(string.text, fmt::format("unknown parameter type \"{}\"", word), hint);
}

std::optional<Moment> read_key(const Lexer& lexer, const Token& string, std::string_view key, const Clock& clock) {
  if (key.empty()) return std::nullopt;
  const std::optional<Moment> moment = clock.moment_of(lexer, string.text, key.substr(1));
  if (!moment)
    lexer.fail(string.text, fmt::format("expected a frame after @, counted from {}, but found \"{}\"", clock.lowest(),
                                        key.substr(1)));
  return moment;
}

template <class Value, class ReadOne>
std::vector<Value> read_values(Lexer& lexer, ReadOne read_one) {
  std::vector<Value> values;
  if (lexer.peek().kind != Token::Kind::open) {
    values.push_back(read_one(lexer.next()));
    return values;
  }
  const Token open = lexer.next();
  while (lexer.peek().kind != Token::Kind::close) {
    if (lexer.peek().kind == Token::Kind::end) lexer.fail(open.text, "this list is not closed");
    values.push_back(read_one(lexer.next()));
  }
  lexer.next();
  return values;
}

template <class Number>
std::vector<Number> read_numbers(Lexer& lexer) {
  std::vector<Number> values;
  if (lexer.peek().kind != Token::Kind::open) {
    values.push_back(lexer.number<Number>());
  } else {
    lexer.next();
    lexer.numbers_to_bracket(values);
  }
  return values;
}

std::vector<std::string> read_strings(Lexer& lexer) {
  return read_values<std::string>(lexer, [&](const Token& token) {
    if (token.kind != Token::Kind::string) lexer.fail(token.text, "expected a string in quotes");
    return lexer.unquoted(token);
  });
}

std::vector<bool> read_flags(Lexer& lexer) {
  return read_values<bool>(lexer, [&](const Token& token) {
    if (token.text == "true" || token.text == "\"true\"") return true;
    if (token.text != "false" && token.text != "\"false\"") lexer.fail(token.text, "expected true or false");
    return false;
  });
}

/// Returns the token after the opening bracket, if there is one; reads nothing.
Token first_value(Lexer& lexer) {
  if (lexer.peek().kind != Token::Kind::open) return lexer.peek();
  Lexer ahead = lexer;
  ahead.next();
  return ahead.next();
}

[[noreturn]] void fail_strings(Lexer& lexer, const TypeWord& type, std::string_view name) {
  const Token found = first_value(lexer);
  const bool may_be_texture = type.type == ParamType::number || type.type == ParamType::rgb;
  const std::string hint =
      may_be_texture ? fmt::format("a texture is given as \"texture {}\" {}", name, found.text) : "";
  lexer.fail(found.text, fmt::format("expected a number for \"{} {}\"", type.word, name),
             declares_param(found.text) ? "" : hint);
}

Param::Values read_values_of(Lexer& lexer, const TypeWord& type, std::string_view name) {
  const bool are_strings = first_value(lexer).kind == Token::Kind::string;
  switch (type.type) {
    case ParamType::boolean: return read_flags(lexer);
    case ParamType::text:
    case ParamType::texture: return read_strings(lexer);
    case ParamType::spectrum:
      if (are_strings) return read_strings(lexer);
      return read_numbers<float>(lexer);
    default: break;
  }
  if (are_strings) fail_strings(lexer, type, name);
  if (type.type == ParamType::integer) return read_numbers<int>(lexer);
  return read_numbers<float>(lexer);
}

void check_count(Lexer& lexer, const Token& string, const Declaration& declared, const Param::Values& values) {
  const auto* numbers = std::get_if<std::vector<float>>(&values);
  if (numbers == nullptr) return;
  const bool is_sampled = declared.type->type == ParamType::spectrum;
  const std::size_t dimension = is_sampled ? 2 : declared.type->dimension;
  if (numbers->size() % dimension == 0) return;
  std::string hint = fmt::format("each value has {} numbers", dimension);
  if (is_sampled) hint = "a sampled spectrum is a list of wavelength and value pairs";
  if (lexer.peek().kind == Token::Kind::number) hint = "put several numbers in brackets";
  lexer.fail(string.text,
             fmt::format("{} number{} cannot be values of type {}", numbers->size(), numbers->size() == 1 ? "" : "s",
                         declared.type->word),
             hint);
}

void xyz_to_rgb(std::vector<float>& values) {
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
    const float x = values[i], y = values[i + 1], z = values[i + 2];
    values[i] = 3.240479f * x - 1.537150f * y - 0.498535f * z;
    values[i + 1] = -0.969256f * x + 1.875991f * y + 0.041556f * z;
    values[i + 2] = 0.055648f * x - 0.204043f * y + 1.057311f * z;
  }
}

Param read_param(Lexer& lexer, OldTypes old_types, const Clock& clock) {
  const Token string = lexer.next();
  const std::string_view inside = string.text.substr(1, string.text.size() - 2);
  const Declaration declared = split(inside, old_types);
  if (declared.type == nullptr) fail_type(lexer, string, inside);
  if (declared.name.empty()) lexer.fail(string.text, "a name is missing after the parameter's type");
  Param param;
  param.type = declared.type->type;
  param.name = declared.name;
  param.key = read_key(lexer, string, declared.key, clock);
  param.where = lexer.locate(string.text);
  const Token& next = lexer.peek();
  const bool is_directive = next.kind == Token::Kind::word && find_directive(next.text) != nullptr;
  if (next.kind == Token::Kind::end || next.kind == Token::Kind::close || is_directive)
    lexer.fail(string.text, "this parameter has no value");
  param.values_where = lexer.locate(first_value(lexer).text);
  param.values = read_values_of(lexer, *declared.type, declared.name);
  check_count(lexer, string, declared, param.values);
  if (declared.is_xyz) xyz_to_rgb(std::get<std::vector<float>>(param.values));
  return param;
}

void check_pair(const Param& a, const Param& b) {
  if (a.name != b.name) return;
  const auto fail = [&](const std::string& what) {
    throw SyntaxError(b.where, fmt::format("parameter \"{}\" {}", b.name, what),
                      fmt::format("first on line {}", a.where.line));
  };
  if (a.key == b.key) fail(a.key ? fmt::format("has two values for frame {}", number_of(*a.key)) : "is given twice");
  if (!a.key || !b.key) fail("is given both with and without a frame");
}

bool has_repeats(const std::vector<Param>& params) {
  for (std::size_t i = 1; i < params.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (params[k].name == params[i].name) return true;
  return false;
}

/// Reports parameters that are given twice, unless for different frames; sorts a long list, which would take quadratic
/// time.
void check_unique(const ParamList& list) {
  constexpr std::size_t kFew = 16;
  if (list.params.size() <= kFew && !has_repeats(list.params)) return;
  std::vector<const Param*> sorted;
  for (const Param& param : list.params) sorted.push_back(&param);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Param* a, const Param* b) {
    return std::tie(a->name, a->key) < std::tie(b->name, b->key);
  });
  for (std::size_t i = 1; i < sorted.size(); ++i) check_pair(*sorted[i - 1], *sorted[i]);
}

/// Keeps the last one of those that are given twice.
void keep_last(ParamList& list) {
  std::set<std::string> seen;
  std::vector<Param> kept;
  for (auto param = list.params.rbegin(); param != list.params.rend(); ++param)
    if (seen.insert(param->name).second) kept.push_back(std::move(*param));
  list.params.assign(std::make_move_iterator(kept.rbegin()), std::make_move_iterator(kept.rend()));
}

}  // namespace

bool declares_param(std::string_view quoted) {
  if (quoted.size() < 2 || quoted.front() != '"') return false;
  const Declaration declared = split(quoted.substr(1, quoted.size() - 2), OldTypes::v3);
  return declared.type != nullptr && !declared.name.empty();
}

ParamList read_params(Lexer& lexer, OldTypes old_types, const Clock& clock) {
  // Hair may have a million lists: none takes more memory than it needs, nor more than one allocation.
  static thread_local std::vector<Param> params;
  params.clear();
  while (lexer.peek().kind == Token::Kind::string) params.push_back(read_param(lexer, old_types, clock));
  ParamList list;
  list.params.assign(std::make_move_iterator(params.begin()), std::make_move_iterator(params.end()));
  if (list.params.size() < 2) return list;
  if (old_types == OldTypes::v3)
    keep_last(list);
  else
    check_unique(list);
  return list;
}

}  // namespace dspm
