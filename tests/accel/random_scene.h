// Small scenes full of what makes trees fail, and rays that look for it: geometry of several frames at the same place,
// triangles without area, objects that come and go, mirrored and stretched placements, holes, coordinates on a grid so
// that rays pass exactly through planes, edges and vertices.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/shapes/curves.h"
#include "dspm/shapes/shape.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/textures/plain_texture.h"
#include "tests/shapes/placed.h"

namespace dspm::test {

/// Holes, solid places and places that stop some rays, in stripes.
class Stripes final : public Cutout {
 public:
  float alpha(const SurfacePoint& point) const override {
    const Vec2 uv = point.uv;
    const float stripe = std::floor(7 * (uv.x + 2 * uv.y));
    return 0.5f * (stripe - 3 * std::floor(stripe / 3));
  }
  std::optional<PlainTexture<float>> plain() const override { return std::nullopt; }
};

/// Returns a shape of bilinear patches, each with four of the vertices at its corners.
inline std::unique_ptr<Shape> bilinear_mesh(std::span<const Vec3> vertices, std::vector<int> indices) {
  std::vector<float> points;
  for (const Vec3& p : vertices) points.insert(points.end(), {p.x, p.y, p.z});
  const ParamList list{{{ParamType::integer, "indices", {}, std::move(indices), {}, {}},
                        {ParamType::point3, "P", {}, std::move(points), {}, {}}}};
  Diagnostics diagnostics;
  ParamReader reader(list, "shape", {}, diagnostics);
  return std::move(shape_plugins().find("bilinearmesh")->make(reader).front().shape);
}

class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {
    static constexpr int counts[] = {1, 2, 3, 8, 31, 32, 33, 63, 64};
    static constexpr float scales[] = {1, 1, 1e6f, 1e-6f};
    frame_count_ = counts[random_.below(std::size(counts))];
    all_ = FrameSet::first(frame_count_);
    scale_ = scales[random_.below(std::size(scales))];
    on_grid_ = random_.below(2) == 0;
    if (random_.below(4) == 0) center_ = scale_ * random_.in_cube(100);
    const int kinds = 1 + random_.below(5);
    for (int i = 0; i < kinds; ++i) add_something();
  }
  RandomScene(const RandomScene&) = delete;  // placed shapes point into it
  RandomScene& operator=(const RandomScene&) = delete;

  std::span<const PlacedShape> placed() const { return placed_; }
  FrameSet all() const { return all_; }

  /// Some of the frames, often all or one of them.
  FrameSet some_frames() {
    switch (random_.below(4)) {
      case 0: return all_;
      case 1: return FrameSet::single(random_.below(frame_count_));
      case 2: return FrameSet(random_.bits()) & all_;
      default: return FrameSet(random_.bits() & random_.bits() & random_.bits()) & all_;
    }
  }

  Ray some_ray() {
    Vec3 origin = point(2), direction = random_.direction();
    if (random_.below(8) == 0) origin = center_ + scale_ * random_.magnitude(1, 4) * random_.direction();
    switch (random_.below(5)) {
      case 0: break;
      case 1: direction = Vec3{}, direction[random_.below(3)] = random_.below(2) != 0 ? 1.f : -1.f; break;
      case 2: origin = somewhere_on(some_shape()); break;
      case 3: direction = normalize(somewhere_on(some_shape()) - origin); break;
      default: std::tie(origin, direction) = edge_on(some_shape());
    }
    if (!is_finite(direction)) direction = {0, 0, 1};
    if (random_.below(8) == 0) direction[random_.below(3)] = random_.below(2) != 0 ? 0.f : -0.f;
    if (direction == Vec3{}) direction = {0, -1, 0};
    return {origin, direction, random_.below(4) == 0 ? scale_ * random_.uniform(0, 3) : kInfinity};
  }

 private:
  void add_something() {
    switch (random_.below(7)) {
      case 0: return place_at_rest(keep(soup()));
      case 1: return place_at_rest(round());
      case 2: return place_deforming();
      case 3: return place_moving(keep(soup()));
      case 4: return place_moving(round());
      case 5: return place_coincident();
      default: return place(keep(soup()), {}, some_frames());
    }
  }

  float coordinate(float r) {
    return on_grid_ ? 0.25f * static_cast<float>(random_.below(static_cast<int>(8 * r) + 1)) - r
                    : random_.uniform(-r, r);
  }
  Vec3 point(float r) {
    const Vec3 p{coordinate(r), coordinate(r), coordinate(r)};
    return center_ + scale_ * p;
  }

  /// A strip of triangles with shared edges, or single ones; some of them without area.
  TriangleMesh soup() {
    MeshData data;
    const int count = 1 + random_.below(10);
    const bool strip = random_.below(2) == 0, flat = random_.below(3) == 0;
    const float extent = random_.below(2) == 0 ? 1 : 0.25f;
    const int axis = random_.below(3);
    for (int v = 0; v < (strip ? count + 2 : 3 * count); ++v) {
      data.vertices.push_back(point(extent));
      if (flat) data.vertices.back()[axis] = center_[axis];
    }
    for (int f = 0; f < count; ++f)
      data.faces.push_back(strip ? Face{f, f + 1, f + 2} : Face{3 * f, 3 * f + 1, 3 * f + 2});
    for (Face& face : data.faces)
      if (random_.below(16) == 0) face[2] = random_.below(2) == 0 ? face[0] : face[1];
    return TriangleMesh(std::move(data));
  }

  const Shape& keep(TriangleMesh mesh) {
    shapes_.push_back(std::make_unique<TriangleMesh>(std::move(mesh)));
    return *shapes_.back();
  }

  /// A sphere, a disk, some curves or bilinear patches.
  const Shape& round() {
    if (random_.below(3) == 0) return strands();
    Diagnostics diagnostics;
    if (random_.below(3) == 0) return patches();
    const ParamList list{
        {{ParamType::number, "radius", {}, std::vector<float>{scale_ * random_.uniform(0.1f, 1)}, {}, {}}}};
    ParamReader reader(list, "shape", {}, diagnostics);
    auto parts = shape_plugins().find(random_.below(2) == 0 ? "sphere" : "disk")->make(reader);
    shapes_.push_back(std::move(parts.front().shape));
    return *shapes_.back();
  }

  const Shape& strands() {
    constexpr CurveType types[] = {CurveType::flat, CurveType::ribbon, CurveType::cylinder};
    const CurveType type = types[random_.below(3)];
    std::vector<CurveSegment> segments;
    std::vector<RibbonNormals> normals;
    for (int i = 1 + random_.below(4); i > 0; --i) {
      const Vec3 points[] = {point(1), point(1), point(1), point(1)};
      segments.push_back(
          CurveSegment::of(points, scale_ * random_.magnitude(-3, 0), scale_ * random_.magnitude(-3, 0)));
      if (type == CurveType::ribbon) normals.push_back({{random_.direction(), random_.direction()}});
    }
    shapes_.push_back(std::make_unique<Curves>(type, segments, normals, random_.below(4)));
    shapes_.back()->settle();
    return *shapes_.back();
  }

  /// Two patches with a common edge, or one of them.
  const Shape& patches() {
    std::vector<Vec3> vertices;
    for (int i = 0; i < 6; ++i) vertices.push_back(point(1));
    std::vector<int> indices{0, 1, 2, 3, 2, 3, 4, 5};
    if (random_.below(4) == 0) indices.resize(4);
    shapes_.push_back(bilinear_mesh(vertices, std::move(indices)));
    return *shapes_.back();
  }

  Transform placement() {
    const Vec3 at = point(1), axis = random_.direction();
    Matrix4 m = Matrix4::translate(at.x, at.y, at.z);
    if (random_.below(2) == 0) m = m * Matrix4::rotate(random_.uniform(0, 360), axis.x, axis.y, axis.z);
    const auto factor = [&] { return random_.magnitude(-1, 0.5f) * (random_.below(4) == 0 ? -1.f : 1.f); };
    if (random_.below(2) == 0) m = m * Matrix4::scale(factor(), factor(), factor());
    return Transform(m * Matrix4::translate(-center_.x, -center_.y, -center_.z));
  }

  void place(const Shape& shape, const Transform& to_world, FrameSet frames) {
    if (frames.empty()) return;
    placed_.push_back(test::placed(shape, to_world));
    placed_.back().frames = frames;
    if (random_.below(4) == 0) placed_.back().cutout = &stripes_;
    placed_.back().cutout_key = placed_.size();
  }
  void place_at_rest(const Shape& shape) {
    const bool has_vertices = shape.triangles() || shape.turns() || shape.primitive_count() > 1;
    place(shape, has_vertices && random_.below(2) == 0 ? Transform() : placement(), all_);
  }
  /// Another mesh in every few frames, in some frames none.
  void place_deforming() {
    for (Frame f = 0; f < frame_count_;) {
      const int length = std::min(1 + random_.below(3), frame_count_ - f);
      if (random_.below(8) != 0) place(keep(soup()), {}, FrameSet(FrameSet::first(length).bits() << f));
      f += length;
    }
  }
  /// The same shape at another place in every frame, in some frames where it was before or nowhere.
  void place_moving(const Shape& shape) {
    for (Frame f = 0; f < frame_count_; ++f)
      if (random_.below(8) != 0) place(shape, placement(), FrameSet::single(f));
  }
  /// Equal triangles: at rest, in all frames at once and frame by frame.
  void place_coincident() {
    const TriangleMesh mesh = soup();
    const Shape& first = keep(mesh);
    if (random_.below(2) == 0) place(first, {}, all_);
    for (Frame f = 0; f < frame_count_; ++f)
      if (random_.below(2) == 0) place(random_.below(2) == 0 ? first : keep(mesh), {}, FrameSet::single(f));
    if (random_.below(2) == 0) place(first, {}, all_);
  }

  /// One primitive of a placed shape; the shape is null where there is none.
  struct Place {
    const PlacedShape* placed = nullptr;
    int primitive = 0;
  };
  Place some_shape() {
    if (placed_.empty()) return {};
    const PlacedShape& placed = placed_[static_cast<std::size_t>(random_.below(static_cast<int>(placed_.size())))];
    return {&placed, random_.below(placed.shape->primitive_count())};
  }

  /// On the primitive; often a vertex or the middle of an edge.
  Vec3 somewhere_on(const Place& place) {
    if (!place.placed) return point(1);
    const TriangleMesh* mesh = place.placed->shape->triangles();
    if (mesh && random_.below(2) == 0) {
      const Vec3 vertex = mesh->vertex(place.primitive, random_.below(3));
      return place.placed->to_world.point(0.5f * (vertex + mesh->vertex(place.primitive, random_.below(3))));
    }
    const Vec2 uv = place.placed->shape->sample_area(place.primitive, random_.square());
    const Vec3 p = place.placed->surface_point(place.primitive, uv).p;
    return is_finite(p) ? p : point(1);
  }

  /// Origin and direction of a ray that runs within the primitive's plane, nearly.
  std::pair<Vec3, Vec3> edge_on(const Place& place) {
    const Vec3 a = somewhere_on(place), b = somewhere_on(place);
    const Vec3 away = scale_ * random_.magnitude(-8, -3) * random_.direction();
    const Vec3 origin = a + (a - b) * random_.uniform(0, 3) + away;
    return {origin, normalize(b - origin)};
  }

  Random random_;
  Stripes stripes_;
  int frame_count_;
  FrameSet all_;
  float scale_;
  bool on_grid_;
  Vec3 center_{};
  std::vector<std::unique_ptr<Shape>> shapes_;
  std::vector<PlacedShape> placed_;
};

}  // namespace dspm::test
