// RGL's files of measured materials.
#include <cmath>

#include "dspm/materials/measured/measured_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  try {
    const MeasuredFile file(decode_tensors(fuzz::text(data, size)));
    const Vec3 wo = normalize({0.3f, 0.2f, 0.7f}), wi = file.sample(wo, {0.4f, 0.6f});
    fuzz::require(!std::isnan(wi.z) && file.alpha() > 0, "a direction that is none");
    if (wi.z > 0) fuzz::require(!(file.density(wo, wi) < 0), "a negative density");
  } catch (const std::logic_error&) {
    throw;
  } catch (const std::exception&) {}
  return 0;
}
