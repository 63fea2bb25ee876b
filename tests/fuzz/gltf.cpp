// glTF files, binary or not, with everything that a scene would read of them. No other file is there.
#include "dspm/lang/gltf/document.h"
#include "dspm/lang/gltf/translation.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  try {
    const auto document =
        std::make_shared<const gltf::Document>("/nowhere/fuzz.glb", std::string(fuzz::text(data, size)));
    gltf::Settings settings;
    settings.around = gltf::Around{3, 2.0};
    const gltf::Translation translation = gltf::translate(document, "fuzz.glb", settings);
    int most = 16;
    for (const auto& [name, bytes] : translation.files) try {
        if (most-- == 0) break;
        bytes();
      } catch (const std::runtime_error&) {}
  } catch (const std::runtime_error&) {}
  return 0;
}
