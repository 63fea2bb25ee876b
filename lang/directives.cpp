#include "dspm/lang/directives.h"

#include <algorithm>

namespace dspm {
namespace {

using enum DirectiveKind;
using enum Section;

constexpr DirectiveInfo kDirectives[] = {
    {"Accelerator", accelerator, options, "sP"},
    {"ActiveTransform", active_transform, any, "w"},
    {"AreaLightSource", area_light_source, world, "sP"},
    {"Attribute", attribute, any, "sP"},
    {"AttributeBegin", attribute_begin, world, "", +1},
    {"AttributeEnd", attribute_end, world, "", -1},
    {"AxisBegin", axis_begin, world, "s", +1},
    {"AxisEnd", axis_end, world, "", -1},
    {"AxisExclude", axis_exclude, world, "sSSSSSSS"},
    {"AxisOnly", axis_only, world, "sSSSSSSS"},
    {"Camera", camera, options, "sP"},
    {"ColorSpace", color_space, any, "s"},
    {"ConcatTransform", concat_transform, any, "m"},
    {"CoordSysTransform", coord_sys_transform, any, "s"},
    {"CoordinateSystem", coordinate_system, any, "s"},
    {"Default", default_value, any, "wv"},
    {"DynamicBegin", dynamic_begin, world, "sP", +1},
    {"DynamicEnd", dynamic_end, world, "", -1},
    {"Film", film, options, "sP"},
    {"Frames", frames, options, "nP"},
    {"Hide", hide, world, "s"},
    {"Identity", identity, any, ""},
    {"Import", import, world, "sP"},
    {"Include", include, any, "sP"},
    {"Integrator", integrator, options, "sP"},
    {"Keyframe", keyframe, any, "kP"},
    {"KeyframeEnd", keyframe_end, any, "P"},
    {"Light", light, world, "sP"},
    {"LightSource", light_source, world, "sP"},
    {"LookAt", look_at, any, "aannn"},
    {"MakeNamedMaterial", make_named_material, world, "sP"},
    {"MakeNamedMedium", make_named_medium, any, "sP"},
    {"Material", material, world, "sP"},
    {"MediumInterface", medium_interface, any, "sS"},
    {"NamedMaterial", named_material, world, "s"},
    {"ObjectBegin", object_begin, world, "s", +1},
    {"ObjectEnd", object_end, world, "", -1},
    {"ObjectInstance", object_instance, world, "s"},
    {"Option", option, any, "sv"},
    {"PixelFilter", pixel_filter, options, "sP"},
    {"Plugin", plugin, any, "s"},
    {"ReverseOrientation", reverse_orientation, world, ""},
    {"Rotate", rotate, any, "nnnn"},
    {"Sampler", sampler, options, "sP"},
    {"Scale", scale, any, "nnn"},
    {"Shape", shape, world, "sP"},
    {"Show", show, world, "s"},
    {"Texture", texture, world, "sssP"},
    {"Transform", transform, any, "m"},
    {"TransformBegin", transform_begin, world, "", +1},
    {"TransformEnd", transform_end, world, "", -1},
    {"TransformTimes", transform_times, options, "nn"},
    {"Translate", translate, any, "nnn"},
    {"VariationBegin", variation_begin, world, "s", +1},
    {"VariationEnd", variation_end, world, "", -1},
    {"WorldBegin", world_begin, any, ""},
};

constexpr bool by_name(const DirectiveInfo& a, const DirectiveInfo& b) { return a.name < b.name; }
static_assert(std::is_sorted(std::begin(kDirectives), std::end(kDirectives), by_name));

}  // namespace

std::span<const DirectiveInfo> all_directives() { return kDirectives; }

const DirectiveInfo* find_directive(std::string_view name) {
  const auto found = std::lower_bound(std::begin(kDirectives), std::end(kDirectives), name,
                                      [](const DirectiveInfo& info, std::string_view n) { return info.name < n; });
  return found != std::end(kDirectives) && found->name == name ? found : nullptr;
}

std::vector<std::string> directive_names() {
  std::vector<std::string> names;
  for (const DirectiveInfo& info : kDirectives) names.emplace_back(info.name);
  return names;
}

bool moves(DirectiveKind kind) {
  switch (kind) {
    case translate:
    case rotate:
    case scale:
    case look_at:
    case transform:
    case concat_transform:
    case identity:
    case coord_sys_transform:
    case keyframe:
    case keyframe_end: return true;
    default: return false;
  }
}

}  // namespace dspm
