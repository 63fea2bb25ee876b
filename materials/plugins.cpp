// The table of materials: one line for each.
#include "materials/plugins.h"

namespace dspm {

std::span<const Plugin<MakeMaterial>> material_plugins() {
  static constexpr Plugin<MakeMaterial> table[] = {
      {"coateddiffuse", "a diffuse base under a clear coat, such as plastic", make_coateddiffuse},
      {"conductor", "metal, smooth or rough", make_conductor},
      {"dielectric", "glass or water, smooth or rough; light passes into the body", make_dielectric},
      {"diffuse", "matte, of equal radiance in all directions", make_diffuse},
      {"thindielectric", "a pane of glass without thickness", make_thindielectric},
  };
  return table;
}

std::span<const std::string_view> unbuilt_materials() {
  static constexpr std::string_view names[] = {
      "coatedconductor", "diffusetransmission", "subsurface", "hair", "measured", "mix", "interface"};
  return names;
}

}  // namespace dspm
