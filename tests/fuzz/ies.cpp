// Lamp makers' photometric files.
#include "dspm/lights/ies.h"

#include <cmath>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  try {
    const Photometry photometry = parse_ies(fuzz::text(data, size));
    for (const float from_down : {0.f, 33.f, 90.f, 180.f})
      for (const float around : {0.f, 45.f, 135.f, 200.f, 300.f, 360.f}) {
        const float intensity = photometry.intensity(from_down, around);
        fuzz::require(intensity >= 0 && std::isfinite(intensity), "an intensity that no lamp has");
      }
  } catch (const std::runtime_error&) {}
  return 0;
}
