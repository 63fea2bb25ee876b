// Where rays meet shapes, and the surfaces there: each kind of shape is met, placed in the world, left and sampled.
#include "words.h"

#include <optional>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/bilinearmesh.h"
#include "dspm/shapes/cylinder.h"
#include "dspm/shapes/disk.h"
#include "dspm/shapes/in_world.h"
#include "dspm/shapes/mesh_view.h"
#include "dspm/shapes/quadric.h"
#include "dspm/shapes/sphere.h"
#include "dspm/shapes/surface_geometry.h"
#include "dspm/shapes/triangle.h"

namespace dspm {

struct Place {
  Transform to_world;
  bool flips;
};

/// One primitive of a mesh, with the interface of quadrics.
struct OneTriangle {
  MeshView mesh;
  int face;

  constexpr std::optional<PrimitiveHit> intersect(const Ray& ray) const {
    return dspm::intersect(TriangleRay(ray), mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2),
                           ray.t_max);
  }
  constexpr SurfaceGeometry surface_point(Vec2 at) const { return mesh.surface_point(face, at); }
  constexpr float area() const { return mesh.area(face); }
  constexpr Vec2 sample_area(Vec2 u) const { return MeshView::sample_area(u); }
  constexpr std::optional<Vec2> area_numbers(const Vec3& p) const { return mesh.area_numbers(face, p); }
};

struct Input {
  Ray ray;
  Vec2 u;
  Place place;
  SphereSurface sphere;
  DiskSurface disk;
  CylinderSurface cylinder;
  OneTriangle triangle;
  PatchMeshView patches;
  int patch;
};
struct Result {
  float t, pdf_a;
  SurfaceGeometry met, sampled;
  Ray onward;
  Vec2 numbers;
};
struct Output {
  Result sphere, disk, cylinder, triangle, patch;
};

constexpr SurfaceGeometry placed(SurfaceGeometry s, const Place& place) {
  move_to_world(s, place.to_world);
  if (place.flips) flip_normals(s);
  return s;
}

template <class Surface>
constexpr Result result_of(const Surface& surface, const Input& in) {
  Result result{};
  const Transform& to_world = in.place.to_world;
  const std::optional<PrimitiveHit> hit = surface.intersect(to_world.inverse_ray(in.ray));
  result.t = hit ? hit->t : kInfinity;
  if (hit) result.met = placed(surface.surface_point(hit->uv), in.place);
  result.sampled = placed(surface.surface_point(surface.sample_area(in.u)), in.place);
  result.pdf_a = 1 / (surface.area() * area_scale(to_world, own_normal(to_world, result.sampled.ng)));
  result.onward = result.met.spawn(normalize(result.sampled.p - result.met.p));
  result.numbers = surface.area_numbers(to_world.inverse_point(result.sampled.p)).value_or(Vec2{});
  return result;
}

}  // namespace dspm

extern "C" __global__ void shapes(const dspm::Input* in, dspm::Output* out) {
  using namespace dspm;
  const Sweep half(180);
  out->sphere = result_of(in->sphere, *in);
  out->disk = result_of(in->disk, *in);
  out->cylinder = result_of(in->cylinder, *in);
  out->triangle = result_of(in->triangle, *in);
  out->patch = result_of(PatchSurface(in->patches, in->patch), *in);
  if (SphereSurface(in->u.x, 0, in->u.y, half).intersect(in->ray)) out->sphere.t = 0;
}
