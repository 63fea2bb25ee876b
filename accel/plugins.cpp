// The table of accelerators.
#include "dspm/accel/accel.h"
#include "dspm/accel/brute_force.h"
#include "dspm/accel/two_level.h"

namespace dspm {

PluginTable<AccelPlugin>& accel_plugins() {
  static PluginTable<AccelPlugin> table(
      "accelerator",
      {
          {{"two-level", "one tree over static objects, one over objects that differ between frames", make_two_level},
           two_level_bytes},
          {{"bruteforce", "tests every ray against every primitive; for tests", make_brute_force}, brute_force_bytes},
      });
  return table;
}

}  // namespace dspm
