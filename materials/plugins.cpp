// The table of materials: one line for each.
#include "dspm/materials/material.h"

namespace dspm {

MakeMaterial make_coatedconductor, make_coateddiffuse, make_conductor, make_dielectric, make_diffuse,
    make_diffusetransmission, make_hair, make_interface, make_measured, make_mix, make_principled, make_subsurface,
    make_thindielectric;

PluginTable<Plugin<MakeMaterial>>& material_plugins() {
  static PluginTable<Plugin<MakeMaterial>> table(
      "material",
      {
          {"coatedconductor", "metal under a clear coat, such as lacquered brass", make_coatedconductor},
          {"coateddiffuse", "a diffuse base under a clear coat, such as plastic", make_coateddiffuse},
          {"conductor", "metal, smooth or rough", make_conductor},
          {"dielectric", "glass or water, smooth or rough; light passes into the body", make_dielectric},
          {"diffuse", "matte, with equal radiance in all directions", make_diffuse},
          {"diffusetransmission", "matte on both sides and through, such as paper or a leaf", make_diffusetransmission},
          {"hair", "fibres of hair and fur, for curves", make_hair},
          {"interface", "nothing: light passes as if its shapes were not there", make_interface},
          {"measured", "a measured reflection from RGL's database", make_measured},
          {"mix", "one of two materials at each point, by chance", make_mix},
          {"principled", "paint, plastic, metal, glass, varnish or cloth, as in Blender and glTF", make_principled},
          {"subsurface", "a body that scatters light inside, such as milk, wax or skin", make_subsurface},
          {"thindielectric", "a pane of glass without thickness", make_thindielectric},
      });
  return table;
}

}  // namespace dspm
