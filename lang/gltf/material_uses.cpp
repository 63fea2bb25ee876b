#include "dspm/lang/gltf/material_uses.h"

#include <algorithm>
#include <array>

namespace dspm::gltf {
namespace {

constexpr const char* kVariants = "KHR_materials_variants";

bool emits(const Value& material) {
  constexpr std::array<double, 3> kDark{};
  return material["emissiveFactor"].numbers(kDark) != kDark;
}

}  // namespace

MaterialUses::Key MaterialUses::key_of(const Value& primitive) const {
  const std::size_t materials = document_["materials"].size();
  Key key{primitive["material"].index(materials), {}, {}};
  const Value accessors = document_["accessors"];
  if (const auto colours = primitive["attributes"]["COLOR_0"].index(accessors.size()))
    key.look = {true, accessors[*colours]["type"].text("") == "VEC4"};
  const std::size_t variants = document_.root().extension(kVariants)["variants"].size();
  const Value mappings = primitive.extension(kVariants)["mappings"];
  for (std::size_t i = 0; i < mappings.size(); ++i)
    for (std::size_t j = 0; j < mappings[i]["variants"].size(); ++j)
      key.of_variant[mappings[i]["variants"][j].required_index(variants)] =
          mappings[i]["material"].required_index(materials);
  return key;
}

Value MaterialUses::material_of(std::optional<std::size_t> material, const Json& json) const {
  return Value(&json, "")["materials"][material ? *material : Value(&json, "")["materials"].size()];
}

std::string MaterialUses::name_of(const Value& primitive) {
  const Key key = key_of(primitive);
  const auto known = uses_.find(key);
  if (known != uses_.end()) return known->second;
  const std::string name =
      prefix_ + names_.add(material_of(key.material, document_.json())["name"].text(""), "material");
  const std::string definition = define(key.material, key.look);
  definitions_ += fmt::format("MakeNamedMaterial {}{}\n", in_quotes(name), definition);
  uses_[key] = name;
  if (!key.of_variant.empty()) replaceable_.emplace_back(key, name);
  return name;
}

std::string MaterialUses::medium_of(const Value& primitive) const {
  const auto own = media_.find(key_of(primitive).material);
  return own == media_.end() ? std::string() : own->second;
}

std::string MaterialUses::define(std::optional<std::size_t> material, const MeshLook& look) {
  std::string& known = defined_[{material, look}];
  if (!known.empty()) return known;
  const std::string place = fmt::format("materials/{}", material.value_or(0)), pointer = "/" + place + "/";
  const bool changes = material && std::any_of(animation_.channels.begin(), animation_.channels.end(),
                                               [&](const Channel& c) { return c.target().starts_with(pointer); });
  const std::string name =
      prefix_ + texture_names_.add(material_of(material, document_.json())["name"].text(""), "material");
  std::vector<Json> frames;
  MaterialForm form{changes};
  Json json = changes ? document_.json() : Json();
  for (int frame = 0; frame < (changes ? frames_ : 0); ++frame) {
    set_moment(json, animation_, frame / fps_);
    frames.push_back(material_of(material, json).json());
    form.emits = form.emits || emits(Value(&frames.back(), place));
  }
  std::vector<MaterialStatements> moments;
  for (const Json& moment : frames) moments.push_back(materials_.translate(Value(&moment, place), name, look, form));
  if (!changes) moments.push_back(materials_.translate(material_of(material, document_.json()), name, look));
  for (std::size_t i = 0; i < moments.front().textures.size(); ++i) {
    std::vector<Statement> texture;
    for (const MaterialStatements& moment : moments)
      texture.push_back(moment.textures[std::min(i, moment.textures.size() - 1)]);
    definitions_ += text_of(keyed(texture)) + "\n";
  }
  if (std::optional<Statement> medium = moments.front().medium; medium && !media_.contains(material)) {
    medium->head = fmt::format("MakeNamedMedium {} \"string type\" {}", in_quotes(name), medium->head);
    definitions_ += text_of(*medium) + "\n";
    media_[material] = name;
  }
  std::vector<Statement> statements;
  for (const MaterialStatements& moment : moments) statements.push_back(moment.material);
  Statement all = keyed(statements);
  all.head = " \"string type\" " + all.head;
  return known = text_of(all);
}

std::string MaterialUses::axis() {
  const Value variants = document_.root().extension(kVariants)["variants"];
  if (variants.size() == 0 || replaceable_.empty()) return {};
  Names names;
  std::string text;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    text += fmt::format("  VariationBegin {}\n",
                        in_quotes(names.add(for_variation(variants[i]["name"].text("")), "variant")));
    for (const auto& [key, name] : replaceable_)
      if (const auto own = key.of_variant.find(i); own != key.of_variant.end() && own->second != key.material)
        text += fmt::format("    MakeNamedMaterial {}{}\n", in_quotes(name), define(own->second, key.look));
    text += "  VariationEnd\n";
  }
  return fmt::format("AxisBegin {}\n{}AxisEnd\n",
                     in_quotes(prefix_.empty() ? "variant" : document_.path().stem().string()), text);
}

}  // namespace dspm::gltf
