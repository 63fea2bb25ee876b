// Parameters as plain data: the words for their types, and the values of keys and numbered files at one moment.
#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/numbered_files.h"
#include "dspm/base/params/only_text.h"
#include "dspm/base/params/params.h"

namespace dspm {
namespace {

constexpr std::array<std::string_view, 13> kWords{"bool",      "integer",  "float",   "string", "point2",
                                                  "vector2",   "point3",   "vector3", "normal", "rgb",
                                                  "blackbody", "spectrum", "texture"};

bool interpolates(ParamType type) {
  return type != ParamType::boolean && type != ParamType::text && type != ParamType::spectrum &&
         type != ParamType::texture;
}

/// The place of a `%d` or `%03d` in a file name.
struct NumberField {
  std::size_t begin = 0, length = 0;
  int width = 0;
};
std::optional<NumberField> number_field(std::string_view text) {
  for (std::size_t begin = text.find('%'); begin != text.npos; begin = text.find('%', begin + 1)) {
    std::size_t end = begin + 1;
    int width = 0;
    while (end < text.size() && '0' <= text[end] && text[end] <= '9' && width < 100)
      width = 10 * width + text[end++] - '0';
    if (end < text.size() && text[end] == 'd' && (width == 0 || text[begin + 1] == '0'))
      return NumberField{begin, end + 1 - begin, width};
  }
  return std::nullopt;
}

const std::string* numbered_file_name(const Param& param) {
  const std::string* const name = only_text(&param);
  const bool numbered =
      param.type == ParamType::text && param.name == "filename" && name != nullptr && number_field(*name);
  return numbered ? name : nullptr;
}

std::string with_number(const std::string& name, std::int64_t number) {
  const NumberField field = *number_field(name);
  std::array<char, 128> digits{};
  std::snprintf(digits.data(), digits.size(), "%0*" PRId64, field.width, number);
  return name.substr(0, field.begin) + digits.data() + name.substr(field.begin + field.length);
}

float mix(float a, float b, double t) {
  return static_cast<float>(static_cast<double>(a) * (1 - t) + static_cast<double>(b) * t);
}
int mix(int a, int b, double t) { return static_cast<int>(std::lround(a * (1 - t) + b * t)); }

template <class T>
void mix_values(std::vector<T>& a, const Param::Values& other, double t) {
  const std::vector<T>& b = std::get<std::vector<T>>(other);
  if (a.size() != b.size()) return;
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = mix(a[i], b[i], t);
}

/// Interpolates between the keys a and b, 0 < t < 1.
Param between(const Param& a, const Param& b, double t) {
  Param result = a;
  if (a.type != b.type || !interpolates(a.type) || a.values.index() != b.values.index()) return result;
  if (auto* numbers = std::get_if<std::vector<float>>(&result.values)) mix_values(*numbers, b.values, t);
  if (auto* integers = std::get_if<std::vector<int>>(&result.values)) mix_values(*integers, b.values, t);
  return result;
}

/// The value of a parameter whose keys are given in any order.
Param value_at(Moment moment, std::vector<const Param*> keys) {
  std::stable_sort(keys.begin(), keys.end(), [](const Param* a, const Param* b) { return a->key < b->key; });
  const auto after = std::find_if(keys.begin(), keys.end(), [&](const Param* p) { return *p->key > moment; });
  Param result;
  if (after == keys.begin()) {
    result = *keys.front();
  } else if (const Param& before = **(after - 1); after == keys.end() || before.key == moment) {
    result = before;
  } else {
    result = between(before, **after, fraction(*before.key, *(*after)->key, moment));
  }
  result.key.reset();
  return result;
}

/// Takes the integer `name` from the list, because it has then been used.
std::int64_t take_integer(std::vector<Param>& params, std::string_view name, int fallback) {
  const auto found = std::find_if(params.begin(), params.end(), [&](const Param& p) {
    const auto* integers = std::get_if<std::vector<int>>(&p.values);
    return p.name == name && integers && integers->size() == 1;
  });
  if (found == params.end()) return fallback;
  const int value = std::get<std::vector<int>>(found->values).front();
  params.erase(found);
  return value;
}

/// Fills in the number of the moment's file.
void number_files(std::vector<Param>& params, Moment moment) {
  const auto is_named = [](const Param& p) { return numbered_file_name(p) != nullptr; };
  if (std::none_of(params.begin(), params.end(), is_named)) return;
  const std::int64_t first = take_integer(params, "first", 1), step = take_integer(params, "step", 1);
  const std::int64_t number = first + (moment.number() - 1) * step;
  Param& named = *std::find_if(params.begin(), params.end(), is_named);
  named.values = std::vector<std::string>{with_number(*numbered_file_name(named), number)};
}

}  // namespace

Param param_of(ParamType type, std::string name, Param::Values values, const SourceLocation& where) {
  Param param;
  param.type = type, param.name = std::move(name), param.values = std::move(values);
  param.where = param.values_where = where;
  return param;
}

std::string_view word_of(ParamType type) { return kWords[static_cast<std::size_t>(type)]; }

std::optional<ParamType> param_type(std::string_view word) {
  const auto found = std::find(kWords.begin(), kWords.end(), word);
  if (found == kWords.end()) return std::nullopt;
  return static_cast<ParamType>(found - kWords.begin());
}

std::vector<float> numbers_of(const Param& param) {
  if (const auto* floats = std::get_if<std::vector<float>>(&param.values)) return *floats;
  std::vector<float> numbers;
  for (const int each : std::get<std::vector<int>>(param.values)) numbers.push_back(static_cast<float>(each));
  return numbers;
}

const Param* ParamList::find(std::string_view name) const {
  const auto found = std::find_if(params.begin(), params.end(), [&](const Param& p) { return p.name == name; });
  return found == params.end() ? nullptr : &*found;
}

bool ParamList::is_keyed() const {
  return std::any_of(params.begin(), params.end(), [](const Param& p) { return p.key || numbered_file_name(p); });
}

bool has_numbered_file(const ParamList& list) {
  return std::any_of(list.params.begin(), list.params.end(),
                     [](const Param& p) { return numbered_file_name(p) != nullptr; });
}

ParamList holding_files_of(const ParamList& list, const std::vector<Moment>& moments) {
  ParamList result = list;
  const auto named = std::find_if(list.params.begin(), list.params.end(),
                                  [](const Param& p) { return numbered_file_name(p) != nullptr; });
  if (named == list.params.end()) return result;
  std::erase_if(result.params, [&](const Param& p) { return p.name == named->name; });
  take_integer(result.params, "first", 1), take_integer(result.params, "step", 1);
  for (const Moment moment : moments) {
    Param& file = result.params.emplace_back(*list.at(moment).find(named->name));
    file.key = moment;
  }
  return result;
}

void count_files_from(Moment first, ParamList& list) {
  if (first == Moment() || !has_numbered_file(list)) return;
  const std::int64_t own = take_integer(list.params, "first", first.number());
  std::vector<Param> rest = list.params;
  const std::int64_t step = take_integer(rest, "step", 1), before = first.number() - 1;
  const auto of_frame_1 = static_cast<int>(std::clamp<std::int64_t>(own - before * step, INT32_MIN, INT32_MAX));
  list.params.push_back(param_of(ParamType::integer, "first", std::vector<int>{of_frame_1}, {}));
}

ParamList ParamList::at(Moment moment) const {
  ParamList result{{}, space};
  for (const Param& param : params) {
    if (!param.key) {
      result.params.push_back(param);
      continue;
    }
    std::vector<const Param*> keys;
    for (const Param& other : params)
      if (other.name == param.name && other.key) keys.push_back(&other);
    if (keys.front() == &param) result.params.push_back(value_at(moment, std::move(keys)));
  }
  number_files(result.params, moment);
  return result;
}

bool ParamList::same_values(const ParamList& other) const {
  const auto same = [](const Param& a, const Param& b) {
    return a.type == b.type && a.name == b.name && a.key == b.key && a.values == b.values && a.space == b.space;
  };
  return space == other.space && params.size() == other.params.size() &&
         std::is_permutation(params.begin(), params.end(), other.params.begin(), same);
}

}  // namespace dspm
