#include "dspm/cameras/projection.h"

#include "dspm/base/math/ray.h"
#include "dspm/base/math/sampling.h"
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

Ray ThinLens::through(const Ray& central, Vec2 u) const {
  if (!(radius > 0)) return central;
  const Vec3 focus = central.at(focal_distance / central.direction.z), origin = central.origin + offset(u);
  return {origin, normalize(focus - origin)};
}

Vec3 ThinLens::offset(Vec2 u) const {
  if (!(radius > 0)) return {};
  const Vec2 place = concentric_disk(u) * radius;
  return {place.x, place.y, 0};
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
  return p;
}

Matrix4 image_from_screen(const Screen& screen) {
  const auto left = static_cast<double>(screen.left), right = static_cast<double>(screen.right);
  const auto bottom = static_cast<double>(screen.bottom), top = static_cast<double>(screen.top);
  return Matrix4::scale(2 / (right - left), 2 / (top - bottom), 1) *
         Matrix4::translate(-(left + right) / 2, -(bottom + top) / 2, 0);
}

Sighting carried_across(const Transform& to_world, Vec2 film, const Vec3& p, const Vec3& origin, float pixels) {
  const Vec3 way = to_world.vector(origin - p), local = normalize(origin - p);
  const Vec3 x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0}), z = to_world.vector({0, 0, 1});
  // A thin tube along w: its volume scales by the determinant, its length as w does, so its cross-section by the
  // quotient.
  const float section = std::abs(dot(cross(x, y), z)) / length(to_world.vector(local));
  return {film, normalize(way), length(way), pixels / section};
}

Sighting carried(const Transform& to_world, Vec2 film, const Vec3& p, const Vec3& origin, float pixels) {
  return carried_across(to_world, film, p, origin, pixels / std::abs(normalize(origin - p).z));
}

float mean_spacing(const Transform& to_world, Vec2 size) {
  return std::sqrt(length(cross(to_world.vector({size.x, 0, 0}), to_world.vector({0, size.y, 0}))));
}

}  // namespace dspm
