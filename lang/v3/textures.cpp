// pbrt-v3's textures as pbrt-v4's.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "dspm/base/system/extension.h"
#include "dspm/lang/v3/kinds.h"

namespace dspm::v3 {
namespace {

#define DSPM_MAPPING " mapping uscale vscale udelta vdelta v1 v2"
constexpr Rule kTextures[] = {
    {"constant", "", "value"},
    {"scale", "", "tex1 tex2"},
    {"mix", "", "tex1 tex2 amount"},
    {"bilerp", "", "v00 v01 v10 v11" DSPM_MAPPING},
    {"imagemap", "", "filename wrap scale gamma trilinear maxanisotropy" DSPM_MAPPING},
    {"checkerboard", "", "dimension tex1 tex2 aamode=" DSPM_MAPPING},
    {"dots", "", "inside outside" DSPM_MAPPING},
    {"fbm", "", "octaves roughness"},
    {"wrinkled", "", "octaves roughness"},
    {"windy", "", ""},
    {"marble", "", "octaves roughness scale variation"},
    {"ptex", "", "filename gamma"},
    {"uv", "bilerp", "mapping uscale vscale udelta vdelta v1 v2"},
};
#undef DSPM_MAPPING

/// Sets the encoding: v3 decodes sRGB by default from PNG and TGA, v4 from all integers.
void imagemap(Edit& edit) {
  const Param* name = edit.find("filename");
  const auto* texts = name != nullptr ? std::get_if<std::vector<std::string>>(&name->values) : nullptr;
  const std::string ending = texts != nullptr && !texts->empty() ? extension_of(texts->front()) : "";
  const bool is_srgb = ending == ".png" || ending == ".tga";
  const Param* const gamma = edit.find("gamma");
  const bool is_flag = gamma != nullptr && gamma->type == ParamType::boolean;
  if (gamma != nullptr && !is_flag) edit.not_known(fmt::format("{} gamma of imagemap", word_of(gamma->type)));
  const bool decodes = edit.take_flag("gamma", is_srgb);
  if (is_flag && decodes != is_srgb)
    edit.set(ParamType::text, "encoding", std::vector<std::string>{decodes ? "sRGB" : "linear"});
  if (edit.take_flag("trilinear", false)) edit.set(ParamType::text, "filter", std::vector<std::string>{"trilinear"});
}

/// Translates a product, because v4 multiplies a texture by a texture of numbers only.
void translate_scale(Edit& edit) {
  const bool is_colour = edit.directive().words[1].text == "spectrum";
  const auto rename = [&](std::string_view from, const std::string& to) {
    if (auto param = edit.take(from)) {
      param->name = to;
      edit.directive().params.params.push_back(*std::move(param));
    }
  };
  const bool first_is_factor = edit.constant("tex1") && !edit.constant("tex2");
  rename(first_is_factor ? "tex2" : "tex1", "tex");
  rename(first_is_factor ? "tex1" : "tex2", "scale");
  if (!is_colour) return;
  if (const auto factor = edit.constant("scale")) {
    const bool is_grey = factor->r == factor->g && factor->g == factor->b;
    if (is_grey) return edit.set_number("scale", factor->r);
    if (const auto whole = edit.constant("tex")) {
      edit.set_rgb("tex", *whole * *factor);
      edit.take("scale");
      return;
    }
    edit.only_close("scale (by a colour)");
    edit.set_number("scale", mean(*factor));
  } else if (!edit.texture("scale").empty()) {
    throw SyntaxError(edit.find("scale")->where, "pbrt-v4 cannot multiply two textures of colours",
                      "one of them must become a \"float\" texture");
  }
}

/// Translates uv: red is s, green is t, and v3 takes their fractions.
void uv(Edit& edit) {
  edit.only_close("uv (it does not repeat outside of 0 to 1)");
  for (const float s : {0.f, 1.f})
    for (const float t : {0.f, 1.f}) edit.set_rgb(fmt::format("v{}{}", s, t), {s, t, 0});
}

/// Lays the texture flat: v3 projects along axes of the world, whatever the transform in force.
void lay_flat_in_world(Edit& edit) {
  const Param* const mapping = edit.find("mapping");
  const auto* texts = mapping != nullptr ? std::get_if<std::vector<std::string>>(&mapping->values) : nullptr;
  if (texts == nullptr || texts->empty() || texts->front() != "planar") return;
  edit.before(edit.make("TransformBegin", {}));
  edit.before(edit.make("Identity", {}));
  edit.after(edit.make("TransformEnd", {}));
}

}  // namespace

void translate_texture(Edit& edit) {
  Argument& values = edit.directive().words[1];
  if (values.text == "color") values.text = "spectrum";
  const std::string from = edit.type();
  const auto* rule =
      std::find_if(std::begin(kTextures), std::end(kTextures), [&](const Rule& each) { return each.from == from; });
  if (rule == std::end(kTextures)) return;
  edit.apply(*rule);
  if (from == "imagemap") imagemap(edit);
  if (from == "scale") translate_scale(edit);
  if (from == "uv") uv(edit);
  if (from == "ptex")
    if (const auto gamma = edit.number("gamma")) {
      edit.take("gamma");
      edit.set(ParamType::text, "encoding", std::vector{fmt::format("gamma {}", *gamma)});
    }
  lay_flat_in_world(edit);
}

}  // namespace dspm::v3
