#include "dspm/cameras/projection.h"

#include <algorithm>
#include <string>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"

namespace dspm {
namespace {

// The shorter axis reaches from -1 to 1.
void fit(Screen& screen, float aspect) {
  const float x = std::max(aspect, 1.f), y = std::max(1 / aspect, 1.f);
  screen.left = -x, screen.right = x, screen.bottom = -y, screen.top = y;
}

void read_window(ParamReader& reader, Screen& screen) {
  const std::vector<float> window = reader.numbers(
      "screenwindow",
      "left, right, bottom, top of the screen, mirrored if reversed; by default the shorter axis is -1 to 1");
  if (window.empty()) return;
  if (window.size() != 4 || window[0] == window[1] || window[2] == window[3]) {
    reader.error("screenwindow", "parameter \"screenwindow\" of " + reader.subject() +
                                     " takes left, right, bottom and top: four numbers that span an area");
    return;
  }
  screen.left = window[0], screen.right = window[1], screen.bottom = window[2], screen.top = window[3];
}

Blades read_blades(ParamReader& reader) {
  Blades blades;
  blades.count = reader.integer("blades", 0, {}, "of the aperture, which make highlights polygons; 0: they are round");
  blades.rotation =
      reader.number("bladerotation", 0, "degrees", "of the polygon, anticlockwise as the camera sees it") * kPi / 180;
  float ratio =
      reader.number("anamorphic", 1, {}, "height over width of the lens' opening; its longer axis is the lens'");
  if (blades.count != 0 && (blades.count < 3 || blades.count > 100)) {
    reader.error("blades", "parameter \"blades\" of " + reader.subject() + " must be 0, or from 3 to 100");
    blades.count = 0;
  }
  if (!(ratio > 0)) {
    reader.error("anamorphic", "parameter \"anamorphic\" of " + reader.subject() + " must be above 0");
    ratio = 1;
  }
  blades.width = std::min(1 / ratio, 1.f), blades.height = std::min(ratio, 1.f);
  return blades;
}

}  // namespace

// lang/shutter.h says when iterations are, and Job::exposure how bright images are for it.
void read_shutter(ParamReader& reader) {
  reader.number(
      "shutteropen", 0, "frames",
      "when the shutter opens, after the moment of each frame; in .pbrt files in seconds: images are multiplied by "
      "those until it closes");
  reader.number(
      "shutterclose", 0, "frames",
      "when it closes: what moves until then blurs; in .pbrt files 1 unless given: images are multiplied by the "
      "seconds since it opened");
}

float read_positive(ParamReader& reader, std::string_view name, float fallback, std::string_view unit,
                    std::string_view sentence) {
  const float value = reader.number(name, fallback, unit, sentence);
  if (value > 0) return value;
  reader.error(name, "parameter \"" + std::string(name) + "\" of " + reader.subject() + " must be above 0");
  return fallback;
}

Projection read_projection(ParamReader& reader, const CameraContext& context) {
  Projection p;
  p.screen.width = context.width;
  p.screen.height = context.height;
  const float film_aspect = static_cast<float>(context.width) / static_cast<float>(context.height);
  fit(p.screen, read_positive(reader, "frameaspectratio", film_aspect, "", "width over height of the screen"));
  read_window(reader, p.screen);
  p.lens.radius = reader.number("lensradius", 0, "scene units", "radius of the lens; 0: everything is sharp");
  if (p.lens.radius < 0)
    reader.error("lensradius", "parameter \"lensradius\" of " + reader.subject() + " must not be negative");
  p.lens.focal_distance = read_positive(reader, "focaldistance", 1e6f, "scene units", "distance of the plane of focus");
  read_shutter(reader);
  p.lens.blades = read_blades(reader);
  return p;
}

Matrix4 image_from_screen(const Screen& screen) {
  const auto left = static_cast<double>(screen.left), right = static_cast<double>(screen.right);
  const auto bottom = static_cast<double>(screen.bottom), top = static_cast<double>(screen.top);
  return Matrix4::scale(2 / (right - left), 2 / (top - bottom), 1) *
         Matrix4::translate(-(left + right) / 2, -(bottom + top) / 2, 0);
}

}  // namespace dspm
