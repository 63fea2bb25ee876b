// The triangles of one primitive of a mesh, and how its vertices move.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/transform.h"
#include "dspm/lang/gltf/accessor.h"

namespace dspm::gltf {

/// The attributes of a primitive. They are empty if the file has none; otherwise there is one element for each vertex.
struct Primitive {
  struct Target {
    Numbers positions, normals, tangents;  // what one whole weight adds
  };

  Numbers positions, normals, tangents, uvs, uvs2, colours;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<Target> targets;
  std::vector<Numbers> joints, weights;  // four to each element, one or two sets

  bool has_opacities() const { return colours.width == 4; }
};

/// Returns whether the mode has surfaces; points and lines have none.
bool has_surface(const Value& primitive);

/// Throws std::runtime_error.
Primitive read_primitive(const Document& document, const Value& primitive);

/// Returns some of its vertices, without what only surfaces have, to see where they go.
Primitive vertices_of(const Primitive& primitive, const std::vector<std::size_t>& chosen);

/// Moves the vertices by morph targets, then by joints. `skin` has a matrix for each joint; it is empty if the
/// primitive is not skinned.
void pose(Primitive& primitive, const std::vector<double>& weights, const std::vector<Matrix4>& skin);

/// Writes a binary PLY file with the properties of dspm's plymesh. Pictures hang from (0, 1) in glTF, and stand on (0,
/// 0) there.
std::string ply_of(const Primitive& primitive);

}  // namespace dspm::gltf
