// What a camera with a lens of glass sees, by every integrator: it weighs its rays, loses some of them, and cannot say
// where it sees a point.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "dspm/testing/scenes.h"
#include "tests/integrators/box_scene.h"
#include "tests/support/seeds.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace lens_camera_test {

class LensCamera : public testing::Test {
 protected:
  LensCamera() {
    // Two bulges of index 1.6 around a stop, f = 48 mm: much of the picture's corners is vignetted.
    put_file(directory_ / "pair.dat", "55 5 1.6 24\n-400 6 1 24\n0 6 0 14\n400 5 1.6 24\n-55 40 1 24\n");
  }

  std::string scene(const std::string& integrator, const std::string& further = {}) const {
    std::string text = box("Integrator " + integrator + " \"integer maxdepth\" 5\n", R"(
Material "coateddiffuse" "rgb reflectance" [.5 .5 .8] "float roughness" 0.1
Translate 0.2 -0.6 -0.3
Shape "sphere" "float radius" 0.4)",
                           32);
    replace(text, "0 0 0  0 1 0", "0 -0.3 0  0 1 0");
    replace(text, R"("perspective" "float fov" 38)",
            fmt::format(R"("realistic" "string lensfile" "{}" "float aperturediameter" 14 {})",
                        (directory_ / "pair.dat").string(), further.empty() ? "\"float focusdistance\" 2.5" : further));
    return text;
  }

  TemporaryDirectory directory_;
};

TEST_F(LensCamera, AllIntegratorsAgree) {
  const char* const ways[] = {
      R"("dsppm" "integer photons" 10000 "float radius" 0.03)",
      R"("sppm" "string estimator" "hj09" "integer photons" 10000 "float radius" 0.03)",
      R"("vcm" "integer photons" 700 "float radius" 0.02)",
      R"("vcm" "integer photons" 700 "bool merge" false)",
  };
  const Tiles path = rendered(scene(R"("path")"), 12, seeds(8), 2);
  for (const char* way : ways) {
    const Verdict verdict = agreement(rendered(scene(way), 2, seeds(8), 2), path, {0.01 / 4, 0.02});
    EXPECT_TRUE(verdict.passed) << way << ": " << verdict.message;
  }
}

// Frames whose focus and stop differ share photons, not camera paths.
TEST_F(LensCamera, FramesAreWhatTheyAreAlone) {
  for (const char* integrator : {R"("dsppm" "integer photons" 3000)", R"("vcm" "integer photons" 600)"}) {
    const std::string text =
        "Frames 4\n" + scene(integrator, R"("float focusdistance@1" 2.5 "float focusdistance@4" 3.5)");
    const Verdict verdict = check_joint(text, 2);
    EXPECT_TRUE(verdict.passed) << verdict.message;
  }
}

}  // namespace lens_camera_test
}  // namespace dspm::test
