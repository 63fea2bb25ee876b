// The table of accelerators.
#include "accel/accel.h"
#include "accel/brute_force.h"
#include "accel/two_level.h"

namespace dspm {

std::span<const Plugin<MakeAccel>> accel_plugins() {
  static constexpr Plugin<MakeAccel> plugins[] = {
      {"two-level", "a tree over what stands still, and one over what differs between frames", make_two_level},
      {"bruteforce", "every primitive against every ray; for tests", make_brute_force},
  };
  return plugins;
}

}  // namespace dspm
