// TIFF, WebP, QOI, BMP, PNM, PFM and TGA files: the corpus has small ones of each.
#include "tests/fuzz/image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dspm::fuzz::decode(dspm::fuzz::text(data, size));
  return 0;
}
