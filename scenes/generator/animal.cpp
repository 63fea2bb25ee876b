// The glass animal of horse.dsc and figure9/ on its way through the hall: animal.NNN.ply, NNN the time in 1/768 of the
// run. Only the times that 8, 16, 24, 32, 64 and 256 frames of the run need: multiples of 3 and of 32.
#include "scenes/generator/animal.h"

#include <fmt/format.h>

#include <cmath>

#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace animal {
namespace {

/// A bone's movement away from the pose at rest.
struct Turn {
  Vec2 pivot, moved_to;
  float cosine, sine;

  Turn(const Segment& at_rest, const Segment& now) : pivot(at_rest.from), moved_to(now.from) {
    const Vec2 a = at_rest.to - at_rest.from, b = now.to - now.from;
    const float scale = 1 / std::sqrt((a.x * a.x + a.y * a.y) * (b.x * b.x + b.y * b.y));
    cosine = (a.x * b.x + a.y * b.y) * scale;
    sine = (a.x * b.y - a.y * b.x) * scale;
  }
  Vec3 vector(const Vec3& v) const { return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z}; }
  Vec3 point(const Vec3& p) const {
    return vector({p.x - pivot.x, p.y - pivot.y, p.z}) + Vec3{moved_to.x, moved_to.y, 0};
  }
};

}  // namespace

MeshData posed(const Body& body, const Skeleton& skeleton) {
  std::vector<Turn> turns;
  for (std::size_t bone = 0; bone < kBones; ++bone) turns.emplace_back(rest()[bone], skeleton[bone]);
  MeshData mesh = body.mesh;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    Vec3 place, normal;
    for (std::size_t bone = 0; bone < kBones; ++bone) {
      const float weight = body.weights[v][bone];
      if (weight == 0) continue;
      place += turns[bone].point(mesh.vertices[v]) * weight;
      normal += turns[bone].vector(mesh.normals[v]) * weight;
    }
    mesh.vertices[v] = place;
    mesh.normals[v] = normalize(normal);
  }
  return mesh;
}

}  // namespace animal

void make_animal(const std::filesystem::path& directory) {
  constexpr int kTimes = 768;
  const Vec3 start{4.4f, 0, 0.4f}, end{-7, 0, -0.6f};
  const Vec3 way = end - start;
  const float strides = length(way) / animal::kStride, heading = std::atan2(-way.z, way.x) * 180 / kPi;
  const animal::Body body = animal::make_body();
  parallel_for(kTimes, 1, [&](std::int64_t n) {
    if (n % 3 != 0 && n % 32 != 0) return;
    const float t = static_cast<float>(n) / kTimes;
    const Vec3 place = start + way * t;
    const Transform placement(Matrix4::translate(place.x, place.y, place.z) * Matrix4::rotate(heading, 0, 1, 0));
    MeshData mesh;
    append(mesh, animal::posed(body, animal::gallop(t * strides)), placement);
    write_ply(directory / fmt::format("animal.{:03}.ply", n), mesh);
  });
}

}  // namespace dspm
