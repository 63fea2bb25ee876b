// Slabs and sheets much thinner than the radius of gathers, which let light through: light that falls on one side is not
// taken for light on the other. Path tracing, which gathers nothing, tells what is right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "dspm/testing/agreement.h"
#include "tests/support/seeds.h"

namespace dspm::test {
namespace thin_slabs_test {

/// A closed box, 2 wide, whose faces lie at z = 0 and z = -thickness.
std::string slab(double thickness) {
  return fmt::format(
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3  4 6 5 4 7 6  0 5 1 0 4 5  1 6 2 1 5 6  "
      "2 7 3 2 6 7  3 4 0 3 7 4] \"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0  "
      "-1 -1 {0}  1 -1 {0}  1 1 {0}  -1 1 {0}]\n",
      -thickness);
}

/// Two squares that face up, of one shape each.
std::string sheets(double distance) {
  std::string text;
  for (const double z : {0., -distance})
    text += fmt::format(
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
        "[-1 -1 {0}  1 -1 {0}  1 1 {0}  -1 1 {0}]\n",
        z);
  return text;
}

/// A square whose halves are wound in opposite directions: that is no reason to take them for two surfaces.
const std::string kSloppySheet =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2  2 1 3] \"point3 P\" [-1 -1 0  0 -1 0  -1 1 0  0 1 0]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 2 1  2 3 1] \"point3 P\" [0 -1 0  1 -1 0  0 1 0  1 1 0]\n";

/// The sun above, and perhaps a pane: what it passes straight on, of which each face reflects 0.04, is (1 - .04) / (1 + .04).
struct Sight {
  const char* name;
  std::string things;
  bool pane = false;
  double height = -0.5;  // of the camera, which looks at the origin
};

std::string scene(const Sight& sight, const std::string& integrator, bool pane) {
  const double sun = sight.pane && !pane ? (1 - .04) / (1 + .04) : 1;
  return fmt::format(R"(
Integrator {}
LookAt .2 .1 {}  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.4 .4 -.4 .4]
PixelFilter "box"
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "distant" "rgb L" [{} {} {}] "point3 from" [0 0 1] "point3 to" [0 0 0]
{}
)",
                     integrator, sight.height, sun, sun, sun, sight.things) +
         (pane ? "Material \"thindielectric\"\nTranslate 0 0 12 Shape \"disk\" \"float radius\" 1.3\n" : "");
}

constexpr const char* kFrosted = "Material \"dielectric\" \"float roughness\" .3 \"bool remaproughness\" false\n";
constexpr const char* kPaper =
    "Material \"diffusetransmission\" \"rgb reflectance\" [.4 .3 .2] \"rgb transmittance\" [.3 .4 .5]\n";
constexpr const char* kThinGlass =
    "Material \"principled\" \"float transmission\" .7 \"bool thin\" true \"float roughness\" .6 "
    "\"float diffusetransmission\" .5\n";

const Sight kSights[] = {
    {"FrostedSlabBehindAPane", kFrosted + slab(0.02), true},
    {"ThinnerFrostedSlabBehindAPane", kFrosted + slab(0.001), true},
    // Most of its light meets several facets: it leaves through matte lobes.
    {"RoughestSlabBehindAPane", "Material \"dielectric\" \"float roughness\" 1\n" + slab(0.01), true},
    {"RoughestSlabBehindAPaneFromAbove", "Material \"dielectric\" \"float roughness\" 1\n" + slab(0.01), true, 0.5},
    {"FrostedSlabBehindAPaneFromAbove", kFrosted + slab(0.02), true, 0.5},
    {"ThinGlassSheetsBehindAPane", kThinGlass + sheets(0.01), true},
    {"MixOfFrostedGlassAndPaper",
     std::string("MakeNamedMaterial \"glass\" \"string type\" \"dielectric\" \"float roughness\" .5\n"
                 "MakeNamedMaterial \"paper\" \"string type\" \"diffusetransmission\"\n"
                 "Material \"mix\" \"string materials\" [\"glass\" \"paper\"] \"float amount\" .5\n") +
         slab(0.01),
     true},
    {"PaperSheets", kPaper + sheets(0.01)},
    {"PaperSheetsFromAbove", kPaper + sheets(0.01), false, 0.5},
    {"ThinnerPaperSheets", kPaper + sheets(0.001)},
    {"PaperBox", kPaper + slab(0.01)},
    {"ThinGlassSheets", kThinGlass + sheets(0.01)},
    {"SloppyPaper", kPaper + kSloppySheet},
};

class ThinSlabs : public testing::TestWithParam<Sight> {};

TEST_P(ThinSlabs, ShowOneSide) {
  const Sight& sight = GetParam();
  const int times = seeds(8);
  const Tiles path = rendered(scene(sight, "\"path\" \"integer maxdepth\" 4", false), 128, times);
  for (const char* integrator : {
           R"("dsppm" "integer maxdepth" 5 "integer photons" 600 "float radius" .15 "string direct" "photons")",
           R"("vcm" "integer maxdepth" 5 "integer photons" 400 "float radius" .15)",
           R"("vcm" "integer maxdepth" 5 "integer photons" 400 "float radius" .15 "bool connect" false)",
       }) {
    const Verdict verdict =
        agreement(rendered(scene(sight, integrator, sight.pane), 12, times), path, {0.01 / 33, 0.01});
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ThinSlabs, testing::ValuesIn(kSights), [](const auto& each) { return each.param.name; });

}  // namespace thin_slabs_test
}  // namespace dspm::test
