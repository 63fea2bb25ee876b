// Camera "perspective" "float fov" 38 "float lensradius" 0.01 "float focaldistance" 3.3
//
// A pinhole, or a thin lens, at the origin of camera space that looks along +z, with +x to the right and +y up (a
// left-handed system).
//
// | parameter        | default       | meaning |
// | ---------------- | ------------- | ------- |
// | fov              | 90            | degrees that -1 to 1 of the screen cover: the angle over the shorter axis |
// | lensradius       | 0             | of the thin lens, in camera space |
// | blades           | 0             | of the aperture: highlights out of focus are polygons within the lens; 0: round |
// | bladerotation    | 0             | degrees of the polygon, anticlockwise as the camera sees it |
// | anamorphic       | 1             | height over width of the lens' opening, whose longer axis is the lens' |
// | focaldistance    | 1e6           | distance of the plane of focus along z |
// | frameaspectratio | the film's    | width over height of the screen |
// | screenwindow     | shorter axis -1 to 1 | left, right, bottom, top |
// | shutteropen, shutterclose | 0, 0 | frames: what moves between them blurs; in .pbrt files seconds, 0 and 1 |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 5.2]
#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/cameras/blades.h"
#include "dspm/cameras/camera.h"
#include "dspm/cameras/projection.h"

namespace dspm {
namespace {

class Perspective final : public Camera {
 public:
  Perspective(const Transform& to_world, const Projection& projection, const Blades& blades, float fov)
      : to_world_(to_world),
        screen_(projection.screen),
        lens_(projection.lens),
        blades_(blades),
        scale_(rounded::tan(fov / 360 * kPi)) {
    const float forward = length(to_world.vector({0, 0, 1}));
    spacing_at_1_ = mean_spacing(to_world, screen_.pixel_size() * scale_) / forward;
  }

  Ray ray(Vec2 film, Vec2 lens) const override {
    const Vec2 s = screen_.at(film) * scale_;
    return carried(to_world_, lens_.through({{}, normalize({s.x, s.y, 1})}, blades_.within(lens)));
  }

  float pixel_spacing(float path_length) const override { return path_length * spacing_at_1_; }

  std::optional<Sighting> sight(const Vec3& p, Vec2 lens) const override {
    const Vec3 local = to_world_.inverse_point(p), origin = lens_.offset(blades_.within(lens));
    if (!(local.z > 0)) return std::nullopt;
    // The central ray of that pixel meets the ray from `origin` in the plane of focus.
    const Vec2 s{(local.x - origin.x) / local.z + origin.x / lens_.focal_distance,
                 (local.y - origin.y) / local.z + origin.y / lens_.focal_distance};
    const Vec2 size = screen_.pixel_size() * (scale_ * local.z);
    return carried(to_world_, screen_.film_at(s * (1 / scale_)), local, origin, 1 / std::abs(size.x * size.y));
  }

  std::optional<Matrix4> image_from_camera() const override {
    constexpr double kNear = 0.01;  // as in pbrt; z / w is 0 there and 1 infinitely far away
    Matrix4 divide;
    divide.m[2][3] = -kNear;
    divide.m[3] = {0, 0, 1, 0};
    const auto scale = static_cast<double>(scale_);
    return image_from_screen(screen_) * (divide * Matrix4::scale(1 / scale, 1 / scale, 1));
  }

 private:
  Transform to_world_;
  Screen screen_;
  ThinLens lens_;
  Blades blades_;
  float scale_;         // from the screen to the plane z = 1
  float spacing_at_1_;  // of neighbouring pixels in the plane at distance 1
};

}  // namespace

std::unique_ptr<Camera> make_perspective(ParamReader& reader, const CameraContext& context) {
  const Projection projection = read_projection(reader, context);
  const Blades blades(reader);
  float fov = read_positive(reader, "fov", 90, "degrees", "field of view over the shorter axis");
  if (fov >= 180) {
    reader.error("fov", "parameter \"fov\" of " + reader.subject() + " must be below 180");
    fov = 90;
  }
  reader.finish();
  return std::make_unique<Perspective>(context.to_world, projection, blades, fov);
}

}  // namespace dspm
