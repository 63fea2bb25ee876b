// The tables of lights: one line for each.
#include "lights/plugins.h"

namespace dspm {

std::span<const Plugin<MakeLight>> light_plugins() {
  static constexpr Plugin<MakeLight> table[] = {
      {"distant", "parallel light from infinitely far away", make_distant},
      {"infinite", "light from all directions, of one colour or an image", make_infinite},
      {"point", "equal light in all directions from a point", make_point},
      {"spot", "a cone of light from a point", make_spot},
  };
  return table;
}

std::span<const Plugin<MakeLight>> area_light_plugins() {
  static constexpr Plugin<MakeLight> table[] = {
      {"diffuse", "makes a shape shine", make_diffuse_area},
  };
  return table;
}

std::span<const std::string_view> unbuilt_lights() {
  static constexpr std::string_view names[] = {"goniometric", "projection"};
  return names;
}

}  // namespace dspm
