#include "dspm/lang/gltf/translation.h"

#include <fmt/format.h>

#include "dspm/base/system/extension.h"
#include "dspm/lang/gltf/known_extensions.h"
#include "dspm/lang/gltf/scene_writer.h"

namespace dspm::gltf {

bool is_gltf_name(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".glb" || extension == ".gltf";
}

Translation translate(const std::filesystem::path& path, const std::string& folder, const Settings& settings) {
  return translate(std::make_shared<const Document>(path), folder, settings);
}

Translation translate(std::shared_ptr<const Document> document, const std::string& folder, const Settings& settings) {
  std::vector<std::string> notes = check_extensions(*document);
  Translation translation = SceneWriter(std::move(document), folder, settings).write();
  translation.notes.insert(translation.notes.begin(), notes.begin(), notes.end());
  return translation;
}

}  // namespace dspm::gltf
