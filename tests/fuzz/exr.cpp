// OpenEXR files: what we hand to the library, and what comes back.
#include "tests/fuzz/image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dspm::fuzz::decode(dspm::fuzz::text(data, size));
  return 0;
}
