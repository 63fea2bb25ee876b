#include "dspm/lang/v3/roughness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "dspm/base/math/rounded.h"
#include "dspm/base/params/params.h"

namespace dspm::v3 {
namespace {

constexpr std::string_view kRoughness[] = {"roughness", "uroughness", "vroughness"};

/// v3 fitted the Beckmann-like width to "roughness" by this polynomial; v4 takes the root
/// [pbrt-v3, src/core/microfacet.h, RoughnessToAlpha].
float alpha_of(float roughness) {
  const float x = rounded::log(std::max(roughness, 1e-3f));
  return 1.62142f + 0.819955f * x + 0.1734f * x * x + 0.0171201f * x * x * x + 0.000640711f * x * x * x * x;
}

/// The root of 2.13 r is within a tenth of the polynomial from r = 0.01 to 0.5.
constexpr float kLikeRoot = 2.13f;

}  // namespace

std::string scaled_texture(Edit& edit, std::string_view type, const std::string& of, float by) {
  const SourceLocation& where = edit.where();
  const std::string file = where.file != nullptr ? std::filesystem::path(where.file->name).stem().string() : "";
  const std::string name = fmt::format("{} * {:.3g}, {}:{}", of, by, file, where.line);
  if (edit.is_before(name)) return name;
  Directive texture = edit.make("Texture", {name, std::string(type), "scale"});
  texture.params.params = {param_of(ParamType::texture, "tex", std::vector{of}, where),
                           param_of(ParamType::number, "scale", std::vector{by}, where)};
  edit.before(std::move(texture));
  return name;
}

void convert_roughness(Edit& edit) {
  const bool remap = edit.take_flag("remaproughness", true);
  bool has_texture = false, has_number = false;
  for (const std::string_view name : kRoughness) {
    has_texture = has_texture || !edit.texture(name).empty();
    has_number = has_number || edit.number(name);
  }
  if (!has_number && !has_texture) return;
  const bool is_specular = edit.type() != "conductor" && edit.type() != "coateddiffuse" && !has_texture &&
                           edit.number("uroughness").value_or(0) == 0 && edit.number("vroughness").value_or(0) == 0;
  for (const std::string_view name : kRoughness) {
    if (const auto value = edit.number(name)) {
      const float alpha = is_specular ? 0 : remap ? alpha_of(*value) : *value;
      edit.set_number(std::string(name), remap && has_texture ? alpha * alpha : alpha);
    } else if (const std::string texture = edit.texture(name); remap && !texture.empty()) {
      edit.set(ParamType::texture, std::string(name), std::vector{scaled_texture(edit, "float", texture, kLikeRoot)});
      edit.only_close("roughness by textures");
    }
  }
  if (is_specular) return edit.take("uroughness"), edit.take("vroughness"), void();
  edit.set(ParamType::boolean, "remaproughness", std::vector<bool>{remap && has_texture});
}

}  // namespace dspm::v3
