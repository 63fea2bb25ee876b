// Closed boxes are furnaces, so no ray leaks out; in glass no light is lost; and a box that is all roundness is a
// sphere, as a thing and as a lamp.
#include <dspm/testing/agreement.h>
#include <dspm/testing/checks.h>
#include <dspm/testing/scenes.h>

namespace {

constexpr const char* kGlass = R"(
Integrator "path" "integer maxdepth" 100
LookAt 2 2 -3  0 0 0  0 1 0
Camera "perspective" "float fov" 30
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material "dielectric" "float eta" 1.5
Shape "roundbox" "vector3 size" [1.2 1 0.7] "float radius" 0.15
)";

std::string lamp_and_ball(const std::string& shape) {
  return dspm::test::box(R"(Integrator "path" "integer maxdepth" 4)", R"(
AttributeBegin
  Translate 0.4 -0.5 0.2
  Material "conductor" "float roughness" 0.2
  Shape )" + shape + R"(
AttributeEnd
Translate -0.4 -0.4 0
AreaLightSource "diffuse" "rgb L" [4 3 2]
Shape )" + shape,
                         24);
}

}  // namespace

int main(int count, char** arguments) {
  using namespace dspm;
  using namespace dspm::test;
  return run_checks(count, arguments, [](Checks& checks) {
    const std::string box =
        furnace(R"("path" "integer maxdepth" 40)", 0.5f, R"("roundbox" "vector3 size" [3 4 5] "float radius" 0.4)");
    checks.add("inside a box", [&] { return agreement(rendered(box, 8), Rgb(2)); });
    checks.add("of glass under an even sky: invisible", [&] {
      return agreement(rendered(kGlass, 4), Rgb(1), {0.01, 0.001});
    });
    checks.add("as round as a sphere", [&] {
      return agreement(rendered(lamp_and_ball(R"("roundbox" "vector3 size" [.6 .6 .6] "float radius" 0.3)"), 12),
                       rendered(lamp_and_ball(R"("sphere" "float radius" 0.3)"), 12));
    });
  });
}
