// Light tracing finds what paths from the camera find, in both frames of a room through which a ball of frosted metal
// moves. The lamp is out of sight, because light tracing does not show lamps.
#include <dspm/testing/agreement.h>
#include <dspm/testing/checks.h>
#include <dspm/testing/promises.h>

namespace {

std::string room(const std::string& integrator) {
  return "Integrator " + integrator + R"(
Frames 2
LookAt 0 1.6 -4.2  0 0.6 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [30 28 26]
  Translate 1.2 3.2 -0.6
  Shape "sphere" "float radius" 0.4
AttributeEnd
Material "diffuse" "rgb reflectance" [.65 .6 .55]
Shape "trianglemesh" "point3 P" [-3 0 -5  3 0 -5  3 0 2  -3 0 2  -3 4 2  3 4 2  -3 4 -5  3 4 -5]
  "integer indices" [0 2 1  0 3 2  3 5 2  3 4 5  0 6 4  0 4 3  1 2 5  1 5 7]
DynamicBegin "ball"
  Keyframe 1 Translate -0.6 0.5 0
  Keyframe 2 Translate 0.6 0.5 0
  KeyframeEnd
  Material "conductor" "float roughness" 0.2
  Shape "sphere" "float radius" 0.5
DynamicEnd
)";
}

}  // namespace

int main(int count, char** arguments) {
  using namespace dspm::test;
  return run_checks(count, arguments, [](Checks& checks) {
    checks.add("a room as path sees it", [] {
      const Tiles path = rendered(room(R"("path" "integer maxdepth" 4)"), 24);
      return agreement(rendered(room(R"("lighttracer" "integer maxdepth" 4 "integer photons" 100000)"), 2), path);
    });
    const std::string short_run = room(R"("lighttracer" "integer photons" 20000)");
    checks.add("the same bits with any number of threads", [&] { return check_threads(short_run); });
    checks.add("the same bits when resumed", [&] { return check_resume(short_run); });
    checks.add("frames rendered together are those rendered alone", [&] { return check_joint(short_run); });
    checks.add("a crop is a part of the whole", [&] { return check_crop(short_run); });
  });
}
