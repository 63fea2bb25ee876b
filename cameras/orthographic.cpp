// Camera "orthographic" "float screenwindow" [-2 2 -1 1]
//
// Parallel rays along +z of camera space, from the plane z = 0. With a lens, each pixel has a lens of its own around
// its ray's origin, so that a small lens blurs a little. (pbrt-v4 has one lens at the camera's origin, which turns the
// picture into a perspective one; see pbrt-v3's issue 315.)
//
// | parameter        | default       | meaning |
// | ---------------- | ------------- | ------- |
// | lensradius       | 0             | of the thin lens, in camera space |
// | blades           | 0             | of the aperture: highlights out of focus are polygons within the lens; 0: round |
// | bladerotation    | 0             | degrees of the polygon, anticlockwise as the camera sees it |
// | anamorphic       | 1             | height over width of the lens' opening, whose longer axis is the lens' |
// | focaldistance    | 1e6           | distance of the plane of focus along z |
// | frameaspectratio | the film's    | width over height of the screen |
// | screenwindow     | shorter axis -1 to 1 | left, right, bottom, top, in camera space |
// | shutteropen, shutterclose | 0, 0 | frames: what moves between them blurs; in .pbrt files seconds, 0 and 1 |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 5.2]
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/cameras/camera.h"
#include "dspm/cameras/orthographic_rays.h"
#include "dspm/cameras/projection.h"

namespace dspm {
namespace {

class Orthographic final : public Camera {
 public:
  explicit Orthographic(const OrthographicRays& rays) : rays_(rays) {}

  Ray ray(Vec2 film, Vec2 lens) const override { return rays_.ray(film, lens); }
  float pixel_spacing(float path_length) const override { return rays_.pixel_spacing(path_length); }
  std::optional<Sighting> sight(const Vec3& p, Vec2 lens) const override { return rays_.sight(p, lens); }
  std::optional<Matrix4> image_from_camera() const override { return image_from_screen(rays_.screen()); }

 private:
  OrthographicRays rays_;
};

}  // namespace

std::unique_ptr<Camera> make_orthographic(ParamReader& reader, const CameraContext& context) {
  const Projection projection = read_projection(reader, context);
  reader.finish();
  return std::make_unique<Orthographic>(OrthographicRays(context.to_world, projection.screen, projection.lens));
}

}  // namespace dspm
