// Scenes made here for the measurement of partition queries: nothing but placed shapes and a place to look from.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/placed_shape.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {

struct QueryScene {
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<PlacedShape> placed;
  FrameSet all;
  Vec3 eye, look_at;

  void add(MeshData mesh, FrameSet frames) { add(TriangleMesh(std::move(mesh)), frames); }
  void add(TriangleMesh mesh, FrameSet frames);
  void place(const Shape& shape, const Transform& to_world, FrameSet frames);
};

/// 20K triangles of waves that move a little every frame, over the bottom of a pool.
std::unique_ptr<QueryScene> query_water(int frame_count);

/// A body of 10K triangles that runs, rigid or deforming, through a hall of 80K.
std::unique_ptr<QueryScene> query_body(int frame_count, bool deforming);

/// A surface over [0, 1]^2 in `n` by `n` quads.
MeshData surface(int n, const std::function<Vec3(float u, float v)>& at);

}  // namespace dspm
