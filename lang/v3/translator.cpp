#include "dspm/lang/v3/translator.h"

#include <fmt/format.h>

#include <iterator>

#include "dspm/base/params/params.h"

namespace dspm::v3 {
namespace {

using enum DirectiveKind;
/// Defines a name. v3 allows it to be defined again, and what follows then means the later one; v4 wants a new name.
void define(Argument& name, Translator::Defined& defined) {
  const int times = ++defined[name.text];
  if (times > 1) name.text += fmt::format(", {}", times);
}

void refer(std::string& name, const Translator::Defined& defined) {
  const auto found = defined.find(name);
  if (found != defined.end() && found->second > 1) name += fmt::format(", {}", found->second);
}

void refer(ParamList& params, ParamType type, std::string_view prefix, const Translator::Defined& defined) {
  for (Param& param : params.params) {
    auto* texts = std::get_if<std::vector<std::string>>(&param.values);
    if (texts == nullptr || param.type != type || !param.name.starts_with(prefix)) continue;
    for (std::string& text : *texts) refer(text, defined);
  }
}

void translate_one(Edit& edit) {
  switch (edit.directive().info->kind) {
    case material:
    case make_named_material: return translate_material(edit);
    case texture: return translate_texture(edit);
    case light_source:
    case area_light_source: return translate_light(edit);
    case make_named_medium: return translate_medium(edit);
    case shape: return translate_shape(edit);
    case camera:
    case film:
    case sampler:
    case pixel_filter:
    case integrator: return translate_option(edit);
    default: return;
  }
}

std::string joined(const std::set<std::string>& words) {
  constexpr std::size_t kMost = 500;  // bytes
  std::string text;
  for (const std::string& word : words) {
    if (text.size() > 0) text += ", ";
    if (text.size() > kMost) return text + "...";
    text += word;
  }
  return text;
}

}  // namespace

void Translator::rename(Directive& directive) {
  for (const Defined& textures : textures_) refer(directive.params, ParamType::texture, "", textures);
  refer(directive.params, ParamType::text, "namedmaterial", materials_);
  switch (directive.info->kind) {
    case make_named_material: return define(directive.words[0], materials_);
    case named_material: return refer(directive.words[0].text, materials_);
    case texture: return define(directive.words[0], textures_[directive.words[1].text == "float"]);
    case object_begin: return define(directive.words[0], objects_);
    case object_instance: return refer(directive.words[0].text, objects_);
    default: return;
  }
}

std::vector<Directive> Translator::translate(Directive directive) {
  rename(directive);
  Edit edit(directive, remarks_);
  translate_one(edit);
  std::vector<Directive> result = edit.take_before();
  std::vector<Directive> after = edit.take_after();
  result.push_back(std::move(directive));
  std::move(after.begin(), after.end(), std::back_inserter(result));
  return result;
}

std::string Translator::summary() const {
  std::string text = "this scene is written for pbrt-v3, and is read as its translation to pbrt-v4";
  if (!remarks_.only_close.empty()) text += "; only close: " + joined(remarks_.only_close);
  if (!remarks_.unknown.empty()) text += "; not known to v3 either: " + joined(remarks_.unknown);
  return text;
}

}  // namespace dspm::v3
