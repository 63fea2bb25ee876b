// Photons off smooth-shaded meshes: on a floor that has its light from the mesh alone, what they bring is what path
// tracing finds. Eight faces with the normals of a sphere bend the shading normal by up to 55 degrees, so that light
// arrives from below its horizon and leaves below it. [Veach 1997, 5.3]
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/image/write_floats.h"
#include "dspm/testing/agreement.h"
#include "dspm/testing/promises.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace bent_normals_test {

constexpr int kMaterials = 8, kSettings = 4;

/// The light shines up from just above the floor; the camera sees a piece of the floor beside light and mesh.
std::string octahedron(const std::string& integrator, const std::string& light, const std::string& material) {
  return fmt::format(R"(
Integrator {}
LookAt 0 3 2  0 0 2  0 0 1
Camera "perspective" "float fov" 30
PixelFilter "box"
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
WorldBegin
{}
Material "diffuse" "rgb reflectance" [.8 .8 .8]
AttributeBegin
  Rotate -90 1 0 0
  Shape "disk" "float radius" 4
AttributeEnd
Material {}
Translate 0 1.2 0
Rotate 20 1 .3 .2
Shape "trianglemesh" "integer indices" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]
  "point3 P" [.8 0 0 -.8 0 0 0 .8 0 0 -.8 0 0 0 .8 0 0 -.8]
  "normal N" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1]
)",
                     integrator, light, material);
}

// It grazes the mesh, and hits nothing else.
constexpr const char* kSpot = R"(LightSource "spot" "rgb I" [9 9 9] "point3 from" [2.2 .1 -.4] "point3 to" [0 1.2 0]
  "float coneangle" 18 "float conedeltaangle" 3)";
// Paths by way of mirrors find it.
constexpr const char* kLamp = R"(AttributeBegin
  Translate 0 0.05 0
  Rotate -90 1 0 0
  AreaLightSource "diffuse" "rgb L" [12 12 12]
  Material "diffuse" "rgb reflectance" [0 0 0]
  Shape "disk" "float radius" 0.8
AttributeEnd)";

struct Case {
  const char *light, *material;
};

class BentNormals : public testing::TestWithParam<Case> {};

TEST_P(BentNormals, PhotonsBringWhatPathsFind) {
  const Tiles path = rendered(octahedron(R"("path" "integer maxdepth" 12)", GetParam().light, GetParam().material), 48);
  for (const char* settings : {R"("string estimator" "kz11")", R"("string estimator" "hj09")",
                               R"("string direct" "photons")", R"("string direct" "sampled")"}) {
    const std::string integrator =
        fmt::format(R"("dsppm" "integer maxdepth" 12 "integer photons" 20000 "float radius" 0.06 {})", settings);
    const Verdict verdict = agreement(rendered(octahedron(integrator, GetParam().light, GetParam().material), 3), path,
                                      {0.01 / (kMaterials * kSettings), 0.02});
    EXPECT_TRUE(verdict.passed) << GetParam().material << " " << settings << ": " << verdict.message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Materials, BentNormals,
    testing::Values(Case{kSpot, R"("diffuse" "rgb reflectance" [.9 .9 .9])"},
                    Case{kSpot, R"("coateddiffuse" "rgb reflectance" [.9 .7 .5] "float roughness" 0.2)"},
                    Case{kSpot, R"("conductor" "float roughness" 0.3)"}, Case{kLamp, R"("conductor")"},
                    Case{kSpot, R"("principled" "rgb basecolor" [.8 .5 .3] "float roughness" 0.5 "float coat" 1
                      "float coatroughness" 0.4)"},
                    Case{kSpot, R"("principled" "float metallic" 1 "float roughness" 0.6)"},
                    Case{kSpot, R"("dielectric" "float roughness" 0.2)"}, Case{kLamp, R"("dielectric")"}));

/// Pictures that lean a floor's normals by 30 degrees towards +x: one of normals, and a slope.
class LeaningPictures {
 public:
  LeaningPictures() {
    Image normal(1, 1), slope(2, 1);
    normal.pixels[0] = {0.75f, 0.5f, 0.5f + 0.5f * std::sqrt(0.75f)};
    slope.pixels[0] = Rgb(1);  // at u = 1/4, and 0 at 3/4
    write_pfm(directory_ / "normal.pfm", normal);
    write_pfm(directory_ / "slope.pfm", slope);
  }
  std::string operator[](const std::string& name) const { return fmt::format("\"{}\"", (directory_ / name).string()); }

 private:
  TemporaryDirectory directory_;
};

/// A floor of side 8 under a sun; the camera sees its middle.
std::string floor_under_sun(const std::string& integrator, const std::string& material, const std::string& normals) {
  return "Integrator " + integrator + R"(
LookAt 0 0 3  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "distant" "rgb L" [2 2 2] "point3 from" [1 0 2] "point3 to" [0 0 0]
)" + material +
         R"(
Shape "trianglemesh" "point3 P" [-4 -4 0  4 -4 0  4 4 0  -4 4 0] "integer indices" [0 1 2  0 2 3]
  "point2 uv" [0 0 1 0 1 1 0 1] )" +
         normals;
}

// A flat floor whose shading normals all lean by 30 degrees receives a sun by the cosine to these: as bright as a floor
// that leans. Photons arrive by the cosine to the geometric normal.
TEST(LeaningNormals, ReceiveByTheirOwnCosine) {
  const double reflectance = 0.5, sun = 2, cosine = (0.5 + 2 * std::sqrt(0.75)) / std::sqrt(5);
  const auto expected = static_cast<float>(reflectance / std::acos(-1.) * sun * cosine);
  const LeaningPictures pictures;
  const std::string diffuse = R"(Material "diffuse" "rgb reflectance" [.5 .5 .5] )";
  struct Lean {
    std::string material, normals;
  };
  // The slope falls by 1 a half turn of u, which is 4 units long.
  const Lean leans[] = {{diffuse, R"("normal N" [.5 0 .8660254  .5 0 .8660254  .5 0 .8660254  .5 0 .8660254])"},
                        {diffuse + "\"string normalmap\" " + pictures["normal.pfm"], ""},
                        {"Texture \"slope\" \"float\" \"imagemap\" \"string wrap\" \"clamp\" \"float scale\" 2.3094011 "
                         "\"string filename\" " +
                             pictures["slope.pfm"] + diffuse + "\"texture displacement\" \"slope\"",
                         ""}};
  // Where the density of a guide's starts changes, wide gathers blur the weights of the ways.
  for (const char* integrator :
       {R"("path")", R"("dsppm" "string emission" "power" "integer photons" 20000 "float radius" 0.2)",
        R"("dsppm" "string emission" "power" "integer photons" 20000 "float radius" 0.2 "string estimator" "hj09")",
        R"("sppm" "string emission" "power" "integer photons" 20000 "float radius" 0.2)",
        R"("dsppm" "string direct" "sampled" "integer photons" 1000)", R"("photonmap")", R"("vcm")"})
    for (const Lean& lean : leans) {
      // Integrators do not know where a vertex has its normal from, so one of each family will do.
      const std::string_view name = integrator;
      const bool one = name == R"("path")" || name == R"("vcm")" || name.find("hj09") != name.npos;
      if (lean.normals.empty() && !one) continue;
      const Tiles seen = rendered(floor_under_sun(integrator, lean.material, lean.normals), 2);
      const Verdict verdict = agreement(seen, Rgb(expected), {0.01, 0.002});
      EXPECT_TRUE(verdict.passed) << integrator << lean.material << ": " << verdict.message;
    }
}

// Frames whose normals differ part, and each is what it is alone.
TEST(LeaningNormals, MayDifferBetweenFrames) {
  const LeaningPictures pictures;
  for (const char* integrator : {R"("path")", R"("dsppm" "integer photons" 2000)", R"("vcm" "integer photons" 500)"}) {
    const std::string material = R"(MakeNamedMaterial "floor" "string type" "coateddiffuse" "float roughness" .3
      VariationBegin "flat" MakeNamedMaterial "floor" "string type" "coateddiffuse" "float roughness" .3 VariationEnd
      VariationBegin "lean" MakeNamedMaterial "floor" "string type" "coateddiffuse" "float roughness" .3
        "string normalmap" )" + pictures["normal.pfm"] +
                                 R"( VariationEnd
      VariationBegin "red" MakeNamedMaterial "floor" "string type" "coateddiffuse" "float roughness" .3
        "rgb reflectance" [.8 .1 .1] VariationEnd NamedMaterial "floor")";
    const Verdict verdict = check_joint(floor_under_sun(integrator, material, ""), 2);
    EXPECT_TRUE(verdict.passed) << integrator << ": " << verdict.message;
  }
}

}  // namespace bent_normals_test
}  // namespace dspm::test
