// ParamReader: each read looks up its parameter, checks type and count, and records it for --describe; in the end, what
// was not read is wrong.
#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/params/params.h"

namespace dspm {
namespace {

std::string words(const std::vector<ParamType>& types) {
  std::string text;
  for (std::size_t i = 0; i < types.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : i + 1 < types.size() ? ", " : " or ", word_of(types[i]));
  return text;
}

/// Returns whether the values match the parameter's type.
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

std::string joined(const std::vector<std::string>& texts) { return fmt::format("{}", fmt::join(texts, ", ")); }

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

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

const Param* ParamReader::take(std::string_view name, const Types& types, std::string default_value,
                               std::string_view unit, std::string_view sentence) {
  if (described_) {
    described_->push_back(
        {words(types), std::string(name), std::move(default_value), std::string(unit), std::string(sentence)});
    for (const auto& [alias, meant] : aliases_)
      if (meant == name) described_->back().sentence += fmt::format(" (or \"{}\")", alias);
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
  const auto is_it = [&](const Param& p) { return aliases_.empty() ? p.name == name : canonical(p.name) == name; };
  const auto found = std::find_if(list_->params.begin(), list_->params.end(), is_it);
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

/// Makes the hint from the subject `material "diffuse"`.
std::string ParamReader::describe_hint() const {
  const std::size_t quote = subject_.find(" \"");
  if (quote == subject_.npos) return known_.empty() ? "it has no parameters" : "known parameters: " + joined(known_);
  const std::string plugin = subject_.substr(quote + 2, subject_.size() - quote - 3);
  return fmt::format("dspm --describe {}:{} lists them all", subject_.substr(0, quote), plugin);
}

}  // namespace dspm
