#include "dspm/lang/gltf/draco.h"

#ifdef DSPM_DRACO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
#pragma GCC diagnostic ignored "-Woverloaded-virtual"
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#pragma GCC diagnostic pop
#endif

namespace dspm::gltf {

#ifdef DSPM_DRACO
namespace {

Numbers numbers_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute) {
  Numbers numbers{mesh.num_points(), static_cast<std::size_t>(attribute.num_components()), {}};
  numbers.values.resize(numbers.count * numbers.width);
  for (std::size_t i = 0; i < numbers.count; ++i) {
    const auto value = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    attribute.ConvertValue<float>(value, static_cast<std::int8_t>(numbers.width),
                                  numbers.values.data() + i * numbers.width);
  }
  return numbers;
}

}  // namespace

bool reads_draco() { return true; }

DracoMesh decode_draco(const Document& document, const Value& how) {
  const View view = document.view(how["bufferView"].required_index(document["bufferViews"].size()));
  draco::DecoderBuffer buffer;
  buffer.Init(view.bytes.data(), view.bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) how.fail("Draco says: " + decoded.status().error_msg_string());
  const draco::Mesh& mesh = *decoded.value();

  DracoMesh result;
  const Value attributes = how["attributes"];
  for (const std::string& name : attributes.keys()) {
    const auto* const attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(attributes[name].count(0)));
    if (attribute == nullptr) attributes[name].fail("the compressed data has no such attribute");
    result.attributes[name] = numbers_of(mesh, *attribute);
  }
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      result.corners.push_back(mesh.face(draco::FaceIndex(i))[static_cast<std::size_t>(corner)].value());
  return result;
}
#else
bool reads_draco() { return false; }

DracoMesh decode_draco(const Document&, const Value& how) {
  how.fail("this dspm was built without Draco (libdraco-dev)");
}
#endif

}  // namespace dspm::gltf
