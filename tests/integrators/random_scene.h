// Random small scenes with every plugin, still and moving, for differential tests of integrators.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <string>

namespace dspm::testing {

class RandomScene {
 public:
  RandomScene(unsigned seed, int frames) : random_(seed), frames_(frames) {}

  std::string text(const std::string& integrator) {
    std::string s = fmt::format("Frames {}\n{}\n", frames_, integrator);
    s += "LookAt 0 0.2 -4.2  0 0 0  0 1 0\n" + camera() +
         "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 20\n";
    s += "WorldBegin\nTexture \"checks\" \"spectrum\" \"checkerboard\" \"float uscale\" 3 \"float vscale\" 3 "
         "\"rgb tex1\" [.8 .3 .2] \"rgb tex2\" [.2 .4 .7]\n";
    s += room() + light();
    for (int i = 0; i < 2; ++i) s += "AttributeBegin\n" + place() + material(false) + shape("") + "AttributeEnd\n";
    for (int i = 0; i < 3; ++i) s += dynamic(i);
    return s;
  }

 private:
  float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  std::string camera() {
    const std::string lens = whole(0, 1) ? " \"float lensradius\" 0.05 \"float focaldistance\" 4" : "";
    if (whole(0, 4) == 0)
      return fmt::format("Camera \"perspective\" \"float fov@1\" 38 \"float fov@{}\" 44{}\n", std::max(2, frames_),
                         lens);
    return fmt::format("Camera \"perspective\" \"float fov\" 40{}\n", lens);
  }

  std::string room() {
    return "Material \"diffuse\" \"rgb reflectance\" [.7 .7 .7]\n"
           "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-1.5 -1.2 -1.5 -1.5 -1.2 1.5 1.5 "
           "-1.2 1.5 1.5 -1.2 -1.5]\n"
           "Material \"diffuse\" \"texture reflectance\" \"checks\"\n"
           "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point2 uv\" [0 0 1 0 1 1 0 1] "
           "\"point3 P\" [-1.5 -1.2 1.5 -1.5 1.5 1.5 1.5 1.5 1.5 1.5 -1.2 1.5]\n"
           "Material \"conductor\" \"float roughness\" 0.4\n"
           "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-1.5 -1.2 -1.5 -1.5 1.5 -1.5 -1.5 "
           "1.5 1.5 -1.5 -1.2 1.5]\n";
  }

  std::string light() {
    const std::string keyed = fmt::format("\"float scale@1\" 1 \"float scale@{}\" 3", std::max(2, frames_));
    switch (whole(0, 5)) {
      case 0: return "LightSource \"point\" \"rgb I\" [6 5 4] \"point3 from\" [0.4 1.2 -1]\n";
      case 1:
        return "LightSource \"spot\" \"rgb I\" [20 20 20] \"point3 from\" [0.5 1.4 -1] \"point3 to\" [0 -1 0] " +
               keyed + "\n";
      case 2: return "LightSource \"distant\" \"rgb L\" [2 2 2] \"point3 from\" [1 2 -1] \"point3 to\" [0 0 0]\n";
      case 3: return "LightSource \"infinite\" \"rgb L\" [.5 .6 .8]\n";
      case 4:
        return fmt::format(
            "DynamicBegin \"lamp\" Keyframe 1 Translate -0.5 1.3 0 Keyframe {} Translate 0.6 1.3 0 KeyframeEnd "
            "AreaLightSource \"diffuse\" \"rgb L\" [20 18 15] Rotate 90 1 0 0 Shape \"disk\" \"float radius\" 0.3 "
            "DynamicEnd\n",
            std::max(2, frames_));
      default:
        return "AttributeBegin Translate 0 1.45 0 Rotate 90 1 0 0 AreaLightSource \"diffuse\" \"rgb L\" [15 14 12]\n"
               "Shape \"disk\" \"float radius\" 0.5 AttributeEnd\n";
    }
  }

  std::string place() { return fmt::format("Translate {} {} {}\n", real(-1, 1), real(-0.9f, 0.6f), real(-0.8f, 0.9f)); }

  std::string material(bool keyed) {
    switch (whole(0, keyed ? 7 : 6)) {
      case 0: return "Material \"diffuse\" \"rgb reflectance\" [.6 .2 .3]\n";
      case 1: return "Material \"conductor\"\n";
      case 2: return fmt::format("Material \"conductor\" \"float roughness\" {}\n", real(0.01f, 0.5f));
      case 3: return "Material \"dielectric\"\n";
      case 4: return fmt::format("Material \"dielectric\" \"float roughness\" {}\n", real(0.02f, 0.4f));
      case 5: return "Material \"thindielectric\"\n";
      case 6:
        return fmt::format("Material \"coateddiffuse\" \"float roughness\" {}\n",
                           whole(0, 1) ? 0.f : real(0.05f, 0.4f));
      default:
        return fmt::format("Material \"diffuse\" \"rgb reflectance@1\" [.8 .1 .1] \"rgb reflectance@{}\" [.1 .2 .9]\n",
                           std::max(2, frames_));
    }
  }

  std::string shape(const std::string& key) {
    switch (whole(0, 4)) {
      case 0: return fmt::format("Shape \"cylinder\" \"float radius\" 0.3 \"float zmin\" -0.3 \"float zmax\" 0.4\n");
      case 1: return "Rotate 40 1 1 0 Shape \"disk\" \"float radius\" 0.5\n";
      case 2:
        return "Shape \"loopsubdiv\" \"integer levels\" 2 \"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 "
               "5 0 3 5] "
               "\"point3 P\" [.6 0 0 -.6 0 0 0 .6 0 0 -.6 0 0 0 .6 0 0 -.6]\n";
      default: return fmt::format("Shape \"sphere\" {}\n", key.empty() ? "\"float radius\" 0.4" : key);
    }
  }

  std::string dynamic(int i) {
    std::string s = fmt::format("DynamicBegin \"d{}\"", i);
    if (frames_ > 2 && whole(0, 3) == 0) s += fmt::format(" \"integer frames\" [2 {}]", whole(2, frames_));
    s += "\n";
    const std::string from = place(), to = place();
    if (frames_ > 1 && whole(0, 3) > 0)
      s += fmt::format("Keyframe 1 {} Keyframe {} {} Rotate {} 0 1 1 KeyframeEnd\n", from, whole(2, frames_), to,
                       whole(0, 180));
    else
      s += from;
    s += material(true);
    const std::string key = fmt::format("\"float radius@1\" 0.3 \"float radius@{}\" 0.5", std::max(2, frames_));
    return s + shape(frames_ > 1 && whole(0, 1) ? key : "") + "DynamicEnd\n";
  }

  std::mt19937 random_;
  int frames_;
};

}  // namespace dspm::testing
