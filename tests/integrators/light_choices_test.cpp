// Frames whose lights differ so much that each chooses lights for its photon paths on its own: images converge to what
// is known, and all promises hold.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/test_scene.h"

namespace dspm::test {
namespace light_choices_test {

/// Three lamps, of which each variation has one or two; `sky` is there in all.
std::string room(const std::string& integrator, double sky = 0.02) {
  return fmt::format(R"(
Integrator {0}
LookAt 0 0 3  0 0 0  0 1 0
Camera "perspective" "float fov" 60
PixelFilter "box"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "infinite" "rgb L" [{1} {1} {1}]
DynamicBegin "left" LightSource "point" "rgb I" [9 6 3] "point3 from" [-1 1 2] DynamicEnd
DynamicBegin "right" LightSource "spot" "rgb I" [3 6 9] "point3 from" [1 1 2] "point3 to" [0 0 0] DynamicEnd
DynamicBegin "lamp"
AttributeBegin Translate 0 -1 2 AreaLightSource "diffuse" "rgb L" [6 6 6] "bool twosided" true Shape "disk" "float radius" .5
AttributeEnd DynamicEnd
Material "diffuse" "rgb reflectance" [.6 .6 .6]
Shape "disk" "float radius" 3
Translate 0 0 .6
Shape "sphere" "float radius" .5
VariationBegin "a" Show "left" VariationEnd
VariationBegin "b" Show "right" VariationEnd
VariationBegin "c" Show "lamp" VariationEnd
VariationBegin "d" Show "left" Show "lamp" VariationEnd
)",
                     integrator, sky);
}

TEST(LightChoices, PartHere) {
  TestScene test(room("\"dsppm\""));
  EXPECT_GE(test.scene(test.all_frames())->light_choices.size(), 3U);
}

TEST(LightChoices, ConvergeToWhatPathFinds) {
  const Tiles path = rendered(room(R"("path" "integer maxdepth" 4)"), 128, 16, 2);
  for (const char* integrator :
       {R"("dsppm" "integer photons" 8000 "integer maxdepth" 4 "float radius" .05 "string direct" "photons")",
        R"("dsppm" "integer photons" 8000 "integer maxdepth" 4 "float radius" .05 "string direct" "both")",
        R"("dsppm" "integer photons" 8000 "integer maxdepth" 4 "float radius" .05 "string emission" "power")",
        R"("vcm" "integer photons" 1000 "integer maxdepth" 4 "float radius" .03)"}) {
    const Verdict verdict = agreement(rendered(room(integrator), 8, 16, 2), path, {0.01 / 4, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

TEST(LightChoices, KeepThePromises) {
  for (const char* integrator :
       {R"("dsppm" "integer photons" 2000)", R"("sppm" "integer photons" 2000)",
        R"("photonmap" "integer photons" 2000 "integer causticphotons" 2000)", R"("vcm" "integer photons" 500)"}) {
    const std::string text = room(integrator);
    for (const Verdict& verdict :
         {check_threads(text, 2), check_resume(text, 3), check_joint(text, 2), check_crop(text, 2)})
      EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

}  // namespace light_choices_test
}  // namespace dspm::test
