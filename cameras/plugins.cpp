// The table of cameras: one line for each.
#include "cameras/plugins.h"

namespace dspm {

std::span<const Plugin<MakeCamera>> camera_plugins() {
  static constexpr Plugin<MakeCamera> table[] = {
      {"orthographic", "parallel rays, with an optional thin lens", make_orthographic},
      {"perspective", "a pinhole or a thin lens", make_perspective},
  };
  return table;
}

std::span<const std::string_view> unbuilt_cameras() {
  static constexpr std::string_view names[] = {"realistic", "spherical"};
  return names;
}

}  // namespace dspm
