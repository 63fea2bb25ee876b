// The table of cameras: one line for each.
#include "dspm/cameras/camera.h"

namespace dspm {

MakeCamera make_orthographic, make_perspective, make_realistic, make_spherical;

PluginTable<Plugin<MakeCamera>>& camera_plugins() {
  static PluginTable<Plugin<MakeCamera>> table(
      "camera", {
                    {"orthographic", "parallel rays, with an optional thin lens", make_orthographic},
                    {"perspective", "a pinhole or a thin lens", make_perspective},
                    {"realistic", "a lens of glass, surface by surface", make_realistic},
                    {"spherical", "sees all around from one point", make_spherical},
                });
  return table;
}

}  // namespace dspm
