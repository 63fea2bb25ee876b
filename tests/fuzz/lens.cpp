// Lens files of the camera "realistic", and what rays do in such lenses.
#include <cmath>

#include "dspm/cameras/lens_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  try {
    LensSystem lens(parse_lens(fuzz::text(data, size)));
    lens.focus(2);
    for (const float x : {0.f, 0.003f, 0.02f})
      for (const float y : {0.f, 0.5f}) {
        const Vec3 from{x, 0, 0}, to{0, y * lens.rear_aperture(), lens.rear_z()};
        const auto passage = lens.from_film({from, to - from});
        fuzz::require(!passage || (is_finite(passage->ray.origin) && is_finite(passage->ray.direction)),
                      "a ray that leads nowhere");
      }
  } catch (const std::runtime_error&) {}
  return 0;
}
