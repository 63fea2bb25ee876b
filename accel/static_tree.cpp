#include "accel/static_tree.h"

#include <embree3/rtcore.h>

#include <stdexcept>
#include <string>

namespace dspm {
namespace {

// Where Embree stops a ray is not as certain as our own boxes are: it culls nodes that begin behind tfar by its own
// arithmetic. So tfar stays this much behind the nearest hit.
constexpr float kBehind = 1 + 0x1p-20f;
// Our boxes' margin grows with the ray's origin, Embree's boxes cannot. Theirs is enough for origins up to kReach times
// as far from the world's origin as the scene's farthest corner; ours takes the rays from farther off.
constexpr float kReach = 8;

/// A ray on its way through Embree: its context carries along what our own test needs.
template <class Query>
struct Passage {
  RTCIntersectContext context;  // first: Embree hands its address to the callback
  const TrianglePacket* packets;
  const MeshRay* ray;
  Query* query;
};

RTCRay to_embree(const Ray& ray, float limit) {
  RTCRay r{};
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tfar = limit * kBehind;
  r.mask = ~0u;
  return r;
}

template <class Query, class Arguments>
const Query& find_in_packet(const Arguments& a) {
  const auto& passage = *reinterpret_cast<const Passage<Query>*>(a.context);
  passage.packets[a.primID].find(*passage.ray, *passage.query, [&](int) { return passage.query->frames(); });
  return *passage.query;
}

void intersect_packet(const RTCIntersectFunctionNArguments* a) {
  reinterpret_cast<RTCRayHit*>(a->rayhit)->ray.tfar = find_in_packet<NearestHit>(*a).limit() * kBehind;
}

void occlude_by_packet(const RTCOccludedFunctionNArguments* a) {
  if (find_in_packet<Unblocked>(*a).frames().empty()) reinterpret_cast<RTCRay*>(a->ray)->tfar = -kInfinity;
}

template <class Query>
Passage<Query> passage(const std::vector<TrianglePacket>& packets, const MeshRay& ray, Query& query) {
  Passage<Query> p{{}, packets.data(), &ray, &query};
  rtcInitIntersectContext(&p.context);
  return p;
}

}  // namespace

void StaticTree::Release::operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
void StaticTree::Release::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

StaticTree::StaticTree(std::span<const PlacedShape> shapes, const ShapesByKind& which, FrameSet all)
    : meshes_(shapes, which.meshes, all), others_(shapes, {.meshes = {}, .others = which.others}, all) {
  if (!meshes_.empty()) build();
}

void StaticTree::build() {
  Bounds3 bounds;
  for (const TrianglePacket& packet : meshes_.packets()) bounds.add(packet.bounds());
  reach_ = kReach * largest_coordinate(bounds);
  margin_ = 2 * kBoxMargin * reach_;

  device_.reset(rtcNewDevice(nullptr));
  rtcSetDeviceMemoryMonitorFunction(
      device_.get(),
      [](void* bytes, ssize_t more, bool) { return *static_cast<std::atomic<std::ptrdiff_t>*>(bytes) += more, true; },
      &embree_bytes_);
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(meshes_.packets().size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* a) {
        const auto& tree = *static_cast<const StaticTree*>(a->geometryUserPtr);
        const auto [low, high] = widened(tree.meshes_.packets()[a->primID].bounds(), tree.margin_);
        *a->bounds_o = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
      },
      nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_packet);
  rtcSetGeometryOccludedFunction(geometry, occlude_by_packet);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree could not build the static tree");
}

void StaticTree::find(const Ray& ray, NearestHit& query) const {
  const MeshRay mesh_ray(ray);
  if (in_reach(ray)) {
    auto on_the_way = passage(meshes_.packets(), mesh_ray, query);
    RTCRayHit r{to_embree(ray, query.limit()), {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &on_the_way.context, &r);
  } else {
    meshes_.find(mesh_ray, query);
  }
  others_.find(ray, query);
}

bool StaticTree::occluded(const Ray& ray) const {
  Unblocked query(FrameSet::single(0), ray.t_max);
  const MeshRay mesh_ray(ray);
  if (in_reach(ray)) {
    auto on_the_way = passage(meshes_.packets(), mesh_ray, query);
    RTCRay r = to_embree(ray, ray.t_max);
    rtcOccluded1(scene_.get(), &on_the_way.context, &r);
  } else {
    meshes_.find(mesh_ray, query);
  }
  if (!query.frames().empty()) others_.find(ray, query);
  return query.frames().empty();
}

std::size_t StaticTree::memory() const {
  return meshes_.memory() + static_cast<std::size_t>(embree_bytes_.load()) + others_.memory();
}

}  // namespace dspm
