#include "dspm/lang/gltf/known_extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "dspm/lang/gltf/draco.h"
#include "dspm/lang/gltf/meshopt.h"

namespace dspm::gltf {
namespace {

constexpr std::string_view kKnown[] = {
    "EXT_mesh_gpu_instancing", "EXT_texture_webp", "KHR_animation_pointer", "KHR_lights_punctual",
    "KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_iridescence",
    "KHR_materials_sheen", "KHR_materials_specular", "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_materials_variants", "KHR_materials_volume", "KHR_materials_volume_scatter", "KHR_mesh_quantization",
    "KHR_node_visibility", "KHR_texture_transform",
    // Without effect on pictures:
    "KHR_xmp_json_ld"};

bool is_read(const std::string& name) {
  if (name == "KHR_draco_mesh_compression") return reads_draco();
  if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression") return reads_meshopt();
  return std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown);
}

}  // namespace

std::vector<std::string> check_extensions(const Document& document) {
  const Value required = document["extensionsRequired"], used = document["extensionsUsed"];
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < required.size(); ++i)
    if (const std::string name = required[i].text(""); !is_read(name))
      throw std::runtime_error(fmt::format("it requires the extension {}, which dspm does not read", name));
  for (std::size_t i = 0; i < used.size(); ++i)
    if (const std::string name = used[i].text(""); !is_read(name))
      notes.push_back(fmt::format("the extension {} is left out", name));
  return notes;
}

}  // namespace dspm::gltf
