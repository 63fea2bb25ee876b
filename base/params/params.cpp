// ParamReader: a value of each type.
#include "dspm/base/params/params.h"

#include <fmt/format.h>

#include <algorithm>

namespace dspm {
namespace {

/// Formats what only --describe asks for: hair has a million shapes, and none needs it.
template <class... Args>
std::string text_if(bool described, fmt::format_string<Args...> format, Args&&... args) {
  return described ? fmt::format(format, std::forward<Args>(args)...) : std::string();
}

const std::vector<std::string>& texts_of(const Param& param) {
  return std::get<std::vector<std::string>>(param.values);
}

float first_number(const Param& param) {
  const auto* floats = std::get_if<std::vector<float>>(&param.values);
  return floats ? floats->front() : static_cast<float>(std::get<std::vector<int>>(param.values).front());
}

// Lists that a million strands of hair would make a million times each.
const std::vector<ParamType> kNumber{ParamType::number}, kInteger{ParamType::integer}, kBoolean{ParamType::boolean},
    kText{ParamType::text}, kPoints3{ParamType::point3, ParamType::vector3, ParamType::normal};

}  // namespace

ParamReader::ParamReader(const ParamList& list, std::string subject, SourceLocation where, Diagnostics& diagnostics,
                         std::filesystem::path main_directory)
    : list_(&list),
      subject_(std::move(subject)),
      where_(where),
      diagnostics_(diagnostics),
      main_directory_(std::move(main_directory)) {
  constexpr std::size_t kUsual = 16;
  known_.reserve(kUsual);
}

ParamReader::ParamReader(std::vector<ParamInfo>& described, Diagnostics& diagnostics)
    : diagnostics_(diagnostics), described_(&described) {}

bool ParamReader::has(std::string_view name) const { return find(name) != nullptr; }

float ParamReader::number(std::string_view name, float fallback, std::string_view unit, std::string_view sentence) {
  const Param* param = take_some(name, kNumber, 1, text_if(described_, "{:g}", fallback), unit, sentence);
  return param ? first_number(*param) : fallback;
}

int ParamReader::integer(std::string_view name, int fallback, std::string_view unit, std::string_view sentence) {
  const Param* param = take_some(name, kInteger, 1, text_if(described_, "{}", fallback), unit, sentence);
  return param ? std::get<std::vector<int>>(param->values).front() : fallback;
}

bool ParamReader::flag(std::string_view name, bool fallback, std::string_view sentence) {
  const Param* param = take_some(name, kBoolean, 1, fallback ? "true" : "false", {}, sentence);
  return param ? std::get<std::vector<bool>>(param->values).front() : fallback;
}

std::string ParamReader::text(std::string_view name, std::string fallback, std::string_view sentence) {
  const Param* param = take_some(name, kText, 1, text_if(described_, "\"{}\"", fallback), {}, sentence);
  return param ? texts_of(*param).front() : fallback;
}

std::string ParamReader::choice(std::string_view name, std::string fallback, const std::vector<std::string>& choices,
                                std::string_view sentence) {
  const std::string value = text(name, fallback, text_if(described_, "{} ({})", sentence, fmt::join(choices, ", ")));
  if (described_) described_->back().choices = choices;
  if (described_ || std::count(choices.begin(), choices.end(), value) > 0 || value == fallback) return value;
  const std::string guess = did_you_mean(value, choices);
  diagnostics_.error(find(name)->values_where, fmt::format("{} cannot be \"{}\"", quoted(name), value),
                     fmt::format("{}{}choices: {}", guess, guess.empty() ? "" : " ", fmt::join(choices, ", ")));
  return fallback;
}

Vec3 ParamReader::triple(std::string_view name, const Types& types, Vec3 fallback, std::string_view unit,
                         std::string_view sentence) {
  const std::string default_value = text_if(described_, "{:g} {:g} {:g}", fallback.x, fallback.y, fallback.z);
  const Param* param = take_some(name, types, 3, default_value, unit, sentence);
  if (!param) return fallback;
  const std::vector<float> v = numbers_of(*param);
  return {v[0], v[1], v[2]};
}

Vec3 ParamReader::point(std::string_view name, Vec3 fallback, std::string_view unit, std::string_view sentence) {
  return triple(name, {ParamType::point3}, fallback, unit, sentence);
}

Vec3 ParamReader::vector(std::string_view name, Vec3 fallback, std::string_view unit, std::string_view sentence) {
  return triple(name, {ParamType::vector3, ParamType::normal}, fallback, unit, sentence);
}

ValueOrTexture<float> ParamReader::number_or_texture(std::string_view name, float fallback, std::string_view unit,
                                                     std::string_view sentence) {
  const Param* param = take_some(name, {ParamType::number, ParamType::texture}, 1,
                                 text_if(described_, "{:g}", fallback), unit, sentence);
  if (!param) return {fallback, {}, where(name)};
  if (param->type == ParamType::texture) return {fallback, texts_of(*param).front(), param->values_where};
  return {numbers_of(*param).front(), {}, param->values_where};
}

std::vector<float> ParamReader::numbers(std::string_view name, std::string_view sentence) {
  return take_groups(name, {ParamType::number}, 1, sentence);
}

std::vector<int> ParamReader::integers(std::string_view name, std::string_view sentence) {
  const Param* param = take(name, {ParamType::integer}, "", {}, sentence);
  return param ? std::get<std::vector<int>>(param->values) : std::vector<int>{};
}

std::vector<Vec2> ParamReader::points2(std::string_view name, std::string_view sentence) {
  const std::vector<float> v = take_groups(name, {ParamType::point2, ParamType::vector2}, 2, sentence);
  std::vector<Vec2> points(v.size() / 2);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {v[2 * i], v[2 * i + 1]};
  return points;
}

std::vector<Vec3> ParamReader::points3(std::string_view name, std::string_view sentence) {
  const std::vector<float> v = take_groups(name, kPoints3, 3, sentence);
  std::vector<Vec3> points(v.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
  return points;
}

std::vector<std::string> ParamReader::texts(std::string_view name, std::string_view sentence) {
  const Param* param = take(name, {ParamType::text}, "", {}, sentence);
  return param ? texts_of(*param) : std::vector<std::string>{};
}

void ParamReader::unsupported(std::string_view name, std::string_view what) {
  if (!has(name)) return;
  tolerated_.emplace_back(name);
  diagnostics_.unsupported(where(name), fmt::format("{} is not supported by dspm: {}", quoted(name), what),
                           "with --lenient, it has no effect");
}

void ParamReader::without_effect(std::string_view name) {
  if (!has(name)) return;
  tolerated_.emplace_back(name);
  diagnostics_.note(where(name), fmt::format("{} has no effect, as in pbrt", quoted(name)));
}

void ParamReader::alias(std::string_view alias, std::string_view name) { aliases_.emplace_back(alias, name); }

void ParamReader::former_name(std::string_view former, std::string_view name) {
  alias(former, name);
  const Param* param = list_ != nullptr ? list_->find(former) : nullptr;
  if (param == nullptr) return;
  diagnostics_.note(param->where, fmt::format("{} is now called \"{}\"", quoted(former), name));
}

SourceLocation ParamReader::where(std::string_view name) const {
  const Param* param = find(name);
  return param ? param->where : where_;
}

void ParamReader::error(std::string_view name, std::string message, std::string hint) {
  diagnostics_.error(where(name), std::move(message), std::move(hint));
}

void ParamReader::warning(std::string_view name, std::string message, std::string hint) {
  diagnostics_.warning(where(name), std::move(message), std::move(hint));
}

}  // namespace dspm
