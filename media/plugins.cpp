// The table of media: one line for each.
#include "dspm/media/medium.h"

namespace dspm {

MakeMedium make_cloud, make_homogeneous_medium, make_nanovdb, make_rgb_grid, make_uniform_grid;

PluginTable<Plugin<MakeMedium>>& medium_plugins() {
  static PluginTable<Plugin<MakeMedium>> table(
      "medium", {
                    {"cloud", "a cloud made of noise", make_cloud},
                    {"homogeneous", "the same everywhere: fog, milk, coloured glass", make_homogeneous_medium},
                    {"nanovdb", "smoke and flames from a NanoVDB file", make_nanovdb},
                    {"rgbgrid", "absorption and scattering by colour, on a grid", make_rgb_grid},
                    {"uniformgrid", "a density on a grid: smoke, and flames by their temperature", make_uniform_grid},
                });
  return table;
}

}  // namespace dspm
