// Variations from the command line: each image is, bit by bit, that of a plain scene with the variation's definitions
// written in; names, choices, headers and reports tell which is which.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "tests/output/json_check.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

struct Definitions {
  std::string legs = R"(MakeNamedMaterial "legs" "string type" "diffuse" "rgb reflectance" [.5 .4 .3])";
  std::string cloth = R"(Texture "cloth" "spectrum" "checkerboard" "rgb tex1" [.2 .2 .2] "rgb tex2" [.8 .8 .8])";
  std::string seat = R"(MakeNamedMaterial "seat" "string type" "diffuse" "texture reflectance" "cloth")";
  std::string scale = "1";
  std::string parts = R"(DynamicBegin "cushion" Translate 0 .9 0 Shape "sphere" "float radius" .3 DynamicEnd
DynamicBegin "bell" Translate 0 .9 0 Shape "sphere" "float radius" .2 DynamicEnd)";
};

/// Two balls and what lies on them, in a large sphere.
std::string product(const std::string& options, const Definitions& d = {}) {
  return options + fmt::format(R"(
LookAt 0 .5 -4  0 .3 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 12 "string filename" "chair.exr" "bool savefp16" false
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [9 8 7] "string name" "key" "float scale" {}
  Translate 0 2.5 -1
  Shape "sphere" "float radius" .4
AttributeEnd
{}
{}
{}
Material "diffuse" "rgb reflectance" [.6 .6 .6]
AttributeBegin Translate 0 0 8 Shape "sphere" "float radius" 29 AttributeEnd
NamedMaterial "legs"
AttributeBegin Translate -.6 .1 0 Shape "sphere" "float radius" .5 AttributeEnd
NamedMaterial "seat"
AttributeBegin Translate .6 .1 0 Shape "sphere" "float radius" .5 AttributeEnd
{}
)",
                               d.scale, d.legs, d.cloth, d.seat, d.parts);
}

constexpr const char* kPath =
    R"(Integrator "path" "integer maxdepth" 5 Sampler "independent" "integer pixelsamples" 3)";
constexpr const char* kSppm =
    R"(Integrator "sppm" "string emission" "power" "string direct" "photons" "integer iterations" 3 "integer photons" 1000 "integer maxdepth" 5)";
constexpr const char* kDsppm =
    R"(Integrator "dsppm" "string emission" "power" "string direct" "photons" "integer iterations" 3 "integer photons" 1000 "integer maxdepth" 5)";

constexpr const char* kOak = R"(MakeNamedMaterial "legs" "string type" "diffuse" "rgb reflectance" [.55 .38 .2])";
constexpr const char* kSteel = R"(MakeNamedMaterial "legs" "string type" "conductor" "float roughness" .15)";
constexpr const char* kDots =
    R"(Texture "cloth" "spectrum" "checkerboard" "rgb tex1" [1 0 0] "rgb tex2" [0 0 1] "float uscale" 4)";
constexpr const char* kGlass = R"(MakeNamedMaterial "seat" "string type" "dielectric")";
constexpr const char* kCushion =
    R"(DynamicBegin "cushion" Translate 0 .9 0 Shape "sphere" "float radius" .3 DynamicEnd)";
constexpr const char* kBell = R"(DynamicBegin "bell" Translate 0 .9 0 Shape "sphere" "float radius" .2 DynamicEnd)";

std::string variation(const std::string& name, const std::string& contents) {
  return fmt::format("VariationBegin \"{}\" {} VariationEnd\n", name, contents);
}

const std::string kAxes = "AxisBegin \"legs\"\n" + variation("oak", kOak) + variation("steel", kSteel) +
                          "AxisEnd\nAxisBegin \"seat\"\n" +
                          variation("dots", std::string(kDots) + " Show \"cushion\"") +
                          variation("glass", std::string(kGlass) + R"( Show "bell" Light "key" "float scale" .5)") +
                          variation("bare", R"(Hide "bell" Light "key" "float scale" 0)") + "AxisEnd\n";

/// The plain scenes of the six variations, by name.
std::vector<std::pair<std::string, Definitions>> plain_scenes() {
  std::vector<std::pair<std::string, Definitions>> scenes;
  for (const char* legs : {kOak, kSteel}) {
    Definitions dots, glass, bare;
    dots.legs = glass.legs = bare.legs = legs;
    dots.cloth = kDots, dots.parts = kCushion;
    glass.seat = kGlass, glass.scale = ".5", glass.parts = kBell;
    bare.scale = "0", bare.parts = "";
    const std::string name = legs == kOak ? "oak-" : "steel-";
    scenes.insert(scenes.end(), {{name + "dots", dots}, {name + "glass", glass}, {name + "bare", bare}});
  }
  return scenes;
}

class ProductDirectory : public TemporaryDirectory {
 public:
  explicit ProductDirectory(const std::string& options = kPath, const std::string& axes = kAxes) {
    put_file(*this / "chair.dsc", product(options));
    put_file(*this / "finishes.dsc", "Include \"chair.dsc\"\n" + axes);
  }
  bool has(const std::string& name) const { return std::filesystem::exists(*this / name); }
  Image image(const std::string& name) const { return read_image(*this / name); }
  Outcome render(std::vector<std::string> options) const {
    options.insert(options.begin(), {"finishes.dsc", "--quiet"});
    Outcome outcome = run(*this, options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  Image plain(const std::string& scene, const std::string& name) const {
    put_file(*this / "plain.dsc", scene);
    const Outcome outcome = run(*this, {"plain.dsc", "--quiet", "-o", "plain.exr"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return image(name);
  }
};

float largest(const Image& image) {
  float value = 0;
  for (const Rgb& pixel : image.pixels) value = std::max(value, max_component(pixel));
  return value;
}

/// Sums may have another order.
void expect_close(const Image& a, const Image& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t p = 0; p < a.pixels.size(); ++p) {
    const Rgb difference = a.pixels[p] - b.pixels[p];
    const float most = std::max({std::abs(difference.r), std::abs(difference.g), std::abs(difference.b)});
    EXPECT_LE(most, 1e-5f * std::max(1.f, max_component(b.pixels[p])));
  }
}

TEST(Variations, AreThePlainScenesBitByBit) {
  for (const char* integrator : {kPath, kSppm}) {
    const ProductDirectory directory(integrator);
    directory.render({});
    for (const auto& [name, definitions] : plain_scenes()) {
      SCOPED_TRACE(name);
      const Image of_product = directory.image("chair." + name + ".exr");
      EXPECT_EQ(of_product, directory.plain(product(integrator, definitions), "plain.exr"));
      EXPECT_EQ(largest(of_product) > 0, definitions.scale != "0");
    }
  }
}

TEST(Variations, RenderedTogetherAreThoseOfSppm) {
  const ProductDirectory directory(kDsppm);
  directory.render({});
  for (const auto& [name, definitions] : plain_scenes()) {
    SCOPED_TRACE(name);
    const Image a = directory.image("chair." + name + ".exr");
    const Image b = directory.plain(product(kSppm, definitions), "plain.exr");
    expect_close(a, b);
  }
}

/// The mesh of a block with its lower corner at the origin.
std::string block(double width, double height, double depth) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
  for (int corner = 0; corner < 8; ++corner)
    ply += fmt::format("{} {} {}\n", corner % 2 * width, corner / 2 % 2 * height, corner / 4 * depth);
  return ply + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
}

constexpr const char* kMeshChair = R"(
LookAt 0 1.2 -2.6  0 .3 0  0 1 0
Camera "perspective" "float fov" 38
Film "rgb" "integer xresolution" 20 "integer yresolution" 16 "string filename" "chair.exr" "bool savefp16" false
WorldBegin
AttributeBegin
  Translate .5 2 -.5  Rotate 90 1 0 0
  AreaLightSource "diffuse" "rgb L" [20 19 17]
  Shape "disk" "float radius" .5
AttributeEnd
MakeNamedMaterial "legs" "string type" "diffuse" "rgb reflectance" [.5 .5 .5]
MakeNamedMaterial "seat" "string type" "diffuse" "rgb reflectance" [.5 .5 .5]
Material "diffuse" "rgb reflectance" [.7 .7 .7]
AttributeBegin Rotate -90 1 0 0 Shape "disk" "float radius" 5 AttributeEnd
ObjectBegin "leg" NamedMaterial "legs" Shape "plymesh" "string filename" "leg.ply" ObjectEnd
AttributeBegin Translate -.35 0 -.35 ObjectInstance "leg" AttributeEnd
AttributeBegin Translate .25 0 -.35 ObjectInstance "leg" AttributeEnd
AttributeBegin Translate -.35 0 .25 ObjectInstance "leg" AttributeEnd
AttributeBegin Translate .25 0 .25 ObjectInstance "leg" AttributeEnd
NamedMaterial "seat"
AttributeBegin Translate -.35 .5 -.35 Shape "plymesh" "string filename" "seat.ply" AttributeEnd
)";

constexpr const char* kFinishes = R"(Include "chair.dsc"  # names its materials "legs" and "seat"
AxisBegin "legs"
  VariationBegin "oak"    MakeNamedMaterial "legs" "string type" "diffuse" "rgb reflectance" [.55 .38 .2]  VariationEnd
  VariationBegin "steel"  MakeNamedMaterial "legs" "string type" "conductor" "float roughness" 0.15        VariationEnd
AxisEnd
AxisBegin "seat"
  VariationBegin "red"    MakeNamedMaterial "seat" "string type" "diffuse" "rgb reflectance" [.7 .05 .05]  VariationEnd
  VariationBegin "blue"   MakeNamedMaterial "seat" "string type" "diffuse" "rgb reflectance" [.05 .1 .6]   VariationEnd
  VariationBegin "glass"  MakeNamedMaterial "seat" "string type" "dielectric" "float eta" 1.5              VariationEnd
AxisEnd
)";

TEST(Variations, OfAChairOfMeshesAreThoseOfSppm) {
  const TemporaryDirectory directory;
  put_file(directory / "leg.ply", block(.1, .5, .1));
  put_file(directory / "seat.ply", block(.7, .1, .7));
  put_file(directory / "chair.dsc", kDsppm + std::string(kMeshChair));
  put_file(directory / "chair-finishes.dsc", kFinishes);
  const Outcome joint = run(directory, {"chair-finishes.dsc", "--quiet"});
  EXPECT_EQ(joint.code, 0) << joint.err;
  EXPECT_EQ(run(directory, {"chair-finishes.dsc", "--quiet", "--integrator", "sppm", "-o", "alone.exr"}).code, 0);
  for (const char* name : {"oak-red", "oak-blue", "oak-glass", "steel-red", "steel-blue", "steel-glass"}) {
    SCOPED_TRACE(name);
    const Image alone = read_image(directory / fmt::format("alone.{}.exr", name));
    EXPECT_GT(largest(alone), 0);
    expect_close(read_image(directory / fmt::format("chair.{}.exr", name)), alone);
  }
}

TEST(Variations, MultiplyWithFramesAndKeys) {
  const std::string frames = "Frames 3\n" + std::string(kPath);
  const std::string keyed =
      R"(MakeNamedMaterial "legs" "string type" "diffuse" "rgb reflectance@1" [1 0 0] "rgb reflectance@3" [0 0 1])";
  const ProductDirectory directory(frames, variation("plain", kOak) + variation("changing", keyed) +
                                               variation("dim", R"(Light "key" "float scale@1" 1 "float scale@3" .5)"));
  directory.render({"--contact-sheet", "sheet.png"});
  Definitions definitions;
  definitions.legs = keyed;
  directory.plain(product(frames, definitions), "plain.0001.exr");
  for (int frame = 1; frame <= 3; ++frame)
    EXPECT_EQ(directory.image(fmt::format("chair.changing.{:04}.exr", frame)),
              directory.image(fmt::format("plain.{:04}.exr", frame)));
  EXPECT_EQ(directory.image("chair.plain.0001.exr"), directory.image("chair.plain.0003.exr"));
  definitions = {};
  definitions.scale = ".75";
  EXPECT_EQ(directory.image("chair.dim.0002.exr"), directory.plain(product(kPath, definitions), "plain.exr"));
}

TEST(Variations, AloneAreThoseOfTheWholeProduct) {
  const ProductDirectory directory(kDsppm);
  directory.render({});
  const Image all = directory.image("chair.steel-glass.exr");
  directory.render({"--variation", "steel-glass", "-o", "alone.exr", "--integrator", "sppm"});
  const Image alone = directory.image("alone.steel-glass.exr");
  expect_close(all, alone);
}

TEST(Variations, AreChosenByPatternsAndFrames) {
  const ProductDirectory directory("Frames 4\n" + std::string(kPath));
  directory.render({"--variation", "oak-*s", "--variation", "steel-bare", "--frames", "2,4", "-o", "a.%02d.exr"});
  for (const char* name : {"a.oak-dots.02.exr", "a.oak-dots.04.exr", "a.steel-bare.02.exr", "a.oak-glass.04.exr"})
    EXPECT_TRUE(directory.has(name)) << name;
  EXPECT_EQ(directory.file_count(), 2 + 6 + 2) << "scenes, images, output";
  EXPECT_EQ(run(directory, {"finishes.dsc", "--list-variations"}).out,
            "oak-dots\noak-glass\noak-bare\nsteel-dots\nsteel-glass\nsteel-bare\n");
  EXPECT_EQ(run(directory, {"finishes.dsc", "--list-variations", "--variation", "*-bare"}).out,
            "oak-bare\nsteel-bare\n");
}

TEST(Variations, ThatAreNotThereAreAUsageError) {
  const ProductDirectory directory;
  const Outcome close = run(directory, {"finishes.dsc", "--variation", "oka-dots"});
  EXPECT_EQ(close.code, 2);
  EXPECT_EQ(close.err, "dspm: --variation oka-dots: there is no such variation; did you mean \"oak-dots\"?\n");
  EXPECT_EQ(run(directory, {"finishes.dsc", "--variation", "oak"}).err,
            "dspm: --variation oak: there is no such variation; did you mean 'oak-*'?\n");
  EXPECT_EQ(run(directory, {"finishes.dsc", "--variation", "glass"}).err,
            "dspm: --variation glass: there is no such variation; did you mean '*-glass'?\n");
  const Outcome far = run(directory, {"finishes.dsc", "--variation", "x*"});
  EXPECT_NE(far.err.find("the scene has: oak-dots, oak-glass, oak-bare, steel-dots, steel-glass, steel-bare"),
            far.err.npos)
      << far.err;
  EXPECT_EQ(run(directory, {"chair.dsc", "--variation", "oak"}).err,
            "dspm: --variation oak: the scene has no variations\n");
  EXPECT_EQ(run(directory, {"finishes.dsc", "--video", "a.mp4"}).code, 2);
}

TEST(Variations, HaveNamesByATemplateAndATable) {
  const ProductDirectory directory;
  directory.render({"--variation", "*-bare", "--png", "-o", "{seat}, {legs}.exr", "--index", "all.csv"});
  EXPECT_EQ(contents(directory / "all.csv"),
            "file,png,variation,legs,seat\r\n"
            "\"bare, oak.exr\",\"bare, oak.png\",oak-bare,oak,bare\r\n"
            "\"bare, steel.exr\",\"bare, steel.png\",steel-bare,steel,bare\r\n");
  EXPECT_TRUE(directory.has("bare, oak.exr"));
  directory.render({"--variation", "oak-bare", "-o", "{variation}.exr", "--index", "all.json"});
  EXPECT_EQ(contents(directory / "all.json"),
            "[\n  {\n    \"file\": \"oak-bare.exr\",\n    \"variation\": \"oak-bare\",\n    \"axes\": {\n      "
            "\"legs\": \"oak\",\n      \"seat\": \"bare\"\n    }\n  }\n]");
  EXPECT_EQ(run(directory, {"finishes.dsc", "-o", "{seat}.exr"}).code, 2) << "one name for two images";
  EXPECT_EQ(run(directory, {"finishes.dsc", "-o", "{leg}-{seat}.exr", "--quiet"}).err,
            "dspm: the images' name {leg}-{seat}.exr: {leg} is not known; did you mean \"legs\"? there are variation, "
            "legs, seat, frame\n");
}

/// All kinds of files of an image are in its folder.
TEST(Variations, HaveFoldersByATemplate) {
  const ProductDirectory directory;
  directory.render(
      {"--variation", "oak-*s", "--png", "--denoise", "--aov", "N", "--aov-files", "-o", "out/{legs}/a/{seat}.exr"});
  for (const char* file : {"dots.exr", "dots.png", "dots.N.exr", "dots.denoised.exr", "glass.denoised.png"})
    EXPECT_TRUE(directory.has(std::string("out/oak/a/") + file)) << file;
  EXPECT_FALSE(directory.has("out/steel")) << "not chosen";
  const Outcome plain = run(directory, {"finishes.dsc", "-o", "uot/a.exr"});
  EXPECT_NE(plain.code, 0) << "a name without variations may be a slip of the pen";
  EXPECT_FALSE(directory.has("uot"));
  std::filesystem::create_directory(directory / "box");
  std::filesystem::copy_file(directory / "finishes.dsc", directory / "box/finishes.dsc");
  run(directory, {"box/finishes.dsc", "--sandbox", "box", "-o", "outside/{legs}/{seat}.exr"});
  EXPECT_FALSE(directory.has("outside"));
}

TEST(Variations, AreToldInHeadersReportsAndMessages) {
  const ProductDirectory directory;
  const Outcome outcome = run(directory, {"finishes.dsc", "--variation", "steel-*", "--stats=stats.json"});
  EXPECT_NE(outcome.err.find("finishes.dsc: 3 variations of 16 x 12 pixels"), outcome.err.npos) << outcome.err;
  EXPECT_NE(outcome.err.find("chair.steel-dots.exr to chair.steel-bare.exr"), outcome.err.npos) << outcome.err;
  const ExrHeader header = read_exr_header(directory / "chair.steel-glass.exr");
  EXPECT_EQ(header.texts.at("variation"), "steel-glass");
  EXPECT_EQ(header.texts.at("variation legs"), "steel");
  EXPECT_EQ(header.texts.at("variation seat"), "glass");
  const std::string stats = contents(directory / "stats.json");
  EXPECT_TRUE(JsonCheck::valid(stats)) << stats;
  const std::size_t names = stats.find("\"variations\": [");
  ASSERT_NE(names, stats.npos);
  EXPECT_LT(stats.find("steel-dots", names), stats.find("steel-bare", names));
}

TEST(Variations, OfFiveHundredFabricsGoInEightIntervals) {
  std::string axes = "AxisBegin \"seat\"\n";
  for (int i = 0; i < 500; ++i)
    axes += variation(
        fmt::format("{:03}", i),
        fmt::format(R"(MakeNamedMaterial "seat" "string type" "diffuse" "rgb reflectance" [{} .5 .5])", i / 500.));
  const ProductDirectory directory(kPath, axes + "AxisEnd\n");
  directory.render({"--iterations", "1", "--pixelbounds", "8,9,6,7", "--stats=stats.json"});
  EXPECT_TRUE(directory.has("chair.000.exr"));
  EXPECT_TRUE(directory.has("chair.499.exr"));
  const std::string stats = contents(directory / "stats.json");
  const std::size_t begin = stats.find("\"iterations\": ["), end = stats.find(']', begin);
  EXPECT_EQ(std::count(stats.begin() + static_cast<std::ptrdiff_t>(begin),
                       stats.begin() + static_cast<std::ptrdiff_t>(end), '1'),
            8);
}

}  // namespace
}  // namespace dspm::test
