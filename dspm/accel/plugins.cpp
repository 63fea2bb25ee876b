// The table of accelerators.
#include "dspm/accel/accel.h"
#include "dspm/accel/brute_force.h"
#include "dspm/accel/two_level.h"

namespace dspm {

PluginTable<AccelPlugin>& accel_plugins() {
  static PluginTable<AccelPlugin> table(
      "accelerator",
      {
          {{"two-level", "a tree over what stands still, and one over what differs between frames", make_two_level},
           two_level_bytes},
          {{"bruteforce", "every primitive against every ray; for tests", make_brute_force}, brute_force_bytes},
      });
  return table;
}

}  // namespace dspm
