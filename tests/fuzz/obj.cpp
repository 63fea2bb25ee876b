// OBJ files and, behind a zero byte, the MTL file that they name.
#include "dspm/shapes/obj.h"

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  const std::string_view text = fuzz::text(data, size);
  const std::size_t border = std::min(text.find('\0'), size);
  const std::string materials(text.substr(std::min(border + 1, size)));
  try {
    for (const bool split : {true, false}) {
      ObjFile file = parse_obj(
          std::string(text.substr(0, border)), "/nowhere", [&](const std::string&) { return materials; }, "", split);
      for (ObjMesh& each : file.meshes) {
        if (fault_of(each.mesh)) continue;
        const TriangleMesh mesh(std::move(each.mesh));
        for (int i = 0; i < mesh.primitive_count(); ++i) fuzz::require(mesh.area(i) >= 0, "an area below nothing");
      }
    }
  } catch (const std::runtime_error&) {}
  return 0;
}
