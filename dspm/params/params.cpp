// ParamReader: each read looks up its parameter, checks type and count, and records it for --describe.
#include "dspm/params/params.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/system/file_access.h"

namespace dspm {
namespace {

std::string words(const std::vector<ParamType>& types) {
  std::string text;
  for (std::size_t i = 0; i < types.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : i + 1 < types.size() ? ", " : " or ", word_of(types[i]));
  return text;
}

/// Whether the values match the parameter's type.
bool fits(const Param& param) {
  const bool numbers = std::holds_alternative<std::vector<float>>(param.values) ||
                       std::holds_alternative<std::vector<int>>(param.values);
  const bool texts = std::holds_alternative<std::vector<std::string>>(param.values);
  switch (param.type) {
    case ParamType::boolean: return std::holds_alternative<std::vector<bool>>(param.values);
    case ParamType::integer: return std::holds_alternative<std::vector<int>>(param.values);
    case ParamType::text:
    case ParamType::texture: return texts;
    case ParamType::spectrum: return numbers || texts;
    default: return numbers;
  }
}

std::size_t value_count(const Param& param) {
  return std::visit([](const auto& values) { return values.size(); }, param.values);
}

std::string counted(std::size_t count) { return fmt::format("{} value{}", count, count == 1 ? "" : "s"); }

/// What only --describe asks for: hair has a million shapes, and none needs it.
template <class... Args>
std::string text_if(bool described, fmt::format_string<Args...> format, Args&&... args) {
  return described ? fmt::format(format, std::forward<Args>(args)...) : std::string();
}

std::string joined(const std::vector<std::string>& texts) { return fmt::format("{}", fmt::join(texts, ", ")); }

const std::vector<std::string>& texts_of(const Param& param) {
  return std::get<std::vector<std::string>>(param.values);
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// For names that are numbered as other programs write it: "wave.####.ply".
std::string numbered_as(const std::string& name) {
  const std::size_t first = name.find('#'), end = std::min(name.find_first_not_of('#', first), name.size());
  if (first == std::string::npos) return {};
  const std::string ours = fmt::format("{}%0{}d{}", name.substr(0, first), end - first, name.substr(end));
  return fmt::format("a frame's number is written as in \"{}\", in a Dynamic block; ", ours);
}

}  // namespace

ParamReader::ParamReader(const ParamList& list, std::string subject, SourceLocation where, Diagnostics& diagnostics,
                         std::filesystem::path main_directory)
    : list_(&list),
      subject_(std::move(subject)),
      where_(where),
      diagnostics_(diagnostics),
      main_directory_(std::move(main_directory)) {}

ParamReader::ParamReader(std::vector<ParamInfo>& described, Diagnostics& diagnostics)
    : diagnostics_(diagnostics), described_(&described) {}

bool ParamReader::has(std::string_view name) const { return find(name) != nullptr; }

float ParamReader::number(std::string_view name, float fallback, std::string_view unit, std::string_view sentence) {
  const Param* param = take_some(name, {ParamType::number}, 1, text_if(described_, "{:g}", fallback), unit, sentence);
  return param ? numbers_of(*param).front() : fallback;
}

int ParamReader::integer(std::string_view name, int fallback, std::string_view unit, std::string_view sentence) {
  const Param* param = take_some(name, {ParamType::integer}, 1, std::to_string(fallback), unit, sentence);
  return param ? std::get<std::vector<int>>(param->values).front() : fallback;
}

bool ParamReader::flag(std::string_view name, bool fallback, std::string_view sentence) {
  const Param* param = take_some(name, {ParamType::boolean}, 1, fallback ? "true" : "false", {}, sentence);
  return param ? std::get<std::vector<bool>>(param->values).front() : fallback;
}

std::string ParamReader::text(std::string_view name, std::string fallback, std::string_view sentence) {
  const Param* param = take_some(name, {ParamType::text}, 1, text_if(described_, "\"{}\"", fallback), {}, sentence);
  return param ? texts_of(*param).front() : fallback;
}

std::string ParamReader::choice(std::string_view name, std::string fallback, const std::vector<std::string>& choices,
                                std::string_view sentence) {
  const std::string value = text(name, fallback, text_if(described_, "{} ({})", sentence, fmt::join(choices, ", ")));
  if (described_) described_->back().choices = choices;
  if (described_ || contains(choices, value) || value == fallback) return value;
  const std::string guess = did_you_mean(value, choices);
  diagnostics_.error(find(name)->values_where, fmt::format("{} cannot be \"{}\"", quoted(name), value),
                     fmt::format("{}{}choices: {}", guess, guess.empty() ? "" : " ", joined(choices)));
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
  const Types types{ParamType::point3, ParamType::vector3, ParamType::normal};
  const std::vector<float> v = take_groups(name, types, 3, sentence);
  std::vector<Vec3> points(v.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
  return points;
}

std::vector<std::string> ParamReader::texts(std::string_view name, std::string_view sentence) {
  const Param* param = take(name, {ParamType::text}, "", {}, sentence);
  return param ? texts_of(*param) : std::vector<std::string>{};
}

std::filesystem::path ParamReader::file(std::string_view name, std::string_view sentence) {
  return take_file(name, true, sentence);
}

std::filesystem::path ParamReader::optional_file(std::string_view name, std::string_view sentence) {
  return take_file(name, false, sentence);
}

std::filesystem::path ParamReader::take_file(std::string_view name, bool required, std::string_view sentence) {
  const Param* param = take_some(name, {ParamType::text}, 1, required ? "required" : "none", "file", sentence);
  if (described_) return {};
  if (!param) {
    if (required && !has(name)) error({}, fmt::format("{} needs a file: \"string {}\"", subject_, name));
    return {};
  }
  const std::string& file_name = texts_of(*param).front();
  std::filesystem::path found = existing_file(*param, file_name);
  if (!found.empty()) return found;
  std::vector<std::string> tried;
  for (const auto& place : places(*param, file_name)) tried.push_back(place.string());
  diagnostics_.error(param->values_where, fmt::format("there is no file \"{}\"", file_name),
                     fmt::format("{}looked for {}", numbered_as(file_name), fmt::join(tried, " and ")));
  return {};
}

std::vector<std::filesystem::path> ParamReader::places(const Param& param, const std::string& name) const {
  const std::filesystem::path naming_file = param.where.file ? param.where.file->name : "";
  std::vector<std::filesystem::path> places{naming_file.parent_path() / name};
  if (main_directory_ / name != places.front()) places.push_back(main_directory_ / name);
  return places;
}

std::filesystem::path ParamReader::existing_file(const Param& param, const std::string& name) const {
  for (const std::filesystem::path& place : places(param, name)) {
    std::error_code ignored;
    if (!name.empty() && seems_to_exist(place) && !std::filesystem::is_directory(place, ignored)) return place;
  }
  return {};
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

void ParamReader::finish() {
  if (described_) throw DescribedEnough{};
  const std::vector<Param>& params = list_->params;
  for (auto param = params.begin(); param != params.end(); ++param) {
    const std::string_view name = canonical(param->name);
    const auto first = std::find_if(params.begin(), param, [&](const Param& p) { return canonical(p.name) == name; });
    if (first != param) {
      diagnostics_.error(param->where, fmt::format("{} is given twice", quoted(param->name)),
                         fmt::format("first on line {}", first->where.line));
    } else if (!param->is_default && !contains(known_, name) && !contains(tolerated_, param->name)) {
      const std::string guess = did_you_mean(param->name, known_), all = describe_hint();
      diagnostics_.error(param->where, "unknown " + quoted(param->name),
                         guess.empty() ? all : fmt::format("{} ({})", guess, all));
    }
  }
  if (only_checks_) throw DescribedEnough{};
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

const Param* ParamReader::take(std::string_view name, const Types& types, std::string default_value,
                               std::string_view unit, std::string_view sentence) {
  if (described_) {
    described_->push_back(
        {words(types), std::string(name), std::move(default_value), std::string(unit), std::string(sentence)});
    return nullptr;
  }
  known_.emplace_back(name);
  const Param* param = find(name);
  if (!param) return nullptr;
  const auto allows = [&](ParamType type) { return std::find(types.begin(), types.end(), type) != types.end(); };
  if (!allows(param->type) && !(param->type == ParamType::integer && allows(ParamType::number))) {
    diagnostics_.error(param->where,
                       fmt::format("{} must be {}, not {}", quoted(param->name), words(types), word_of(param->type)));
    return nullptr;
  }
  if (fits(*param)) return param;
  diagnostics_.error(param->values_where, fmt::format("this is not a value for {}, which is of type {}",
                                                      quoted(param->name), word_of(param->type)));
  return nullptr;
}

const Param* ParamReader::take_some(std::string_view name, const Types& types, std::size_t count,
                                    std::string default_value, std::string_view unit, std::string_view sentence) {
  const Param* param = take(name, types, std::move(default_value), unit, sentence);
  return param && count_is(*param, count) ? param : nullptr;
}

std::vector<float> ParamReader::take_groups(std::string_view name, const Types& types, std::size_t size,
                                            std::string_view sentence) {
  const Param* param = take(name, types, "", {}, sentence);
  if (!param) return {};
  if (value_count(*param) % size == 0) return numbers_of(*param);
  diagnostics_.error(param->where, fmt::format("{} takes groups of {}, got {}", quoted(param->name), counted(size),
                                               value_count(*param)));
  return {};
}

bool ParamReader::count_is(const Param& param, std::size_t count) {
  if (value_count(param) == count) return true;
  diagnostics_.error(param.where,
                     fmt::format("{} takes {}, got {}", quoted(param.name), counted(count), value_count(param)));
  return false;
}

const Param* ParamReader::find(std::string_view name) const {
  if (!list_) return nullptr;
  const auto found = std::find_if(list_->params.begin(), list_->params.end(),
                                  [&](const Param& p) { return canonical(p.name) == name; });
  return found == list_->params.end() ? nullptr : &*found;
}

std::string_view ParamReader::canonical(std::string_view name) const {
  for (const auto& [alias, meant] : aliases_)
    if (alias == name) return meant;
  return name;
}

std::string ParamReader::quoted(std::string_view name) const {
  return fmt::format("parameter \"{}\" of {}", name, subject_);
}

/// From the subject `material "diffuse"`.
std::string ParamReader::describe_hint() const {
  const std::size_t quote = subject_.find(" \"");
  if (quote == subject_.npos) return known_.empty() ? "it has no parameters" : "known parameters: " + joined(known_);
  const std::string plugin = subject_.substr(quote + 2, subject_.size() - quote - 3);
  return fmt::format("dspm --describe {}:{} lists them all", subject_.substr(0, quote), plugin);
}

}  // namespace dspm
