// The tables of lights: one line for each.
#include "dspm/lights/light.h"

namespace dspm {

MakeLight make_diffuse_area, make_distant, make_goniometric, make_infinite, make_point, make_projection, make_spot;

PluginTable<Plugin<MakeLight>>& light_plugins() {
  static PluginTable<Plugin<MakeLight>> table(
      "light", {
                   {"distant", "parallel light from infinitely far away", make_distant},
                   {"goniometric", "a point light shaped by an image or an IES file", make_goniometric},
                   {"infinite", "light from all directions, of one colour or from an image", make_infinite},
                   {"point", "equal light in all directions from a point", make_point},
                   {"projection", "a point light that projects an image", make_projection},
                   {"spot", "a cone of light from a point", make_spot},
               });
  return table;
}

PluginTable<Plugin<MakeLight>>& area_light_plugins() {
  static PluginTable<Plugin<MakeLight>> table("area light",
                                              {{"diffuse", "makes a shape emit light", make_diffuse_area}});
  return table;
}

}  // namespace dspm
