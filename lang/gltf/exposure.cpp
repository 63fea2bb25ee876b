#include "dspm/lang/gltf/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/math/transform.h"

namespace dspm::gltf {
namespace {

constexpr double kTooBright = 2, kTooDark = 8;  // times as bright or dark as it should be; what is dark shows yet

double brightest(const Value& light) {
  const auto colour = light["color"].numbers(std::array<double, 3>{1, 1, 1});
  return *std::max_element(colour.begin(), colour.end()) * light["intensity"].number(1);
}

}  // namespace

double illuminance(const Document& document, const Poses& poses, const std::vector<std::size_t>& nodes,
                   const Vec3& at) {
  const Value lights = document.root().extension("KHR_lights_punctual")["lights"];
  double sum = 0;
  for (const std::size_t node : nodes) {
    const Value use = document["nodes"][node].extension("KHR_lights_punctual")["light"];
    if (!use.exists()) continue;
    const Value light = lights[use.required_index(lights.size())];
    const Matrix4 world = poses.world(node, 0);
    const Vec3 to = at - Vec3{static_cast<float>(world.m[0][3]), static_cast<float>(world.m[1][3]),
                              static_cast<float>(world.m[2][3])};
    const double d2 = light["type"].text("") == "directional" ? 1 : static_cast<double>(length2(to));
    sum += brightest(light) / std::max(d2, 1e-6);
  }
  return sum;
}

std::optional<double> exposure_for(double illuminance) {
  const double white = illuminance / static_cast<double>(kPi);  // the radiance of a white surface
  if (!(white > 0) || (white < kTooBright && white > 1 / kTooDark)) return std::nullopt;
  return std::exp2(std::round(-std::log2(white)));
}

}  // namespace dspm::gltf
