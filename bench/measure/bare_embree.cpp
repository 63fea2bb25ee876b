#include "bench/measure/bare_embree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/shapes/triangle_mesh.h"

namespace dspm {
namespace {

RTCGeometry triangles_of(RTCDevice device, const TriangleMesh& mesh, const Transform& to_world) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                              sizeof(Vec3), mesh.vertices().size()));
  for (const Vec3& vertex : mesh.vertices()) *vertices++ = to_world.point(vertex);
  auto* faces = static_cast<Face*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Face), mesh.faces().size()));
  std::copy(mesh.faces().begin(), mesh.faces().end(), faces);
  return geometry;
}

/// 0 if the shape is no whole sphere.
float radius_of(const PlacedShape& placed) {
  if (placed.shape->primitive_count() != 1) return 0;
  const Bounds3 bounds = placed.bounds(0);
  const Vec3 size = bounds.high - bounds.low;
  const float r = size.x / 2, area = placed.shape->area(0) * placed.area_scale({1, 0, 0});
  const bool is_round = std::abs(size.y - size.x) + std::abs(size.z - size.x) < 1e-4f * size.x;
  return is_round && std::abs(area - 4 * kPi * r * r) < 1e-3f * area ? r : 0;
}

RTCGeometry sphere(RTCDevice device, const Bounds3& bounds, float radius) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* point = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
  const Vec3 center = bounds.center();
  point[0] = center.x, point[1] = center.y, point[2] = center.z, point[3] = radius;
  return geometry;
}

std::optional<PrimitiveHit> meet(const void* placed, unsigned primitive, const RTCRay& r) {
  const Ray ray{{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}, r.tfar};
  return static_cast<const PlacedShape*>(placed)->intersect(static_cast<int>(primitive), ray);
}

RTCGeometry foreign_shape(RTCDevice device, const PlacedShape& placed) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(placed.shape->primitive_count()));
  rtcSetGeometryUserData(geometry, const_cast<PlacedShape*>(&placed));
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* a) {
        const auto [low, high] =
            static_cast<const PlacedShape*>(a->geometryUserPtr)->bounds(static_cast<int>(a->primID));
        *a->bounds_o = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
      },
      nullptr);
  rtcSetGeometryIntersectFunction(geometry, [](const RTCIntersectFunctionNArguments* a) {
    auto& both = *reinterpret_cast<RTCRayHit*>(a->rayhit);
    const auto hit = meet(a->geometryUserPtr, a->primID, both.ray);
    if (!hit) return;
    both.ray.tfar = hit->t;
    both.hit.geomID = a->geomID, both.hit.primID = a->primID;
  });
  rtcSetGeometryOccludedFunction(geometry, [](const RTCOccludedFunctionNArguments* a) {
    auto& ray = *reinterpret_cast<RTCRay*>(a->ray);
    if (meet(a->geometryUserPtr, a->primID, ray)) ray.tfar = -kInfinity;
  });
  return geometry;
}

RTCGeometry geometry_of(RTCDevice device, const PlacedShape& placed) {
  if (const TriangleMesh* mesh = placed.shape->triangles()) return triangles_of(device, *mesh, placed.to_world);
  const float radius = radius_of(placed);
  return radius > 0 ? sphere(device, placed.bounds(0), radius) : foreign_shape(device, placed);
}

// Embree 4 wants no context.
void meet_nearest(RTCScene scene, RTCRayHit& both) {
#if DSPM_EMBREE == 3
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &both);
#else
  rtcIntersect1(scene, &both);
#endif
}

void meet_any(RTCScene scene, RTCRay& ray) {
#if DSPM_EMBREE == 3
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#else
  rtcOccluded1(scene, &ray);
#endif
}

}  // namespace

BareEmbree::BareEmbree(std::span<const PlacedShape> shapes)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  constexpr float kFirst = 1e-5f;  // of the scene's size
  Bounds3 bounds;
  for (const PlacedShape& placed : shapes) {
    for (int i = 0; i < placed.shape->primitive_count(); ++i) bounds.add(placed.bounds(i));
    const RTCGeometry geometry = geometry_of(device_.get(), placed);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_.get());
  first_ = bounds.empty() ? 0 : kFirst * length(bounds.high - bounds.low);
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::runtime_error("Embree could not build its tree");
}

RTCRay BareEmbree::prepared(const Ray& ray) const {
  RTCRay r{};
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = first_, r.tfar = ray.t_max;
  r.mask = ~0u;
  return r;
}

float BareEmbree::nearest(const Ray& ray) const {
  RTCRayHit both{prepared(ray), {}};
  both.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  meet_nearest(scene_.get(), both);
  return both.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kInfinity : both.ray.tfar;
}

bool BareEmbree::occluded(const Ray& ray) const {
  RTCRay r = prepared(ray);
  meet_any(scene_.get(), r);
  return r.tfar < 0;
}

}  // namespace dspm
