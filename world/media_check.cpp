#include "dspm/world/media_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/medium_boundary.h"
#include "dspm/lang/blocks.h"
#include "dspm/world/cameras.h"

namespace dspm {
namespace {

constexpr int kChords = 1 << 10, kCameraRays = 1 << 6, kMostBorders = 256;
// Of the rays that come to a shape: surfaces that coincide may be met in either order.
constexpr int kLeastRays = 4;
constexpr double kLeastShare = 0.05;
constexpr std::size_t kMostContradictions = 8;

/// A place from which light enters the space between two borders.
struct Side {
  const ShapeUse* shape;  // null: the camera
  int medium;
  friend auto operator<=>(const Side&, const Side&) = default;
};

class Walker {
 public:
  explicit Walker(const MediaBorders& borders) : borders_(borders), scene_(borders.scene) {}

  /// Chords of the sphere around everything.
  void walk_through() {
    for (std::uint64_t i = 0; i < kChords; ++i) {
      const PathRandom random(0, Stream::setup, i, 0);
      const Vec3 from = scene_.center + uniform_sphere(random.pair(0, 0)) * scene_.radius,
                 to = scene_.center + uniform_sphere(random.pair(0, 1)) * scene_.radius;
      if (length(to - from) > 0) walk({from, normalize(to - from)}, std::nullopt);
    }
  }
  void walk_from_camera() {
    scene_.camera.for_each(scene_.frames(), [&](FrameSet, const Camera& camera) {
      for (std::uint64_t i = 0; i < kCameraRays; ++i) {
        const PathRandom random(0, Stream::setup, i, 1);
        const Vec2 place = random.pair(0, 0);
        const Vec2 film{place.x * static_cast<float>(borders_.width), place.y * static_cast<float>(borders_.height)};
        const Ray ray = camera.ray(film, {0.5f, 0.5f});
        const int medium = scene_.around_camera.empty() ? kNoMedium : scene_.around_camera.front().inside.medium;
        if (is_finite(ray.origin) && is_finite(ray.direction)) walk(ray, Side{nullptr, medium});
      }
    });
  }

  /// The rays from one side to another.
  const std::map<std::pair<Side, Side>, int>& pairs() const { return pairs_; }
  int rays_at(const ShapeUse* shape) const { return rays_at_.at(shape); }

 private:
  /// A surface that parts no media may be a wall between two of them.
  void walk(Ray ray, std::optional<Side> behind) {
    for (int i = 0; i < kMostBorders; ++i) {
      const Meeting meeting = meetings_along(scene_, ray, scene_.frames())[0];
      if (meeting.hit.missed() && !meeting.is_boundary) return;
      const auto shape = static_cast<std::size_t>(meeting.hit.shape);
      if (meeting.is_boundary) {
        const BoundaryPoint point(*scene_.boundaries, meeting.hit, ray.direction);
        cross({borders_.boundaries[shape]->use, point.medium_beyond(-ray.direction)}, behind);
        behind = Side{borders_.boundaries[shape]->use, point.medium_beyond(ray.direction)};
        ray = point.beyond(ray, meeting.hit.t);
        continue;
      }
      const SurfacePoint point = scene_.surface_point(meeting.hit, ray.direction);
      if (const MediumInterface* sides = scene_.interface_at(meeting.hit.shape); sides != nullptr) {
        const bool to_outside = dot(ray.direction, point.ng) > 0;
        cross({borders_.surfaces[shape]->use, sides->medium_towards(!to_outside)}, behind);
        behind = Side{borders_.surfaces[shape]->use, sides->medium_towards(to_outside)};
      } else {
        behind = std::nullopt;
      }
      ray = point.spawn(ray.direction);
    }
  }

  void cross(const Side& met, const std::optional<Side>& behind) {
    ++rays_at_[met.shape];
    if (behind) ++pairs_[{*behind, met}];
  }

  const MediaBorders& borders_;
  const Scene& scene_;
  std::map<std::pair<Side, Side>, int> pairs_;
  std::map<const ShapeUse*, int> rays_at_;
};

}  // namespace

void warn_of_contradictions(const MediaBorders& borders, Diagnostics& diagnostics) {
  Walker walker(borders);
  walker.walk_from_camera();
  walker.walk_through();
  std::vector<std::pair<Side, Side>> contradictions;
  for (const auto& [pair, rays] : walker.pairs())
    if (pair.first.medium != pair.second.medium && rays >= kLeastRays &&
        rays > kLeastShare * walker.rays_at(pair.second.shape))
      contradictions.push_back(pair);
  // By place in the files: addresses differ from run to run.
  const auto place = [](const Side& side) {
    return side.shape == nullptr ? std::pair(0, 0) : std::pair(side.shape->where.line, side.shape->where.column);
  };
  std::ranges::sort(contradictions, [&](const auto& a, const auto& b) {
    return std::tuple(place(a.second), place(a.first), a.second.medium) <
           std::tuple(place(b.second), place(b.first), b.second.medium);
  });
  if (contradictions.size() > kMostContradictions) contradictions.resize(kMostContradictions);
  const auto medium = [&](const Side& side) {
    if (side.medium == kNoMedium) return std::string("no medium");
    return fmt::format("\"{}\"", borders.description.media[static_cast<std::size_t>(side.medium)].name);
  };
  for (const auto& [from, to] : contradictions) {
    const SourceLocation& where = to.shape->where;
    const std::string other = from.shape == nullptr ? "the camera, which is in"
                                                    : fmt::format("the shape of {}, whose interface says",
                                                                  place_of(from.shape->where, where));
    diagnostics.warning(
        where,
        fmt::format("this shape's interface says that {} lies between it and {} {}", medium(to), other, medium(from)),
        "MediumInterface names the medium inside of the shapes that follow and the one around them; before "
        "Camera, the second one is the medium that the camera is in");
  }
}

}  // namespace dspm
