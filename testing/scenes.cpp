#include "dspm/testing/scenes.h"

#include <fmt/format.h>

namespace dspm::test {

std::string furnace(const std::string& integrator, float albedo, const std::string& shape) {
  return fmt::format(R"(
Integrator {}
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" 80
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
ReverseOrientation
AreaLightSource "diffuse" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [{} {} {}]
Shape {}
)",
                     integrator, albedo, albedo, albedo, shape);
}

std::string open_furnace(const std::string& integrator, const std::string& material) {
  return fmt::format(R"(
Integrator {}
LookAt 0 0 1  0 0 0  0 1 0
Camera "perspective" "float fov" 140
PixelFilter "box"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material {}
Shape "disk" "float radius" 10
)",
                     integrator, material);
}

std::string box(const std::string& options, const std::string& contents, int size) {
  return options +
         fmt::format(R"(
LookAt 0 0 -3.6  0 0 0  0 1 0
Camera "perspective" "float fov" 38
PixelFilter "box"
Film "rgb" "integer xresolution" {} "integer yresolution" {}
WorldBegin
AttributeBegin
  Translate 0 0.95 0
  Rotate 90 1 0 0
  AreaLightSource "diffuse" "rgb L" [12 12 12]
  Material "diffuse" "rgb reflectance" [0 0 0]
  Shape "disk" "float radius" 0.4
AttributeEnd
Material "diffuse" "rgb reflectance" [.7 .7 .7]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 -1 -1 -1 -1 1 1 -1 1 1 -1 -1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 1 -1 1 1 -1 1 1 1 -1 1 1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 -1 1 -1 1 1 1 1 1 1 -1 1]
Material "diffuse" "rgb reflectance" [.7 .15 .1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 -1 -1 -1 1 -1 -1 1 1 -1 -1 1]
Material "diffuse" "rgb reflectance" [.15 .6 .1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [1 -1 -1 1 -1 1 1 1 1 1 1 -1]
)",
                     size, size) +
         contents;
}

}  // namespace dspm::test
