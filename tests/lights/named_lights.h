// Lights without a shape, of all kinds, with their names, for tests.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/lights/environment.h"
#include "tests/lights/lamps.h"

namespace dspm::test {

inline constexpr float kRadius = 4;   // of the sphere around the scene
inline const Rgb kStrength(3, 2, 1);  // also of area_lamps()

struct NamedLight {
  std::string name;
  std::unique_ptr<Light> light;
};

inline LightContext around_the_scene() {
  LightContext context;
  context.scene_center = {.5f, .2f, -1.5f};
  context.scene_radius = kRadius;
  return context;
}

inline NamedLight sun() { return {"distant", make_light("distant", {rgb("L", kStrength)}, around_the_scene())}; }

inline std::vector<NamedLight> sun_disks() {
  std::vector<NamedLight> lights;
  for (const float angle : {0.5f, 60.f, 180.f})
    lights.push_back(
        {"distant " + std::to_string(angle),
         make_light("distant", {rgb("L", kStrength), point("from", {1, 2, 4}), point("to", {}), number("angle", angle)},
                    around_the_scene())});
  return lights;
}

inline std::vector<NamedLight> spots() {
  std::vector<NamedLight> lights;
  for (const auto& [angle, delta] : {std::pair{40.f, 0.f}, {40.f, 10.f}, {40.f, 40.f}, {120.f, 50.f}})
    lights.push_back(
        {"spot " + std::to_string(angle) + " " + std::to_string(delta),
         make_light("spot", {rgb("I", kStrength), number("coneangle", angle), number("conedeltaangle", delta)}, {})});
  return lights;
}

/// Lights at one point.
inline std::vector<NamedLight> points() {
  std::vector<NamedLight> lights = spots();
  lights.push_back({"point", make_light("point", {rgb("I", kStrength)}, {})});
  return lights;
}

/// Lights at one point that an image shapes, turned and stretched.
inline std::vector<NamedLight> shaped(const EnvironmentFile& file) {
  LightContext context;
  std::vector<NamedLight> lights;
  const Matrix4 turned = Matrix4::rotate(70, 1, 2, 3);
  for (const Matrix4& m : {turned, turned * Matrix4::scale(1, 2, .7)}) {
    context.to_world = Transform(m);
    const std::vector<Param> image{text("filename", file.path()), number("scale", 2)};
    lights.push_back({"goniometric", make_light("goniometric", image, context)});
    lights.push_back({"projection", make_light("projection", image, context)});
  }
  return lights;
}

/// The image in a file as an infinite light, turned and stretched.
inline std::vector<NamedLight> images(const EnvironmentFile& file) {
  LightContext context = around_the_scene();
  std::vector<NamedLight> lights;
  const Matrix4 turned = Matrix4::rotate(70, 1, 2, 3);
  for (const Matrix4& m : {turned, turned * Matrix4::scale(1, 2, .7)}) {
    context.to_world = Transform(m);
    lights.push_back({"image", make_light("infinite", {text("filename", file.path())}, context)});
  }
  return lights;
}

/// Infinite lights of that image, of one colour, and of one colour in a cone.
inline std::vector<NamedLight> skies(const EnvironmentFile& file) {
  std::vector<NamedLight> lights = images(file);
  lights.push_back({"infinite", make_light("infinite", {rgb("L", kStrength)}, around_the_scene())});
  for (NamedLight& disk : sun_disks()) lights.push_back(std::move(disk));
  return lights;
}

}  // namespace dspm::test
