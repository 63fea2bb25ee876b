// Shapes of the material "interface": scenes with them are those without them, to the bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dspm/base/math/moments.h"
#include "dspm/testing/scenes.h"
#include "dspm/testing/test_scene.h"
#include "dspm/world/world.h"

namespace dspm::test {
namespace interface_test {

std::string options(const char* integrator, int frames = 1) {
  return fmt::format("Frames {}\nIntegrator {}\n", frames, integrator);
}
constexpr const char* kBall = "Material \"dielectric\" Translate 0 -.4 0 Shape \"sphere\" \"float radius\" 0.4\n";

/// A shell around the ball, between it and light and camera.
std::string with_shell(const char* material) {
  return fmt::format(
             "AttributeBegin Material {} Translate 0 -.4 0 Shape \"sphere\" \"float radius\" 0.55 AttributeEnd\n",
             material) +
         kBall;
}

TEST(Interface, IsNotThere) {
  for (const char* integrator :
       {R"("path")", R"("dsppm" "integer photons" 2000)", R"("sppm" "integer photons" 2000)",
        R"("vcm" "integer photons" 1000)", R"("photonmap" "integer photons" 2000 "integer causticphotons" 2000)"})
    for (const char* material : {R"("interface")", R"("none")", R"("")"})
      EXPECT_EQ(TestScene(box(options(integrator), with_shell(material), 16)).render(FileFrame(0), 2),
                TestScene(box(options(integrator), kBall, 16)).render(FileFrame(0), 2))
          << integrator << material;
}

TEST(Interface, EmitsNothing) {
  const std::string light = "AreaLightSource \"diffuse\" \"rgb L\" [9 9 9]\n";
  const std::string lamp = "AttributeBegin " + light + "Material \"interface\" Shape \"sphere\" AttributeEnd\n";
  const auto render = [](const std::string& contents) {
    return TestScene(box(options("\"path\""), contents, 16)).render(FileFrame(0), 2);
  };
  EXPECT_EQ(render(lamp + kBall), render(kBall));
}

// A named material that is an interface in some variations takes its shapes away in those.
TEST(Interface, MayBeOneOfSeveralLooks) {
  const std::string contents = std::string(R"(MakeNamedMaterial "shell" "string type" "diffuse"
    AttributeBegin NamedMaterial "shell" Translate 0 -.4 0 Shape "sphere" "float radius" 0.55 AttributeEnd
    )") + kBall;
  TestScene both(box(options("\"path\""),
                     contents + R"(VariationBegin "here" MakeNamedMaterial "shell" "string type" "diffuse" VariationEnd
    VariationBegin "away" MakeNamedMaterial "shell" "string type" "interface" VariationEnd)",
                     16));
  const std::vector<Image> images = both.render_all(2);
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[0], TestScene(box(options("\"path\""), contents, 16)).render(FileFrame(0), 2));
  EXPECT_EQ(images[1], TestScene(box(options("\"path\""), kBall, 16)).render(FileFrame(0), 2));
}

TEST(Interface, DoesNotWidenTheScene) {
  const auto radius = [](const std::string& more) {
    return TestScene("WorldBegin\nLightSource \"infinite\"\nShape \"sphere\"\n" + more).scene({FileFrame(0)})->radius;
  };
  EXPECT_EQ(radius("Material \"interface\" Shape \"sphere\" \"float radius\" 100\n"), radius(""));
}

}  // namespace interface_test
}  // namespace dspm::test
