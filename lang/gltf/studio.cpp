#include "dspm/lang/gltf/studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "dspm/base/math/vec.h"
#include "dspm/lang/gltf/statements.h"

namespace dspm::gltf {
namespace {

constexpr float kHorizon = 0.52f, kZenith = 0.34f;  // radiances of the sky
constexpr int kSkyWidth = 32, kSkyHeight = 16;
constexpr double kBlur = 12;  // degrees

/// A rectangle of light that faces the subject. Lengths are in radii of the subject.
struct Softbox {
  const char* name;
  float azimuth, elevation, distance;
  float width, height;
  std::array<float, 3> radiance;
};
constexpr Softbox kSoftboxes[] = {
    {"the key, to the left of the camera", -50, 40, 3.2f, 2.2f, 2.2f, {2.6f, 2.55f, 2.46f}},
    {"a strip on the right", 60, 25, 3.2f, 1, 2.4f, {2.8f, 2.85f, 2.9f}},
    {"a rim, from behind", 165, 30, 3.6f, 3, 1.2f, {4, 4, 4}},
    {"overhead", 0, 90, 3.5f, 2.6f, 2.6f, {0.9f, 0.9f, 0.9f}},
};

constexpr float kGround = 4, kOpaqueGround = 1.6f;  // radii of the ground, in the subject's

/// Rounded to a thousandth of `scale` or less, to be read.
std::string tidy(const Vec3& v, float scale) {
  const double step = std::pow(10, std::floor(std::log10(double{scale})) - 3);
  const auto rounded = [&](float x) { return std::round(double{x} / step) * step + 0.0; };
  return fmt::format("{:.9g} {:.9g} {:.9g}", rounded(v.x), rounded(v.y), rounded(v.z));
}

/// The light that comes through a rectangle: it hides nothing, and metals mirror its edges.
std::string written(const Softbox& box, const Subject& subject, double strength) {
  const float radius = subject.radius();
  const Vec3 back = towards(box.azimuth, box.elevation);
  const Vec3 across = box.elevation < 90 ? normalize(cross(Vec3{0, 1, 0}, back)) : Vec3{-1, 0, 0};
  const Vec3 x = across * (box.width * radius / 2), y = cross(back, across) * (box.height * radius / 2);
  const Vec3 middle = subject.center() + back * (box.distance * radius);
  const auto place = [&](float side, float up) { return tidy(middle + x * side + y * up, radius); };
  return fmt::format(
      "# {}\n"
      "LightSource \"infinite\" \"rgb L\" [{}] \"float scale\" {} \"rgb background\" [0 0 0]\n"
      "  \"point3 portal\" [{}  {}  {}  {}]\n",
      box.name, listed(box.radiance), static_cast<float>(strength), place(-1, -1), place(-1, 1), place(1, 1),
      place(1, -1));
}

/// Blocks whose up is y, for what has z there.
std::string upright(const std::string& text) {
  return "AttributeBegin\n  Rotate -90 1 0 0\n  " + text + "\nAttributeEnd\n";
}

}  // namespace

std::string sky_picture() {
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", kSkyWidth, kSkyHeight);
  for (int row = 0; row < kSkyHeight; ++row) {  // upwards
    const float up = std::max(0.f, 2 * (static_cast<float>(row) + 0.5f) / kSkyHeight - 1);
    const float radiance = kHorizon + (kZenith - kHorizon) * up * up * (3 - 2 * up);
    for (int i = 0; i < 3 * kSkyWidth; ++i) bytes.append(reinterpret_cast<const char*>(&radiance), sizeof radiance);
  }
  return bytes;
}

std::string softboxes_around(const Subject& subject, const std::string& sky, double strength) {
  std::string text = upright(fmt::format("LightSource \"infinite\" \"string filename\" {} \"float scale\" {}",
                                         in_quotes(sky), static_cast<float>(strength)));
  for (const Softbox& box : kSoftboxes) text += written(box, subject, strength);
  return text;
}

std::string light_of_picture(const std::string& hdr, Backdrop backdrop, double strength) {
  std::string light = fmt::format("LightSource \"infinite\" \"string filename\" {} \"float illuminance\" {}",
                                  in_quotes(hdr), static_cast<float>(static_cast<double>(kPi) * strength));
  const float grey = kHorizon * static_cast<float>(strength);
  if (backdrop == Backdrop::blurred) light += fmt::format(" \"float backgroundblur\" {}", kBlur);
  if (backdrop == Backdrop::hidden) light += fmt::format(" \"rgb background\" [{0} {0} {0}]", grey);
  return upright(light);
}

/// Away from the softboxes it gets less light, which a brighter colour makes up for until it has faded.
std::string ground_for(const Subject& subject) {
  if (subject.bounds.empty()) return {};
  const float radius = subject.radius();
  const Vec3 center = subject.center();
  const Vec3 foot{center.x, subject.bounds.low.y - 1e-4f * radius, center.z};
  return fmt::format(
      "Texture \"studio ground\" \"spectrum\" \"bilerp\" \"rgb v00\" [.95 .95 .95] \"rgb v10\" [.95 .95 .95]\n"
      "  \"rgb v01\" [.6 .6 .6] \"rgb v11\" [.6 .6 .6]\n"
      "Texture \"studio edge\" \"float\" \"bilerp\" \"float v00\" 0 \"float v10\" 0 \"float v01\" {0} \"float v11\" "
      "{0}\n"
      "AttributeBegin  # the ground, which fades from its middle on\n"
      "  Translate {1} {2} {3}\n"
      "  Rotate -90 1 0 0\n"
      "  Material \"diffuse\" \"texture reflectance\" \"studio ground\"\n"
      "  Shape \"disk\" \"float radius\" {4} \"texture alpha\" \"studio edge\"\n"
      "AttributeEnd\n",
      kGround / (kGround - kOpaqueGround), foot.x, foot.y, foot.z, kGround * radius);
}

}  // namespace dspm::gltf
