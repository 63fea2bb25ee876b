// Point lights that an image or a photometric file shapes, against lights and integrals that are known.
#include <gtest/gtest.h>

#include <fstream>

#include "dspm/base/math/sampling.h"
#include "dspm/base/math/sphere_mapping.h"
#include "dspm/lights/ies.h"
#include "tests/lights/environment.h"
#include "tests/lights/lamps.h"

namespace dspm {
namespace {

using namespace dspm::test;

Image grey(int width, int height, float value) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), Rgb(value));
  return image;
}

float intensity(const Light& light, const Vec3& w) {
  const auto l = light.illuminate(w, {});
  return l ? l->radiance.g * length2(w) : 0;
}

/// A photometric file, as long as this lives.
class IesFile {
 public:
  explicit IesFile(const std::string& contents)
      : path_(testing::TempDir() + "dspm_lamp_" + std::to_string(getpid()) + ".ies") {
    std::ofstream(path_) << contents;
  }
  ~IesFile() { std::filesystem::remove(path_); }
  IesFile(const IesFile&) = delete;
  IesFile& operator=(const IesFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// `tail`: what follows the numbers of vertical and horizontal angles.
std::string ies(const std::string& counts, const std::string& tail, const std::string& tilt = "TILT=NONE\n") {
  return "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] nobody, 12 3\n" + tilt + "1 1000 2 " + counts +
         " 1 2 0 0 0\n.5 1.0 60\n" + tail;
}

TEST(Goniometric, OfAWhiteImageIsAPoint) {
  const EnvironmentFile file(grey(4, 4, 1));
  LightContext context;
  context.to_world = Transform(Matrix4::translate(1, 2, 3));
  const auto light =
      make_light("goniometric", {text("filename", file.path()), rgb("I", {3, 2, 1}), number("scale", 2)}, context);
  const auto point = make_light("point", {rgb("I", {3, 2, 1}), number("scale", 2)}, context);
  Sequence random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = 5 * random.number() * uniform_sphere(random.pair());
    const Rgb a = light->illuminate(p, {})->radiance, b = point->illuminate(p, {})->radiance;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 1e-5f);
    const Vec2 u = random.pair();
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light->emit({}, u)->flux[c] / point->power()[c], 1, 1e-4f);
  }
}

// pbrt turns the map's z into the light's y.
TEST(Goniometric, MiddleOfTheImageIsUp) {
  Image image(64, 64);
  image.at(32, 32) = Rgb(1, 2, 6);  // the mean counts
  image.at(63, 32) = Rgb(5);        // +x
  image.at(32, 63) = Rgb(7);        // +y of the map
  const EnvironmentFile file(image);
  const auto light = make_light("goniometric", {text("filename", file.path())}, {});
  const auto at = [&](float x, float y) {  // the centre of that pixel
    const Vec3 w = direction_at(SphereMapping::equal_area, {(x + .5f) / 64, (y + .5f) / 64});
    return intensity(*light, {w.x, w.z, w.y});
  };
  EXPECT_GT(direction_at(SphereMapping::equal_area, {32.5f / 64, 32.5f / 64}).z, .99f);
  EXPECT_NEAR(at(32, 32), 3, 1e-4f);
  EXPECT_NEAR(at(63, 32), 5, 1e-4f);
  EXPECT_NEAR(at(32, 63), 7, 1e-4f);
  EXPECT_EQ(intensity(*light, {0, -1, 0}), 0);
}

TEST(ShapedPoints, PowerIsInLumen) {
  const EnvironmentFile file(6, 6);
  const IesFile lamp(ies("3 1", "0 45 90  0  100 90 20"));
  for (const auto& [kind, path] : {std::pair<std::string, std::string>{"goniometric", file.path()},
                                   {"projection", file.path()},
                                   {"goniometric", lamp.path()}})
    EXPECT_NEAR(luminance(make_light(kind, {text("filename", path), number("power", 700)}, {})->power()), 700, 0.01f)
        << kind;
}

// The screen of a white image has the solid angle 4 asin(sin a sin b), a and b being half the angles over its axes;
// pbrt-v4 sums cos^3 over the pixels instead.
TEST(Projection, OfAWhiteImageHasItsScreensSolidAngle) {
  for (const auto& [width, height] : {std::pair{3, 3}, {8, 2}, {100, 150}})
    for (const float fov : {5.f, 60.f, 120.f}) {
      const EnvironmentFile file(grey(width, height, 3));
      const auto light = make_light("projection", {text("filename", file.path()), number("fov", fov)}, {});
      const double t = std::tan(static_cast<double>(fov) * M_PI / 360), aspect = static_cast<double>(width) / height,
                   a = std::atan(t * std::max(aspect, 1.)), b = std::atan(t * std::max(1 / aspect, 1.));
      const double expected = 3 * 4 * std::asin(std::sin(a) * std::sin(b));
      EXPECT_NEAR(static_cast<double>(light->power().g) / expected, 1, 1e-5) << width << " " << fov;
      for (const float off : {-1.01f, -.99f, .99f, 1.01f}) {
        const float x = off * static_cast<float>(std::tan(a)), y = off * static_cast<float>(std::tan(b));
        EXPECT_NEAR(intensity(*light, normalize({x, 0, 1})), std::abs(off) < 1 ? 3 : 0, 1e-5f);
        EXPECT_NEAR(intensity(*light, normalize({0, y, 1})), std::abs(off) < 1 ? 3 : 0, 1e-5f);
      }
      EXPECT_EQ(intensity(*light, {0, 0, -1}), 0);
    }
}

// Every photon of a white image carries nearly the same, even if the image has one pixel.
TEST(Projection, PhotonsAreAlike) {
  const EnvironmentFile file(grey(1, 1, 1));
  const auto light = make_light("projection", {text("filename", file.path()), number("fov", 120)}, {});
  Sequence random(2);
  for (int i = 0; i < 10'000; ++i) EXPECT_NEAR(light->emit({}, random.pair())->flux.g / light->power().g, 1, 0.08f);
}

TEST(Projection, IsUprightForAnEyeInItsPlace) {
  Image image = grey(2, 2, 0);
  image.at(0, 0) = Rgb(1), image.at(1, 0) = Rgb(2), image.at(0, 1) = Rgb(3), image.at(1, 1) = Rgb(4);
  const EnvironmentFile file(image);
  const auto light = make_light("projection", {text("filename", file.path())}, {});
  EXPECT_NEAR(intensity(*light, normalize({-.5f, .5f, 1})), 1, 1e-5f);
  EXPECT_NEAR(intensity(*light, normalize({.5f, .5f, 1})), 2, 1e-5f);
  EXPECT_NEAR(intensity(*light, normalize({-.5f, -.5f, 1})), 3, 1e-5f);
  EXPECT_NEAR(intensity(*light, normalize({.5f, -.5f, 1})), 4, 1e-5f);
}

// Between the centres of pixels, and as it ends there beyond the last ones.
TEST(Projection, IsBilinear) {
  Image image = grey(2, 2, 0);
  image.at(0, 0) = Rgb(1), image.at(1, 0) = Rgb(2), image.at(0, 1) = Rgb(3), image.at(1, 1) = Rgb(4);
  const EnvironmentFile file(image);
  const auto light = make_light("projection", {text("filename", file.path())}, {});
  EXPECT_NEAR(intensity(*light, {0, 0, 1}), 2.5f, 1e-5f);
  EXPECT_NEAR(intensity(*light, normalize({-.25f, .5f, 1})), 1.25f, 1e-5f);
  EXPECT_NEAR(intensity(*light, normalize({.5f, .25f, 1})), 2.5f, 1e-5f);
  EXPECT_NEAR(intensity(*light, normalize({-.9f, .9f, 1})), 1, 1e-5f);
}

// Its luminance over its density is the same in all directions but for the solid angle's change within a cell.
TEST(Projection, PhotonsFollowThePicture) {
  const EnvironmentFile file(5, 4);
  const auto light = make_light("projection", {text("filename", file.path())}, {});
  Sequence random(4);
  for (int i = 0; i < 10'000; ++i)
    EXPECT_NEAR(luminance(light->emit({}, random.pair())->flux) / luminance(light->power()), 1, 0.05f);
}

TEST(Ies, UniformLampIsAPoint) {
  const IesFile file(ies("2 1", "0 180\n0\n30 30\n"));  // times 2, times the ballast factor 0.5
  const auto light = make_light("goniometric", {text("filename", file.path())}, {});
  const auto point = make_light("point", {rgb("I", Rgb(30))}, {});
  EXPECT_NEAR(light->power().g / point->power().g, 1, 1e-5f);
  Sequence random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 w = uniform_sphere(random.pair());
    EXPECT_NEAR(intensity(*light, w), 30, 1e-4f);
    EXPECT_NEAR(light->emit({}, random.pair())->flux.g / point->power().g, 1, 1e-3f);
  }
}

// A matte disk has I0 cos, down only: pi I0 lumens.
TEST(Ies, MatteDiskShinesDown) {
  std::string angles, candelas;
  for (int degrees = 0; degrees <= 90; ++degrees) {
    angles += std::to_string(degrees) + (degrees % 7 == 0 ? "\r\n" : " ");
    candelas += std::to_string(100 * std::cos(degrees * M_PI / 180)) + ", ";
  }
  const IesFile file(ies("91 1", angles + "\n0\n" + candelas));
  const auto light = make_light("goniometric", {text("filename", file.path())}, {});
  EXPECT_NEAR(light->power().g, 100 * kPi, 0.05f);
  EXPECT_NEAR(intensity(*light, {0, -1, 0}), 100, 0.01f);
  EXPECT_NEAR(intensity(*light, normalize({1, -1, 0})), 100 / std::sqrt(2.f), 0.3f);
  EXPECT_EQ(intensity(*light, {0, 1, 0}), 0);
}

TEST(Ies, PlanesAreMirroredWhereTheyWereNotMeasured) {
  const auto at = [](const std::string& angles, int count, float around) {
    std::string candelas;
    for (int i = 0; i < count; ++i) candelas += " " + std::to_string(i + 1) + " " + std::to_string(i + 1);
    return parse_ies(ies("2 " + std::to_string(count), "0 180 " + angles + candelas)).intensity(70, around);
  };
  EXPECT_EQ(at("0 90", 2, 45), 1.5f);
  for (const float around : {60.f, 120.f, 240.f, 300.f}) EXPECT_NEAR(at("0 90", 2, around), 1 + 2 / 3.f, 1e-5f);
  EXPECT_NEAR(at("0 90 180", 3, 100), 2 + 1 / 9.f, 1e-5f);
  EXPECT_NEAR(at("0 90 180", 3, 260), 2 + 1 / 9.f, 1e-5f);
  EXPECT_NEAR(at("90 180 270", 3, 100), 1 + 1 / 9.f, 1e-5f);
  EXPECT_NEAR(at("90 180 270", 3, 80), 1 + 1 / 9.f, 1e-5f);
  EXPECT_NEAR(at("90 180 270", 3, 280), 3 - 1 / 9.f, 1e-5f);
  EXPECT_EQ(at("0 180 360", 3, 270), 2.5f);
  EXPECT_EQ(at("0 100 200 300", 4, 330), 2.5f);  // from 4 back to 1
}

// The vertical plane at the horizontal angle 0 is that of +x; 90 is +z, so that with +y up and the left-handed system of
// scenes the angle runs against the clock, seen from above.
TEST(Ies, HorizontalAnglesTurnFromXToZ) {
  const IesFile file(ies("2 4", "0 180 0 90 180 270  1 1 2 2 3 3 4 4"));
  const auto light = make_light("goniometric", {text("filename", file.path())}, {});
  EXPECT_NEAR(intensity(*light, {1, 0, 0}), 1, 0.01f);
  EXPECT_NEAR(intensity(*light, {0, 0, 1}), 2, 0.01f);
  EXPECT_NEAR(intensity(*light, {-1, 0, 0}), 3, 0.01f);
  EXPECT_NEAR(intensity(*light, {0, 0, -1}), 4, 0.01f);
}

TEST(Ies, FactorsForTiltedLampsAreSkipped) {
  const Photometry p = parse_ies(ies("2 1", "0 90 0 7 5", "TILT=INCLUDE\n1\n3\n0 45 90\n1 .9 .8\n"));
  EXPECT_EQ(p.candela, (std::vector<float>{7, 5}));
}

TEST(Ies, DamagedFilesAreErrors) {
  const auto error = [](const std::string& contents) {
    try {
      parse_ies(contents);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("none");
  };
  const std::string good = ies("2 1", "0 90 0 7 5");
  EXPECT_EQ(error(good), "none");
  EXPECT_EQ(error("IESNA:LM-63-2002\n1 2 3"), "it has no line TILT=...");
  EXPECT_EQ(error(good.substr(0, good.size() - 1)), "it ends too early: expected candelas, but found \"\"");
  EXPECT_EQ(error(ies("2 1", "0 90 0 7 x5")), "it is damaged: expected candelas, but found \"x5\"");
  EXPECT_EQ(error(ies("9999 9999", "0 90 0 7 5")), "it ends too early: it says that 9999 vertical angles follow");
  EXPECT_EQ(error(ies("1000000000 1", "0")), "1000000000 vertical angles are not a number from 1 to 10000");
  EXPECT_EQ(error(ies("2 1", "90 0 0 7 5")), "its vertical angles do not ascend");
  EXPECT_EQ(error(ies("2 1", "0 90 0 7 -5")), "its candelas must not be negative");
  EXPECT_EQ(error(ies("2 1", "0 90 0 7 nan")), "it is damaged: expected candelas, but found \"nan\"");
  EXPECT_EQ(error(ies("2 2", "0 90 0 45 7 5 7 5")),
            "its horizontal angles reach from 0 to 45, but must from 0 to 90, 180 or 360, or from 90 to 270");
  std::string type_b = good;
  type_b.replace(type_b.find(" 1 2 0"), 2, " 2");
  EXPECT_EQ(error(type_b), "its photometry is of type A or B, but dspm reads type C");
}

TEST(ShapedPoints, RejectWhatMakesNoSense) {
  const auto errors = [](const std::string& name, std::vector<Param> params) {
    return errors_of(light_plugins(), name, std::move(params), LightContext{});
  };
  const EnvironmentFile odd(5, 3);
  EXPECT_EQ(errors("goniometric", {}), "plugin \"goniometric\" needs a file: \"string filename\"\n");
  EXPECT_NE(errors("goniometric", {text("filename", odd.path())}), "");
  EXPECT_EQ(errors("goniometric", {text("filename", odd.path()), text("mapping", "equirectangular")}), "");
  EXPECT_EQ(errors("projection", {text("filename", odd.path())}), "");
  for (const float fov : {0.f, 180.f, -5.f})
    EXPECT_EQ(errors("projection", {text("filename", odd.path()), number("fov", fov)}),
              "parameter \"fov\" of plugin \"projection\" must be above 0 and below 180\n");
  const IesFile damaged("IESNA91\nTILT=NONE\n1");
  EXPECT_NE(errors("goniometric", {text("filename", damaged.path())}).find("it ends too early"), std::string::npos);
}

TEST(ShapedPoints, AreMultiplesOnlyOfThoseOfTheSameShapeAndPlace) {
  const EnvironmentFile file(4, 4), other(6, 6);
  LightContext moved;
  moved.to_world = Transform(Matrix4::translate(1, 0, 0));
  for (const std::string kind : {"goniometric", "projection"}) {
    const auto make = [&](const EnvironmentFile& image, float scale, const LightContext& context) {
      return make_light(kind, {text("filename", image.path()), number("scale", scale)}, context);
    };
    const auto light = make(file, 1, {});
    EXPECT_EQ(make(file, 3, {})->ratio_to(*light), Rgb(3));
    EXPECT_FALSE(make(other, 1, {})->ratio_to(*light));
    EXPECT_FALSE(make(file, 1, moved)->ratio_to(*light));
  }
}

}  // namespace
}  // namespace dspm
