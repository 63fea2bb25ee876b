// PLY files, to a mesh that is whole.
#include "dspm/shapes/ply.h"

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  try {
    const TriangleMesh mesh(read_ply(fuzz::text(data, size)));
    for (int i = 0; i < mesh.primitive_count(); ++i) fuzz::require(mesh.area(i) >= 0, "an area below nothing");
  } catch (const std::runtime_error&) {
  } catch (const std::invalid_argument&) {}
  return 0;
}
