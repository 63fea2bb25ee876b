// Gzip-compressed files, as scenes and meshes may be.
#include "dspm/base/system/read_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  try {
    expand_gzip(std::string(fuzz::text(data, size)));
  } catch (const std::runtime_error&) {}
  return 0;
}
