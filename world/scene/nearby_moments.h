// Where what a scene shows is one frame later and one frame earlier, in the world and in the image: for vectors of motion.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dspm/accel/accel.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/cameras/camera.h"

namespace dspm {

/// What a camera sees at a moment. A point has a place in the image even if it lies outside of it.
class View {
 public:
  /// `camera` may be null: then nothing has a place.
  View(std::shared_ptr<const Camera> camera, const Matrix4& camera_from_world, int width, int height);

  /// In pixels, to the right and up; nullopt if the point does not lie before the camera, or it cannot tell.
  using Place = std::optional<std::array<double, 2>>;
  Place of_point(const Vec3& p) const;
  /// Of what is infinitely far away.
  Place of_direction(const Vec3& w) const;

 private:
  Place projected(const Vec3& v, double w) const;
  Place sighted(const Vec3& p) const;

  std::shared_ptr<const Camera> camera_;
  std::optional<Matrix4> image_from_world_;  // see Camera::image_from_camera
  Vec3 from_;
  int width_, height_;
};

enum class Nearby { later, earlier };

class NearbyMoments {
 public:
  struct Views {
    View now, later, earlier;
  };
  /// Where one of the scene's shapes is another time.
  struct Change {
    int shape;
    Frame frame;
    Nearby when;
    Matrix4 moved;                    // from its place in the frame, in the world
    const PlacedShape* as = nullptr;  // the same primitives with another shape, instead
  };

  /// `changes` ascend by shape, frame and `when`; what has none stays. `views` are by frame. What they point to outlives
  /// this.
  NearbyMoments(std::vector<Change> changes, std::vector<Views> views)
      : changes_(std::move(changes)), views_(std::move(views)) {}

  /// Of motion, in pixels to the right and up, from the frame's image to the other; nullopt if it is in one of them only.
  using Vector = std::optional<Vec2>;
  Vector of_point(const RayHit& hit, const Vec3& p, Frame frame, Nearby when) const;
  /// Of what is infinitely far away.
  Vector of_direction(const Vec3& w, Frame frame, Nearby when) const;

 private:
  Vec3 moved(const RayHit& hit, const Vec3& p, Frame frame, Nearby when) const;

  std::vector<Change> changes_;
  std::vector<Views> views_;
};

}  // namespace dspm
