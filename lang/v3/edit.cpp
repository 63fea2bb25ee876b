#include "dspm/lang/v3/edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "dspm/base/params/only_text.h"

namespace dspm::v3 {
namespace {

bool is_named(const Directive& directive) { return directive.info->name.starts_with("MakeNamed"); }

bool is_material(const Directive& directive) {
  return directive.info->kind == DirectiveKind::material || is_named(directive);
}

std::string in_its_place(const Directive& directive) {
  if (directive.info->kind == DirectiveKind::texture) return "it is 1 everywhere";
  return is_material(directive) ? "it is diffuse and grey" : "it is left out";
}

}  // namespace

NoCounterpart::NoCounterpart(const Directive& directive, std::string_view kind, const std::string& type,
                             const std::string& way_out)
    : SyntaxError(directive.where, fmt::format("pbrt-v3's {} \"{}\" cannot be translated", kind, type),
                  way_out + "; with --lenient, " + in_its_place(directive)) {
  const bool is_texture = directive.info->kind == DirectiveKind::texture;
  if (!is_texture && !is_material(directive)) return;
  Directive plain;
  plain.info = directive.info;
  plain.where = directive.where;
  plain.words = directive.words;
  Remarks ignored;
  Edit(plain, ignored).set_type(is_texture ? "constant" : "diffuse");
  instead.push_back(std::move(plain));
}

/// One word of a rule.
struct Edit::Word {
  enum class Does { keep, rename, drop, lose };

  explicit Word(std::string_view word) {
    const std::size_t colon = std::min(word.find(':'), word.size());
    fallback = word.substr(colon);
    word = word.substr(0, colon);
    const std::size_t mark = std::min(word.find_first_of("=!"), word.size());
    from = word.substr(0, mark);
    if (mark == word.size()) return;
    to = word.substr(mark + 1);
    does = word[mark] == '!' ? Does::lose : to.empty() ? Does::drop : Does::rename;
  }

  std::string_view name() const { return does == Does::rename ? to : from; }

  std::string_view from, to, fallback;  // fallback: `:rgb.5`
  Does does = Does::keep;
};

std::string Edit::type() const {
  if (!is_named(directive_)) return directive_.words.back().text;
  const std::string* const type = only_text(find("type"));
  return type != nullptr ? *type : "";
}

void Edit::set_type(std::string_view type) {
  if (is_named(directive_))
    set(ParamType::text, "type", std::vector{std::string(type)});
  else
    directive_.words.back().text = type;
}

std::string Edit::name() const {
  const bool has_one = is_named(directive_) || directive_.info->kind == DirectiveKind::texture;
  return has_one ? directive_.words.front().text : "";
}

void Edit::apply(const Rule& rule) {
  std::vector<Word> words;
  for (std::string_view rest = rule.words; !rest.empty();) {
    const std::size_t blank = std::min(rest.find(' '), rest.size());
    words.emplace_back(rest.substr(0, blank));
    rest.remove_prefix(std::min(blank + 1, rest.size()));
  }
  std::erase_if(directive_.params.params, [&](const Param& param) {
    if (param.is_default || (is_named(directive_) && param.name == "type")) return false;
    if (std::any_of(words.begin(), words.end(), [&](const Word& word) { return word.from == param.name; }))
      return false;
    remarks_.unknown.insert(fmt::format("{} of {}", param.name, rule.from));
    return true;
  });
  for (const Word& word : words) {
    if (word.does == Word::Does::lose && find(word.from) != nullptr)
      only_close(fmt::format("{} ({} has no effect)", rule.from, word.from));
    apply(word);
  }
  if (!rule.to.empty()) set_type(rule.to);
}

void Edit::apply(const Word& word) {
  if (word.does == Word::Does::drop || word.does == Word::Does::lose) {
    take(word.from);
    return;
  }
  for (Param& param : directive_.params.params)
    if (param.name == word.from) param.name = word.name();
  if (word.fallback.empty() || find(word.name()) != nullptr) return;
  const std::size_t digits = word.fallback.find_first_of("0123456789.-");
  const std::string_view type = word.fallback.substr(1, digits - 1);
  float value = 0;
  std::from_chars(word.fallback.data() + digits, word.fallback.data() + word.fallback.size(), value);
  if (type == "integer")
    set(ParamType::integer, std::string(word.name()), std::vector{static_cast<int>(value)});
  else if (type == "rgb")
    set_rgb(std::string(word.name()), Rgb(value));
  else
    set_number(std::string(word.name()), value);
}

std::optional<Param> Edit::take(std::string_view name) {
  auto& params = directive_.params.params;
  const auto found = std::find_if(params.begin(), params.end(), [&](const Param& p) { return p.name == name; });
  if (found == params.end()) return std::nullopt;
  Param taken = std::move(*found);
  params.erase(found);
  return taken;
}

std::string Edit::take_text(std::string_view name) {
  const std::optional<Param> param = take(name);
  const auto* texts = param ? std::get_if<std::vector<std::string>>(&param->values) : nullptr;
  return texts != nullptr && !texts->empty() ? texts->front() : "";
}

bool Edit::take_flag(std::string_view name, bool fallback) {
  const std::optional<Param> param = take(name);
  const auto* flags = param ? std::get_if<std::vector<bool>>(&param->values) : nullptr;
  return flags != nullptr && flags->size() == 1 ? flags->front() : fallback;
}

std::string Edit::texture(std::string_view name) const {
  const Param* param = find(name);
  if (param == nullptr || param->type != ParamType::texture) return "";
  const auto& texts = std::get<std::vector<std::string>>(param->values);
  return texts.empty() ? "" : texts.front();
}

std::optional<Rgb> Edit::constant(std::string_view name) const {
  const Param* param = find(name);
  const auto* values = param != nullptr ? std::get_if<std::vector<float>>(&param->values) : nullptr;
  if (values == nullptr) return std::nullopt;
  if (param->type == ParamType::number && values->size() == 1) return Rgb(values->front());
  if (param->type == ParamType::rgb && values->size() == 3) return Rgb((*values)[0], (*values)[1], (*values)[2]);
  return std::nullopt;
}

std::optional<float> Edit::number(std::string_view name) const {
  const Param* param = find(name);
  if (param == nullptr || param->type != ParamType::number) return std::nullopt;
  const auto c = constant(name);
  return c ? std::optional(c->r) : std::nullopt;
}

void Edit::set(ParamType type, std::string name, Param::Values values) {
  for (Param& param : directive_.params.params)
    if (param.name == name) {
      param.type = type;
      param.values = std::move(values);
      return;
    }
  directive_.params.params.push_back(param_of(type, std::move(name), std::move(values), directive_.where));
}

bool Edit::is_before(std::string_view defined) const {
  return std::any_of(before_.begin(), before_.end(),
                     [&](const Directive& each) { return !each.words.empty() && each.words.front().text == defined; });
}

Directive Edit::make(std::string_view name, const std::vector<std::string>& words) const {
  Directive directive;
  directive.info = find_directive(name);
  directive.where = directive_.where;
  for (const std::string& word : words) directive.words.push_back({word, directive_.where});
  return directive;
}

}  // namespace dspm::v3
