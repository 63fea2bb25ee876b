// Where the meshes of a sequence are, whichever of its files are read.
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

/// The parameter for the world, which takes the box for the meshes that it need not read.
inline constexpr const char* kExtentParam = "extent";

/// Returns the box; nullopt if there is none, or it is not sound, which the plugin reports.
inline std::optional<Bounds3> extent_in(const ParamList& params) {
  const Param* const param = params.find(kExtentParam);
  const auto* const n = param != nullptr ? std::get_if<std::vector<float>>(&param->values) : nullptr;
  if (n == nullptr || n->size() != 6) return std::nullopt;
  Bounds3 box;
  for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) box.add(Vec3{(*n)[i], (*n)[i + 1], (*n)[i + 2]});
  return box;
}

inline bool holds(const Bounds3& box, const std::vector<Vec3>& points) {
  Bounds3 wider = box;
  for (const Vec3& p : points) wider.add(p);
  return wider.low == box.low && wider.high == box.high;
}

/// Returns the box's surface.
inline MeshData mesh_of(const Bounds3& box) {
  MeshData mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                             corner & 4 ? box.high.z : box.low.z});
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

}  // namespace dspm
