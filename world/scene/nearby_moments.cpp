#include "dspm/world/scene/nearby_moments.h"

#include <algorithm>
#include <tuple>

namespace dspm {
namespace {

/// Returns the product, and its last coordinate.
std::pair<std::array<double, 3>, double> applied(const Matrix4& matrix, const Vec3& v, double w) {
  std::array<double, 4> result{};
  for (std::size_t row = 0; row < result.size(); ++row) {
    const std::array<double, 4>& m = matrix.m[row];
    result[row] =
        m[0] * static_cast<double>(v.x) + m[1] * static_cast<double>(v.y) + m[2] * static_cast<double>(v.z) + m[3] * w;
  }
  return {{result[0], result[1], result[2]}, result[3]};
}

Vec3 single(const std::array<double, 3>& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

NearbyMoments::Vector difference(const View::Place& from, const View::Place& to) {
  if (!from || !to) return std::nullopt;
  return Vec2{static_cast<float>((*to)[0] - (*from)[0]), static_cast<float>((*to)[1] - (*from)[1])};
}

}  // namespace

View::View(std::shared_ptr<const Camera> camera, const Matrix4& camera_from_world, int width, int height)
    : camera_(std::move(camera)), width_(width), height_(height) {
  if (camera_ == nullptr) return;
  if (const auto image_from_camera = camera_->image_from_camera())
    image_from_world_ = *image_from_camera * camera_from_world;
  else
    from_ = single(applied(camera_from_world.inverse().value_or(Matrix4()), {}, 1).first);
}

View::Place View::projected(const Vec3& v, double w) const {
  const auto [p, depth] = applied(*image_from_world_, v, w);
  if (!(depth > 0)) return std::nullopt;
  return std::array{p[0] / depth * width_ / 2, p[1] / depth * height_ / 2};
}

View::Place View::sighted(const Vec3& p) const {
  constexpr Vec2 kMiddleOfLens{0.5f, 0.5f};
  const std::optional<Sighting> seen = camera_->sight(p, kMiddleOfLens);
  if (!seen) return std::nullopt;
  return std::array{static_cast<double>(seen->film.x), -static_cast<double>(seen->film.y)};
}

View::Place View::of_point(const Vec3& p) const {
  if (camera_ == nullptr) return std::nullopt;
  return image_from_world_ ? projected(p, 1) : sighted(p);
}

View::Place View::of_direction(const Vec3& w) const {
  if (camera_ == nullptr) return std::nullopt;
  return image_from_world_ ? projected(w, 0) : sighted(from_ + w);
}

Vec3 NearbyMoments::moved(const RayHit& hit, const Vec3& p, Frame frame, Nearby when) const {
  const auto place = [](const Change& change) { return std::tuple(change.shape, change.frame, change.when); };
  const auto wanted = std::tuple(hit.shape, frame, when);
  const auto change = std::lower_bound(changes_.begin(), changes_.end(), wanted,
                                       [&](const Change& a, const auto& b) { return place(a) < b; });
  if (change == changes_.end() || place(*change) != wanted) return p;
  if (change->as != nullptr) return change->as->surface_point(hit.primitive, hit.uv).p;
  return single(applied(change->moved, p, 1).first);
}

NearbyMoments::Vector NearbyMoments::of_point(const RayHit& hit, const Vec3& p, Frame frame, Nearby when) const {
  const Views& views = views_[static_cast<std::size_t>(frame)];
  const View& then = when == Nearby::later ? views.later : views.earlier;
  return difference(views.now.of_point(p), then.of_point(moved(hit, p, frame, when)));
}

NearbyMoments::Vector NearbyMoments::of_direction(const Vec3& w, Frame frame, Nearby when) const {
  const Views& views = views_[static_cast<std::size_t>(frame)];
  const View& then = when == Nearby::later ? views.later : views.earlier;
  return difference(views.now.of_direction(w), then.of_direction(w));
}

}  // namespace dspm
