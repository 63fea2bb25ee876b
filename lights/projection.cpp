// LightSource "projection" "string filename" "window.png" "float fov" 40 "float scale" 20
//
// A projector: a point at the origin of light space that shines along +z through an image, upright for an eye in its
// place with +x to the right and +y up. A pixel's value is the radiant intensity (W/sr) towards it. Photons follow the
// luminance of the image.
//
// | parameter | default  | meaning |
// | --------- | -------- | ------- |
// | filename  | required | the image, of any format of image.h |
// | fov       | 90       | degrees that the shorter axis of the image covers |
// | scale     | 1        | multiplies the image |
// | power     | -1       | if above 0: the image is scaled to this many lumens |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.2.2]
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/image/image.h"
#include "dspm/lights/light.h"
#include "dspm/lights/light_space.h"
#include "dspm/lights/read_environment.h"
#include "dspm/lights/screen_image.h"
#include "dspm/lights/shaped_point.h"
#include "dspm/lights/strength.h"

namespace dspm {
namespace {

float read_fov(ParamReader& reader) {
  const float fov = reader.number("fov", 90, "degrees", "field of view over the shorter axis of the image");
  if (fov > 0 && fov < 180) return fov;
  reader.error("fov", "parameter \"fov\" of " + reader.subject() + " must be above 0 and below 180");
  return 90;
}

}  // namespace

std::unique_ptr<Light> make_projection(ParamReader& reader, const LightContext& context) {
  const std::filesystem::path file = reader.file("filename", "the image, whose values are radiant intensities");
  const float fov = read_fov(reader);
  const Strength strength = read_power(reader);
  reader.finish();
  Image image(1, 1);
  try {
    if (!file.empty()) image = read_light_image(file, reader);
  } catch (const std::runtime_error& e) {
    reader.error("filename", e.what());
  }
  ScreenImage screen(std::move(image), fov);
  const float factor = strength.factor(luminance(screen.fluence()));
  return std::make_unique<ShapedPoint<ScreenImage>>(context.to_world.point({}), LightSpace(context.to_world),
                                                    std::move(screen), Rgb(factor));
}

}  // namespace dspm
