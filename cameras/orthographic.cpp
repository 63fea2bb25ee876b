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
#include "dspm/cameras/blades.h"
#include "dspm/cameras/camera.h"
#include "dspm/cameras/projection.h"

namespace dspm {
namespace {

class Orthographic final : public Camera {
 public:
  Orthographic(const Transform& to_world, const Projection& projection, const Blades& blades)
      : to_world_(to_world),
        screen_(projection.screen),
        lens_(projection.lens),
        blades_(blades),
        spacing_(mean_spacing(to_world, screen_.pixel_size())) {}

  Ray ray(Vec2 film, Vec2 lens) const override {
    const Vec2 s = screen_.at(film);
    return carried(to_world_, lens_.through({{s.x, s.y, 0}, {0, 0, 1}}, blades_.within(lens)));
  }

  float pixel_spacing(float) const override { return spacing_; }

  std::optional<Sighting> sight(const Vec3& p, Vec2 lens) const override {
    const Vec3 local = to_world_.inverse_point(p), offset = lens_.offset(blades_.within(lens));
    if (!(local.z > 0)) return std::nullopt;
    const Vec3 middle =
        local - offset * (1 - local.z / lens_.focal_distance);  // of this pixel's lens, and of its focus
    const Vec2 size = screen_.pixel_size();
    return carried(to_world_, screen_.film_at({middle.x, middle.y}), local, Vec3{middle.x, middle.y, 0} + offset,
                   1 / std::abs(size.x * size.y));
  }

  std::optional<Matrix4> image_from_camera() const override { return image_from_screen(screen_); }

 private:
  Transform to_world_;
  Screen screen_;
  ThinLens lens_;
  Blades blades_;
  float spacing_;
};

}  // namespace

std::unique_ptr<Camera> make_orthographic(ParamReader& reader, const CameraContext& context) {
  const Projection projection = read_projection(reader, context);
  const Blades blades(reader);
  reader.finish();
  return std::make_unique<Orthographic>(context.to_world, projection, blades);
}

}  // namespace dspm
