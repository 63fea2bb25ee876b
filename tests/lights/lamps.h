// Lights of all kinds, with shapes of all kinds, for tests.
#pragma once

#include "dspm/lights/light.h"
#include "dspm/shapes/triangle_mesh.h"
#include "tests/lights/params.h"

namespace dspm::test {

inline std::unique_ptr<Light> make_light(const std::string& name, std::vector<Param> params,
                                         const LightContext& context) {
  return make(light_plugins(), name, std::move(params), context);
}

inline std::unique_ptr<Shape> make_shape(const std::string& name, std::vector<Param> params) {
  Diagnostics diagnostics;
  const Plugin<MakeShape>* plugin = shape_plugins().find(name, {}, diagnostics);
  const ParamList list{std::move(params)};
  ParamReader reader(list, "shape \"" + name + "\"", {}, diagnostics);
  auto parts = plugin->make(reader);
  for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << to_string(d);
  return std::move(parts.at(0).shape);
}

/// An area light with the shape that it lives on.
struct AreaLamp {
  std::string name;
  std::unique_ptr<Shape> shape;
  std::unique_ptr<PlacedShape> placed;
  std::unique_ptr<Light> light;
};

inline AreaLamp make_lamp(std::string name, std::unique_ptr<Shape> shape, const Matrix4& to_world,
                          std::vector<Param> params = {}, bool flip_normals = false) {
  AreaLamp lamp{std::move(name), std::move(shape), std::make_unique<PlacedShape>(), nullptr};
  lamp.placed->shape = lamp.shape.get();
  lamp.placed->to_world = Transform(to_world);
  lamp.placed->to_world_is_identity = lamp.placed->to_world.is_identity();
  lamp.placed->flip_normals = flip_normals;
  LightContext context;
  context.shape = lamp.placed.get();
  lamp.light = make(area_light_plugins(), "diffuse", std::move(params), context);
  return lamp;
}

/// Four triangles of unequal areas, not in one plane.
inline std::unique_ptr<Shape> unequal_mesh() {
  MeshData data;
  data.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {.1f, .1f, .5f}, {-.2f, 0, .1f}, {-1, -1, -.3f}};
  data.faces = {{0, 1, 2}, {0, 3, 4}, {0, 4, 5}, {2, 1, 3}};
  return std::make_unique<TriangleMesh>(std::move(data));
}

/// Around the origin, about 1 to 2 in size; what is above z = -2 is lit by most of them.
inline std::vector<AreaLamp> area_lamps() {
  const Matrix4 turned = Matrix4::rotate(130, 1, 2, .5), stretched = Matrix4::scale(1.5, .4, .8),
                skewed = Matrix4::translate(.2, -.1, .3) * turned * stretched;
  std::vector<AreaLamp> lamps;
  const auto add = [&](std::string name, std::unique_ptr<Shape> shape, const Matrix4& to_world,
                       std::vector<Param> params = {}, bool flip = false) {
    params.push_back(rgb("L", {3, 2, 1}));
    lamps.push_back(make_lamp(std::move(name), std::move(shape), to_world, std::move(params), flip));
  };
  add("sphere", make_shape("sphere", {}), {});
  add("stretched sphere", make_shape("sphere", {number("radius", .8f)}), skewed);
  add("partial sphere", make_shape("sphere", {number("zmin", -.9f), number("zmax", .5f), number("phimax", 300)}),
      skewed);
  add("partial sphere, both sides", make_shape("sphere", {number("zmax", .3f), number("phimax", 250)}), turned,
      {flag("twosided", true)});
  add("disk", make_shape("disk", {}), Matrix4::rotate(180, 1, 0, 0));
  add("disk, reversed", make_shape("disk", {}), {}, {}, true);
  add("ring, both sides", make_shape("disk", {number("innerradius", .5f), number("phimax", 200)}), skewed,
      {flag("twosided", true)});
  add("cylinder", make_shape("cylinder", {}), skewed);
  const std::vector<float> corners{-1, -1, 0, 1, -1, .4f, -1, 1, .3f, .8f, 1, -.2f};
  add("bent patch", make_shape("bilinearmesh", {{ParamType::point3, "P", {}, corners, {}, {}}}), skewed,
      {flag("twosided", true)});
  add("mirrored mesh", unequal_mesh(), Matrix4::scale(1, 1, -1));
  add("mesh, both sides", unequal_mesh(), {}, {flag("twosided", true)});
  add("stretched mesh", unequal_mesh(), skewed, {}, true);
  return lamps;
}

}  // namespace dspm::test
