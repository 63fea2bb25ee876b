// pbrt-v3's materials as pbrt-v4's. v3 adds lobes, v4 stacks layers, so some only come close.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/only_text.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/v3/kinds.h"
#include "dspm/lang/v3/roughness.h"

namespace dspm::v3 {
namespace {

// clang-format off
constexpr Rule kMaterials[] = {
    {"matte", "diffuse", "Kd=reflectance sigma! bumpmap=displacement"},
    {"mirror", "conductor", "Kr=reflectance:rgb.9 bumpmap=displacement"},
    {"metal", "conductor", "eta k roughness:float.01 uroughness vroughness remaproughness bumpmap=displacement"},
    {"glass", "dielectric", "Kr:rgb1 Kt:rgb1 index=eta eta uroughness:float0 vroughness:float0 remaproughness "
                            "bumpmap=displacement"},
    {"plastic", "coateddiffuse", "Kd=reflectance:rgb.25 Ks:rgb.25 roughness:float.1 remaproughness "
                                 "bumpmap=displacement"},
    {"substrate", "coateddiffuse", "Kd=reflectance:rgb.5 Ks:rgb.5 uroughness:float.1 vroughness:float.1 remaproughness "
                                   "bumpmap=displacement"},
    {"uber", "coateddiffuse", "Kd=reflectance:rgb.25 Ks:rgb.25 Kr:rgb0 Kt:rgb0 roughness:float.1 uroughness vroughness "
                              "index=eta eta:float1.5 opacity remaproughness bumpmap=displacement"},
    {"translucent", "diffusetransmission", "Kd=reflectance:rgb.25 reflect:rgb.5 transmit:rgb.5 Ks! roughness= "
                                           "remaproughness= bumpmap=displacement"},
    {"mix", "mix", "namedmaterial1 namedmaterial2 amount:float.5"},
    {"hair", "hair", "sigma_a color=reflectance eumelanin pheomelanin eta beta_m beta_n alpha"},
    {"disney", "principled", "color=basecolor:rgb.5 metallic eta roughness:float.5 anisotropic=anisotropy sheen "
                             "clearcoat=coat clearcoatgloss:float1 spectrans=transmission speculartint:float0 "
                             "sheentint:float.5 scatterdistance! thin flatness difftrans:float1 bumpmap=displacement"},
    {"subsurface", "subsurface", "name sigma_a sigma_s scale eta g Kr! Kt! uroughness:float0 vroughness:float0 "
                                 "remaproughness bumpmap=displacement"},
    {"kdsubsurface", "subsurface", "Kd=reflectance:rgb.5 mfp scale eta g Kr! Kt! uroughness:float0 vroughness:float0 "
                                   "remaproughness bumpmap=displacement"},
    {"none", "interface", ""},
    {"", "interface", ""},
};
// clang-format on

/// Returns the eta of what reflects the share f0 head-on.
float eta_of(float f0) {
  const float root = std::sqrt(std::clamp(f0, 0.f, 0.36f));
  return (1 + root) / (1 - root);
}
float f0_of(float eta) { return (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1)); }

/// Adds a coat that reflects f0 head-on; none for 0.
void coat(Edit& edit, float f0) {
  if (f0 > 1e-5f) return edit.set_number("eta", eta_of(f0));
  edit.set_type("diffuse");
  for (const std::string_view name : {"eta", "roughness", "uroughness", "vroughness", "remaproughness"})
    edit.take(name);
}

/// Takes out the strength of a lobe; it is 1 for a texture.
float take_lobe_strength(Edit& edit, std::string_view name) {
  const auto value = edit.constant(name);
  edit.take(name);
  return value ? mean(*value) : 1;
}

void plastic(Edit& edit) {
  edit.only_close("plastic (its lobes become a coat over a matte ground)");
  coat(edit, take_lobe_strength(edit, "Ks") * f0_of(1.5f));
}

/// Translates a substrate: Ks is what it reflects head-on [Ashikhmin and Shirley 2000].
void substrate(Edit& edit) {
  edit.only_close("substrate (its lobes become a coat over a matte ground)");
  const bool is_texture = !edit.texture("Ks").empty();
  const float strength = take_lobe_strength(edit, "Ks");
  coat(edit, is_texture ? f0_of(1.5f) : strength);
}

/// Colours glass. Each time that light passes the surface, it is multiplied by `through`: principled's does so by the
/// root of its basecolor. Roughness is alpha by now, and principled's the root of it.
void colour_glass(Edit& edit, const Rgb& through) {
  edit.set_type("principled");
  edit.set_number("transmission", 1);
  edit.set_rgb("basecolor", through * through);
  const auto u = edit.constant("uroughness"), v = edit.constant("vroughness");
  const bool is_alpha = !edit.take_flag("remaproughness", true);
  if (!edit.texture("uroughness").empty() || !edit.texture("vroughness").empty() || u != v)
    edit.only_close("glass with Kt (of one roughness, and no texture of it)");
  edit.take("uroughness"), edit.take("vroughness");
  const float alpha = (mean(u.value_or(Rgb(0))) + mean(v.value_or(Rgb(0)))) / 2;
  edit.set_number("roughness", is_alpha ? std::sqrt(alpha) : std::sqrt(std::sqrt(alpha)));
}

/// Translates glass. What passes has the colour Kt; what is mirrored is as bright as glass mirrors, if it has any Kr.
void glass(Edit& edit) {
  const auto mirrored = edit.constant("Kr"), through = edit.constant("Kt");
  const bool is_given = mirrored != Rgb(1), is_texture = !through;
  edit.take("Kr"), edit.take("Kt");
  if (is_given) edit.only_close("glass (Kr has no effect)");
  if (is_texture) return edit.only_close("glass (Kt by a texture or a spectrum has no effect)");
  if (*through != Rgb(1)) colour_glass(edit, *through);
}

/// Mixes the material with nothing.
void make_see_through(Edit& edit, float opacity) {
  const std::string name = edit.name().empty() ? fmt::format("line {}", edit.where().line) : edit.name();
  const auto add = [&](const std::string& part, ParamList params) {
    Directive directive = edit.make("MakeNamedMaterial", {part});
    directive.params = std::move(params);
    edit.before(std::move(directive));
    return part;
  };
  ParamList opaque = std::move(edit.directive().params);
  edit.directive().params = {};
  const std::string type = edit.directive().info->name == "Material" ? edit.type() : "";
  if (!type.empty())
    opaque.params.insert(opaque.params.begin(), param_of(ParamType::text, "type", std::vector{type}, edit.where()));
  const ParamList nothing{{param_of(ParamType::text, "type", std::vector<std::string>{"interface"}, edit.where())}};
  const std::vector<std::string> parts{add(name + ", open", nothing), add(name + ", opaque", std::move(opaque))};
  edit.set_type("mix");
  edit.set(ParamType::text, "materials", parts);
  edit.set_number("amount", opacity);
}

void uber(Edit& edit) {
  const auto opacity = edit.constant("opacity");
  if (edit.find("opacity") != nullptr && !opacity) edit.only_close("uber (opacity by a texture has no effect)");
  edit.take("opacity");
  const auto matte = edit.constant("reflectance"), through = edit.constant("Kt");
  const float rough = take_lobe_strength(edit, "Ks"), smooth = take_lobe_strength(edit, "Kr"),
              eta = edit.number("eta").value_or(1.5f);
  edit.take("Kt");
  if (through && mean(*through) > (matte ? mean(*matte) : 1)) {
    edit.only_close("uber with Kt (smooth glass, without Kd and Ks)");
    edit.set_type("dielectric");
    for (const std::string_view name : {"reflectance", "roughness", "uroughness", "vroughness", "remaproughness"})
      edit.take(name);
    if (*through != Rgb(1)) colour_glass(edit, *through);
  } else {
    if (rough + smooth > 0) edit.only_close("uber (its lobes become a coat over a matte ground)");
    if (smooth > rough) {
      for (const std::string_view name : {"uroughness", "vroughness", "remaproughness"}) edit.take(name);
      edit.set_number("roughness", 0);
    }
    coat(edit, std::min(std::max(rough, smooth), 1.f) * f0_of(eta));
  }
  if (opacity && mean(*opacity) < 1) make_see_through(edit, mean(*opacity));
}

void translucent(Edit& edit) {
  const Rgb reflect = edit.constant("reflect").value_or(Rgb(0.5f));
  const Rgb transmit = edit.constant("transmit").value_or(Rgb(0.5f));
  if (!edit.texture("reflect").empty() || !edit.texture("transmit").empty())
    edit.only_close("translucent (textures of reflect and transmit have no effect)");
  edit.take("reflect"), edit.take("transmit");
  if (const auto kd = edit.constant("reflectance")) {
    edit.set_rgb("reflectance", *kd * reflect);
    edit.set_rgb("transmittance", *kd * transmit);
    return;
  }
  const std::string kd = edit.texture("reflectance");
  if (kd.empty()) return edit.only_close("translucent (its colour is a spectrum, which is not halved)");
  const auto scaled = [&](const Rgb& by) { return std::vector{scaled_texture(edit, "spectrum", kd, mean(by))}; };
  edit.set(ParamType::texture, "reflectance", scaled(reflect));
  if (mean(transmit) == mean(reflect))
    edit.set(ParamType::texture, "transmittance", std::vector{edit.texture("reflectance")});
  else
    edit.set(ParamType::texture, "transmittance", scaled(transmit));
}

/// Returns the tint of highlights and sheen: white, and the hue of the colour by `tint`. [pbrt-v3,
/// src/materials/disney.cpp]
Rgb tinted(Edit& edit, std::string_view tint) {
  const float share = edit.number(tint).value_or(0);
  edit.take(tint);
  const std::optional<Rgb> colour = edit.constant("basecolor");
  if (!colour || share == 0 || !(luminance(*colour) > 0)) return Rgb(1);
  return Rgb(1 - share) + *colour * (share / luminance(*colour));
}

/// Makes a thin wall, through which half of "difftrans" of the diffuse light goes; bodies have neither that nor
/// "flatness".
void thin_disney(Edit& edit) {
  const bool is_flat = edit.take("flatness").has_value(), is_thin = edit.take_flag("thin", false);
  const std::string texture = edit.texture("difftrans");
  const float through = mean(edit.constant("difftrans").value_or(Rgb(1)));
  edit.take("difftrans");
  if (!is_thin) return;
  if (is_flat) edit.only_close("disney (flatness has no effect)");
  edit.set(ParamType::boolean, "thin", std::vector{true});
  if (texture.empty())
    edit.set_number("diffusetransmission", 0.5f * through);
  else
    edit.set(ParamType::texture, "diffusetransmission", std::vector{scaled_texture(edit, "float", texture, 0.5f)});
}

/// Translates disney. v3's coat reflects a quarter of clear varnish, with an alpha from 0.1 to 0.001 [Burley 2012].
void disney(Edit& edit) {
  edit.only_close("disney (its coat is GGX)");
  const float gloss = edit.number("clearcoatgloss").value_or(1);
  edit.take("clearcoatgloss");
  if (const auto coat = edit.number("coat")) {
    edit.set_number("coat", 0.25f * *coat);
    edit.set_number("coatroughness", std::sqrt(std::lerp(0.1f, 0.001f, gloss)));
  }
  const Rgb specular_tint = tinted(edit, "speculartint"), sheen_tint = tinted(edit, "sheentint");
  if (specular_tint != Rgb(1)) edit.set_rgb("specularcolor", specular_tint);
  if (const auto sheen = edit.number("sheen")) {
    edit.take("sheen");
    edit.set_rgb("sheen", *sheen * sheen_tint);
  }
  thin_disney(edit);
}

/// Translates a mix, whose "amount" is that of the first material in v3, of the second in v4.
void mix(Edit& edit) {
  const std::string first = edit.take_text("namedmaterial1"), second = edit.take_text("namedmaterial2");
  edit.set(ParamType::text, "materials", std::vector{second, first});
  if (const auto amount = edit.constant("amount")) {
    if (mean(*amount) != amount->r) edit.only_close("mix (by a colour)");
    edit.take("amount");
    edit.set_number("amount", mean(*amount));
  }
}

/// Names metals: v3's folders of spectra hold what v4 knows by name: "spds/Au.eta.spd" is "metal-Au-eta".
void name_metals(Edit& edit) {
  constexpr std::string_view kMetals[] = {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"};
  for (const std::string& part : {std::string("eta"), std::string("k")}) {
    const Param* param = edit.find(part);
    const std::string* const name = only_text(param);
    if (name == nullptr || param->type != ParamType::spectrum) continue;
    const std::string file = std::filesystem::path(*name).filename().string();
    for (const std::string_view metal : kMetals)
      if (file == fmt::format("{}.{}.spd", metal, part))
        edit.set(ParamType::spectrum, part, std::vector{fmt::format("metal-{}-{}", metal, part)});
  }
}

void finish_material(Edit& edit, std::string_view from) {
  if (from == "glass") glass(edit);
  if (from == "plastic") plastic(edit);
  if (from == "substrate") substrate(edit);
  if (from == "uber") uber(edit);
  if (from == "translucent") translucent(edit);
  if (from == "mix") mix(edit);
  if (from == "disney") disney(edit);
  if (from == "mirror") edit.only_close("mirror (a little more at grazing angles)");
  if (from == "metal") name_metals(edit);
}

}  // namespace

void translate_material(Edit& edit) {
  const std::string from = edit.type();
  if (from == "fourier")
    throw NoCounterpart(edit.directive(), "material", from,
                        "pbrt-v4's nearest is \"measured\", with a file of its own");
  const auto* rule =
      std::find_if(std::begin(kMaterials), std::end(kMaterials), [&](const Rule& each) { return each.from == from; });
  if (rule == std::end(kMaterials)) return;
  edit.apply(*rule);
  if (rule->words.find("remaproughness") != rule->words.npos) convert_roughness(edit);
  finish_material(edit, from);
}

}  // namespace dspm::v3
