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
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/cameras/camera.h"
#include "dspm/cameras/perspective_rays.h"
#include "dspm/cameras/projection.h"

namespace dspm {
namespace {

class Perspective final : public Camera {
 public:
  explicit Perspective(const PerspectiveRays& rays) : rays_(rays) {}

  Ray ray(Vec2 film, Vec2 lens) const override { return rays_.ray(film, lens); }
  float pixel_spacing(float path_length) const override { return rays_.pixel_spacing(path_length); }
  std::optional<Sighting> sight(const Vec3& p, Vec2 lens) const override { return rays_.sight(p, lens); }

  std::optional<Matrix4> image_from_camera() const override {
    constexpr double kNear = 0.01;  // as in pbrt; z / w is 0 there and 1 infinitely far away
    Matrix4 divide;
    divide.m[2][3] = -kNear;
    divide.m[3] = {0, 0, 1, 0};
    const auto scale = static_cast<double>(rays_.scale());
    return image_from_screen(rays_.screen()) * (divide * Matrix4::scale(1 / scale, 1 / scale, 1));
  }

 private:
  PerspectiveRays rays_;
};

}  // namespace

std::unique_ptr<Camera> make_perspective(ParamReader& reader, const CameraContext& context) {
  const Projection projection = read_projection(reader, context);
  float fov = read_positive(reader, "fov", 90, "degrees", "field of view over the shorter axis");
  if (fov >= 180) {
    reader.error("fov", "parameter \"fov\" of " + reader.subject() + " must be below 180");
    fov = 90;
  }
  reader.finish();
  return std::make_unique<Perspective>(PerspectiveRays(context.to_world, projection.screen, projection.lens, fov));
}

}  // namespace dspm
