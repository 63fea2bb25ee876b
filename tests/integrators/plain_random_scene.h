// Random small scenes of all that has a plain form, still and moving, for tests of waves.
#pragma once

#include <fmt/format.h>

#include <random>
#include <string>

#include "tests/integrators/scene_files.h"

namespace dspm::test {

class PlainRandomScene {
 public:
  static constexpr int kFrames = 6;

  explicit PlainRandomScene(unsigned seed) : random_(seed) {}

  /// What a scene may have beside what is drawn.
  struct View {
    std::string camera = "LookAt 0 0.2 -4.2  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40";
    std::string film = {}, walls = {};  // further parameters
    int lights = 2;
    bool varies = false;   // materials may have textures that vary
    bool differs = false;  // materials and lights may differ between frames
  };

  std::string text(const std::string& integrator, bool differs = false) {
    return text(integrator, {.varies = true, .differs = differs});
  }
  std::string text(const std::string& integrator, const View& view) {
    std::string s = fmt::format(
        "Frames {}\nIntegrator {}\n{}\nFilm \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 20 {}\n"
        "WorldBegin\n",
        kFrames, integrator, view.camera, view.film);
    s += "Texture \"tiles\" \"spectrum\" \"checkerboard\" \"float uscale\" 5 \"float vscale\" 4 \"rgb tex1\" [.9 .2 "
         ".4]\n"
         "Texture \"grain\" \"float\" \"wrinkled\" Texture \"gaps\" \"float\" \"checkerboard\" \"float uscale\" 4 "
         "\"float tex2\" .3 Texture \"picture\" \"spectrum\" \"imagemap\" \"float uscale\" 2 "
         "\"string filename\" " +
         files()["picture.png"] +
         "\n"
         "MakeNamedMaterial \"glass\" \"string type\" \"dielectric\" \"rgb attenuationcolor\" [.9 .6 .7] \"integer "
         "priority\" 1 "
         "MakeNamedMaterial \"leaf\" \"string type\" \"diffusetransmission\" \"rgb reflectance\" [.2 .5 .1] "
         "MakeNamedMaterial \"lacquer\" \"string type\" \"coatedconductor\" \"float conductor.roughness\" .02\n";
    const int kinds = view.varies ? kAll : kConstant;
    for (const char* wall : {"-2 -1.2 -2  -2 -1.2 2  2 -1.2 2  2 -1.2 -2", "-2 -1.2 2  -2 2 2  2 2 2  2 -1.2 2",
                             "-2 -1.2 -2  -2 2 -2  -2 2 2  -2 -1.2 2"})
      s += "AttributeBegin\n" + material(whole(0, 3) > 1 ? 0 : whole(0, kinds - 1)) +
           fmt::format("Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [{}] {}\nAttributeEnd\n",
                       wall, view.walls);
    for (int i = 0; i < view.lights; ++i) s += light(whole(0, 5));
    for (int i = 0; i < 3; ++i)
      s += "AttributeBegin\n" + place() + "\n" + material(whole(0, kinds - 1)) + shape(false) + "AttributeEnd\n";
    if (view.differs) s += looks();
    s += bodies();
    for (int i = 0; i < 2; ++i)
      s += fmt::format("DynamicBegin \"thing{}\" {}\nKeyframe 1 {} Keyframe {} {} KeyframeEnd\n{}DynamicEnd\n", i,
                       material(whole(0, kinds - 1)), place(), whole(2, kFrames), place(), shape(true));
    return s;
  }

 private:
  float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  std::string place() {
    return fmt::format("Translate {} {} {} Rotate {} {} 1 {} Scale {} {} {}", real(-1, 1), real(-1, 1), real(-1, 1),
                       real(0, 360), real(-1, 1), real(-1, 1), real(0.5f, 1), real(0.5f, 1),
                       whole(0, 4) == 0 ? -1.f : real(0.5f, 1));
  }
  static constexpr int kConstant = 11, kAll = 17;  // kinds of materials: without textures that vary, and all
  std::string material(int kind) {
    switch (kind) {
      case 0:
        return fmt::format("Material \"diffuse\" \"rgb reflectance\" [{} {} {}]\n", real(0, 1), real(0, 1), real(0, 1));
      case 1: return fmt::format("Material \"dielectric\" \"float eta\" {} {}\n", real(1.1f, 1.8f), body());
      case 2:
        return fmt::format(
            "Material \"dielectric\" \"float eta\" 1.5 \"float uroughness\" {} \"float vroughness\" {} {}\n",
            real(0.01f, 0.5f), real(0.01f, 0.5f), body());
      case 3:
        return fmt::format("Material \"conductor\" \"float roughness\" {}\n",
                           whole(0, 1) == 0 ? 0.f : real(0.01f, 0.4f));
      case 4: return "Material \"conductor\" \"rgb reflectance\" [.9 .7 .4] \"float uroughness\" .3\n";
      case 5: return "Material \"thindielectric\" \"rgb tint\" [.9 .6 .8]\n";
      case 6: return "Material \"coateddiffuse\" " + coat("") + "\n";
      case 7:
        return fmt::format("Material \"coatedconductor\" {} \"float conductor.roughness\" {}\n", coat("interface."),
                           whole(0, 1) == 0 ? 0.f : real(0.01f, 0.4f));
      case 8:
        return fmt::format("Material \"diffusetransmission\" \"rgb transmittance\" [{} {} {}]\n", real(0, 1),
                           real(0, 1), real(0, 1));
      case 9: return mix(fmt::format("\"float amount\" {}", real(0, 1)));
      case 10:
        return fmt::format("Material \"dielectric\" {} \"float roughness\" {} {}\n",
                           whole(0, 1) == 0 ? "\"string glass\" \"SF11\"" : "\"float eta\" 1.5 \"float abbe\" 20",
                           whole(0, 2) == 0 ? 0.2f : 0.f, body());
      case 11: return "Material \"conductor\" \"texture reflectance\" \"picture\" \"texture roughness\" \"grain\"\n";
      case 12: return "Material \"diffuse\" \"texture reflectance\" \"tiles\"\n";
      case 13:
        return "Material \"coateddiffuse\" \"texture reflectance\" \"picture\" \"texture roughness\" \"grain\"\n";
      case 14: return "Material \"diffusetransmission\" \"texture reflectance\" \"tiles\" \"float scale\" .5\n";
      case 15: return mix("\"texture amount\" \"grain\"");
      default: return "Material \"diffuse\" \"texture reflectance\" \"picture\"\n";
    }
  }
  std::string coat(const char* prefix) {
    const std::string alpha =
        whole(0, 2) == 0 ? fmt::format("\"float {}uroughness\" {}", prefix, real(0.01f, 0.5f))
                         : fmt::format("\"float {}roughness\" {}", prefix, static_cast<float>(whole(0, 2)) * 0.04f);
    return alpha + (whole(0, 2) == 0 ? " \"bool energycompensation\" false" : "");
  }
  std::string mix(const std::string& amount) {
    static constexpr const char* kParts[] = {"glass", "leaf", "lacquer"};
    const int first = whole(0, 2);
    return fmt::format("Material \"mix\" \"string materials\" [\"{}\" \"{}\"] {}\n", kParts[first],
                       kParts[(first + 1) % 3], amount);
  }
  /// Shapes and a light that differ between frames in their looks.
  std::string looks() {
    std::string s = fmt::format("LightSource \"point\" \"rgb I@1\" [2 2 2] \"rgb I@{}\" [4 1 3]\n", whole(2, kFrames));
    for (int i = 0; i < 2; ++i)
      s += fmt::format(
          "AttributeBegin {} Material \"{}\" \"rgb reflectance@1\" [.9 {} .4] \"rgb reflectance@{}\" [.2 .8 .9]\n{}"
          "AttributeEnd\n",
          place(), whole(0, 1) == 0 ? "diffuse" : "conductor", real(0, 1), whole(2, kFrames), shape(false));
    return s + fmt::format(
                   "AttributeBegin {} Material \"conductor\" \"float roughness@1\" 0 \"float roughness@2\" .3 \"float "
                   "roughness@{}\" .1\n{}AttributeEnd\n",
                   place(), whole(3, kFrames), shape(false));
  }
  /// What glass absorbs, and its priority, if it has any.
  std::string body() {
    std::string s;
    if (whole(0, 2) > 0)
      s += fmt::format("\"rgb attenuationcolor\" [{} {} {}] ", real(0.1f, 1), real(0.1f, 1), real(0.1f, 1));
    if (whole(0, 1) > 0) s += fmt::format("\"integer priority\" {} ", whole(-1, 2));
    return s;
  }
  /// A body, perhaps with another in it, or one around everything.
  std::string bodies() {
    static constexpr int kGlass[] = {1, 2, 10};
    const auto glass = [&] { return material(kGlass[whole(0, 2)]); };
    if (whole(0, 5) == 0) return "AttributeBegin " + glass() + "Shape \"sphere\" \"float radius\" 7 AttributeEnd\n";
    std::string s = "AttributeBegin " + place() + "\n" + glass() + "Shape \"sphere\" \"float radius\" .7\n";
    if (whole(0, 2) > 0) s += glass() + "Translate .2 .1 0 Shape \"sphere\" \"float radius\" .6\n";
    return s + "AttributeEnd\n";
  }
  std::string shape(bool may_change) {
    const std::string solid = solid_shape();
    return solid + holes(may_change) + "\n";
  }
  /// Most shapes have none.
  std::string holes(bool may_change) {
    switch (whole(may_change ? 0 : 1, 9)) {
      case 0: return fmt::format("\"float alpha@1\" {} \"float alpha@4\" {}", real(0, 1), real(0, 1.3f));
      case 1: return fmt::format("\"float alpha\" {}", real(0, 1));
      case 2: return "\"texture alpha\" \"gaps\"";
      case 3: return "\"texture alpha\" \"grain\"";
      default: return {};
    }
  }
  std::string solid_shape() {
    switch (whole(0, 8)) {
      case 0: return "Shape \"sphere\" \"float radius\" .5 \"float zmax\" .4 ";
      case 1: return "Shape \"sphere\" \"float radius\" .5 ";
      case 2: return "Shape \"disk\" \"float radius\" .6 \"float innerradius\" .1 ";
      case 3: return "Shape \"cylinder\" \"float radius\" .4 \"float phimax\" 250 ";
      case 4:
        return "ReverseOrientation Shape \"loopsubdiv\" \"integer levels\" 2 \"integer indices\" [0 1 2 0 2 3 0 3 1 1 "
               "3 2] "
               "\"point3 P\" [0 .7 0  -.6 -.4 -.4  .6 -.4 -.4  0 -.4 .6] ";
      case 5: return "Shape \"bilinearmesh\" \"point3 P\" [-.5 -.5 0  .5 -.5 .2  -.5 .5 .4  .5 .5 0] ";
      case 6:
        return "Shape \"bilinearmesh\" \"integer indices\" [0 1 2 3 2 3 4 5] \"point2 uv\" [0 0 1 0 0 1 1 1 .2 2 .8 2] "
               "\"normal3 N\" [0 .3 1  .2 0 1  0 -.2 1  -.1 0 1  0 0 1  .1 .1 1] "
               "\"point3 P\" [-.5 -.5 0  .5 -.5 .2  -.4 0 .4  .5 0 0  -.5 .5 0  .3 .5 .3] ";
      case 7: return "Shape \"plymesh\" \"string filename\" " + files()["signed.ply"] + " ";
      default:
        return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point2 uv\" [0 0 1 0 1 1 0 1] "
               "\"normal3 N\" [0 .3 1  .2 0 1  0 -.2 1  -.1 0 1] \"point3 P\" [-.5 -.5 0  .5 -.5 0  .5 .5 .1  -.5 .5 "
               "0] ";
    }
  }
  std::string light(int kind) {
    switch (kind) {
      case 5:
        return "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [6 7 8] " + place() + " " + material(whole(1, 2)) +
               "Shape \"sphere\" \"float radius\" .3 AttributeEnd\n";
      case 0:
        return "AttributeBegin Translate 0 1.6 0 Rotate 90 1 0 0 AreaLightSource \"diffuse\" \"rgb L\" [9 8 7] \"bool "
               "twosided\" true Shape \"disk\" \"float radius\" .5 " +
               holes(false) + " AttributeEnd\n";
      case 1: return "LightSource \"point\" \"rgb I\" [6 5 4] \"point3 from\" [.4 1.2 -1]\n";
      case 2: return "LightSource \"spot\" \"rgb I\" [20 20 20] \"point3 from\" [.5 1.4 -1] \"point3 to\" [0 -1 0]\n";
      case 3: return "LightSource \"distant\" \"rgb L\" [2 2 2] \"point3 from\" [1 2 -1] \"point3 to\" [0 0 0]\n";
      default: return "LightSource \"infinite\" \"rgb L\" [.3 .4 .5]\n";
    }
  }

  static const SceneFiles& files() {
    static const SceneFiles all;
    return all;
  }

  std::mt19937 random_;
};

}  // namespace dspm::test
