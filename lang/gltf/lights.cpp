#include "dspm/lang/gltf/lights.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/base/math/vec.h"

namespace dspm::gltf {
namespace {

constexpr double kDegrees = 180 / static_cast<double>(kPi);

}  // namespace

Statement light_of(const Value& light) {
  const std::string type = light["type"].text("");
  std::array<double, 3> strength = light["color"].numbers(std::array<double, 3>{1, 1, 1});
  for (double& value : strength) value *= light["intensity"].number(1);
  if (type == "directional") {
    Statement sun{"LightSource \"distant\""};
    sun.rgb("L", strength), sun.set("point3", "to", "[0 0 -1]");
    return sun;
  }
  if (type == "point") {
    Statement point{"LightSource \"point\""};
    point.rgb("I", strength);
    return point;
  }
  if (type != "spot") light["type"].fail("no such light");
  Statement spot{"LightSource \"spot\""};
  const double outer = std::clamp(light["spot"]["outerConeAngle"].number(static_cast<double>(kPi) / 4), 1e-3, 1.57);
  const double inner = std::clamp(light["spot"]["innerConeAngle"].number(0), 0.0, outer);
  spot.rgb("I", strength), spot.set("point3", "to", "[0 0 -1]");
  spot.number("coneangle", outer * kDegrees, INFINITY);
  spot.number("conedeltaangle", std::max(outer - inner, 1e-3) * kDegrees, INFINITY);
  return spot;
}

Sight camera_of(const Value& camera, double usual) {
  if (camera["type"].text("") == "orthographic") {
    const Value own = camera["orthographic"];
    const double x = own["xmag"].number(1), y = own["ymag"].number(1);
    if (!(x > 0 && y > 0)) own.fail("xmag and ymag must be above 0");
    Statement statement{"Camera \"orthographic\""};
    statement.set("float", "screenwindow", fmt::format("[{}]", listed(std::array{-x, x, -y, y})));
    return {statement, x / y};
  }
  const Value own = camera["perspective"];
  const double aspect = own["aspectRatio"].number(usual), high = own["yfov"].number(0.7);
  if (!(aspect > 0.01 && aspect < 100)) own["aspectRatio"].fail("it is not plausible");
  if (!(high > 0 && high < static_cast<double>(kPi))) own["yfov"].fail("it must be between 0 and pi");
  Statement statement{"Camera \"perspective\""};
  const double least = aspect >= 1 ? high : 2 * std::atan(aspect * std::tan(high / 2));
  statement.number("fov", least * kDegrees, INFINITY);
  return {statement, aspect};
}

}  // namespace dspm::gltf
