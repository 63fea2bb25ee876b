// Random small scenes of every plugin, still and moving, for differential tests of integrators.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <string>

#include "dspm/base/math/frames.h"
#include "tests/integrators/scene_files.h"

namespace dspm::test {

class RandomScene {
 public:
  RandomScene(unsigned seed, int frames) : random_(seed), frames_(frames) {}

  std::string text(const std::string& integrator) {
    std::string s = fmt::format("Frames {}\n{}\n", frames_, integrator) + camera() +
                    "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 20\n" + filter() + "WorldBegin\n" +
                    textures() + room() + light() + table();
    for (int i = 0; i < 2; ++i) s += "AttributeBegin\n" + place() + material() + still_shape() + "AttributeEnd\n";
    for (int i = 0; i < 3; ++i) s += dynamic(i);
    s += product();
    return s + curves();
  }

 private:
  float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  int last() const { return std::max(2, frames_); }
  /// A parameter with that value in the first frame, and the other in the last.
  std::string keyed(const std::string& name, const std::string& first, const std::string& other) const {
    return fmt::format(" \"{0}@1\" {1} \"{0}@{3}\" {2} ", name, first, other, last());
  }

  std::string camera() {
    const std::string lens = whole(0, 1) ? " \"float lensradius\" 0.05 \"float focaldistance\" 4" : "";
    const std::string look = "LookAt 0 0.2 -4.2  0 0 0  0 1 0\n";
    switch (whole(0, 8)) {
      case 0: return look + "Camera \"perspective\"" + keyed("float fov", "38", "44") + lens + "\n";
      case 1: return look + "Camera \"orthographic\" \"float screenwindow\" [-1.6 1.6 -1.3 1.3]" + lens + "\n";
      case 2:
        return fmt::format("Keyframe 1 LookAt 0 0.2 -4.2 0 0 0 0 1 0 Keyframe {} LookAt 0.5 0.4 -4 0 0 0 0 1 0 ",
                           last()) +
               "KeyframeEnd Camera \"perspective\" \"float fov\" 40" + lens + "\n";
      default: return look + "Camera \"perspective\" \"float fov\" 40" + lens + "\n";
    }
  }

  std::string filter() {
    switch (whole(0, 3)) {
      case 0: return "PixelFilter \"box\"\n";
      case 1: return "PixelFilter \"triangle\" \"float xradius\" 1.5\n";
      case 2: return "PixelFilter \"gaussian\"\n";
      default: return "";
    }
  }

  std::string textures() {
    return "Texture \"paint\" \"spectrum\" \"constant\"" + keyed("rgb value", "[.8 .2 .1]", "[.1 .3 .8]") + "\n" +
           "Texture \"picture\" \"spectrum\" \"imagemap\" \"string filename\" " + files()["picture.png"] + "\n" +
           "Texture \"pages\" \"spectrum\" \"imagemap\" \"string filename\" " + files()["page.%02d.png"] + "\n" +
           "Texture \"faded\" \"spectrum\" \"scale\" \"texture tex\" \"picture\" \"float scale\" .7\n"
           "Texture \"spots\" \"float\" \"checkerboard\" \"float uscale\" 4 \"float vscale\" 4\n"
           "Texture \"worn\" \"spectrum\" \"mix\" \"texture tex1\" \"paint\" \"texture tex2\" \"faded\" "
           "\"texture amount\" \"spots\"\n"
           "Texture \"grain\" \"float\" \"checkerboard\" \"float tex1\" .02 \"float tex2\" .3\n"
           "Texture \"checks\" \"spectrum\" \"checkerboard\" \"float uscale\" 3 \"float vscale\" 3 "
           "\"rgb tex1\" [.8 .3 .2] \"rgb tex2\" [.2 .4 .7]\n"
           "Texture \"swell\" \"float\" \"imagemap\" \"float scale\" .1 \"string filename\" " +
           files()["picture.png"] + "\n" +
           "MakeNamedMaterial \"dented\" \"string type\" \"mix\" \"string materials\" [\"rusty\" \"steel\"] "
           "\"texture amount\" \"spots\"\n"
           "MakeNamedMaterial \"rusty\" \"string type\" \"diffuse\"" +
           keyed("rgb reflectance", "[.5 .2 .1]", "[.6 .4 .1]") +
           "\nMakeNamedMaterial \"steel\" \"string type\" \"conductor\" \"float roughness\" .1 \"string normalmap\" " +
           files()["normals.png"] + "\n" + computed_textures();
  }

  std::string computed_textures() {
    return "Texture \"column\" \"spectrum\" \"marble\" \"float scale\" 5" + keyed("float variation", ".2", "2") +
           "\nTexture \"stains\" \"float\" \"fbm\"\nTexture \"peel\" \"float\" \"wrinkled\" \"integer octaves\" 3\n"
           "Texture \"waves\" \"float\" \"windy\"\n"
           "Texture \"rust\" \"spectrum\" \"mix\" \"texture amount\" \"stains\" \"rgb tex1\" [.5 .2 .1]\n"
           "Texture \"orange\" \"spectrum\" \"scale\" \"rgb tex\" [.9 .5 .1] \"texture scale\" \"peel\"\n"
           "Texture \"lake\" \"spectrum\" \"mix\" \"texture amount\" \"waves\" \"rgb tex1\" [.2 .3 .7]\n"
           "Texture \"dots\" \"spectrum\" \"dots\" \"string mapping\" \"spherical\" \"texture outside\" \"paint\"\n"
           "Texture \"dawn\" \"spectrum\" \"bilerp\" " +
           keyed("rgb v11", "[1 .6 .3]", "[.2 .6 .9]") +
           "\nTexture \"slopes\" \"spectrum\" \"directionmix\" \"texture tex1\" \"dawn\" \"rgb tex2\" [.3 .2 .1]\n";
  }

  std::string any_texture() {
    const char* names[] = {"paint", "picture", "pages", "faded", "worn", "checks", "column",
                           "rust",  "orange",  "lake",  "dots",  "dawn", "slopes"};
    return names[whole(0, 12)];
  }

  std::string room() {
    return "Material \"diffuse\" \"rgb reflectance\" [.7 .7 .7]\n"
           "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-1.5 -1.2 -1.5 -1.5 -1.2 1.5 1.5 "
           "-1.2 1.5 1.5 -1.2 -1.5]\n"
           "Material \"diffuse\" \"texture reflectance\" \"" +
           (whole(0, 1) ? "checks" : any_texture()) +
           "\"\n"
           "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point2 uv\" [0 0 1 0 1 1 0 1] "
           "\"point3 P\" [-1.5 -1.2 1.5 -1.5 1.5 1.5 1.5 1.5 1.5 1.5 -1.2 1.5]\n"
           "Material \"conductor\" \"float roughness\" 0.4\n"
           "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-1.5 -1.2 -1.5 -1.5 1.5 -1.5 -1.5 "
           "1.5 1.5 -1.5 -1.2 1.5]\n";
  }

  std::string light() {
    switch (whole(0, 10)) {
      case 10:
        return fmt::format(
                   "DynamicBegin \"bulb\" Keyframe 1 Translate -0.5 1 -1 Keyframe {} Translate 0.6 1.1 -1 KeyframeEnd ",
                   last()) +
               "LightSource \"point\" \"rgb I\" [6 6 6]" + keyed("float scale", "1", "0.5") + " DynamicEnd\n";
      case 8:
        return "LightSource \"point\"" + keyed("rgb I", "[6 5 4]", "[1 3 5]") + " \"point3 from\" [0.4 1.2 -1]\n" +
               "LightSource \"infinite\" \"rgb L\" [.2 .3 .4]" + keyed("float scale", "1", "0.2") + "\n";
      case 9:
        return "AttributeBegin Translate 0 1.45 0 Rotate 90 1 0 0 AreaLightSource \"diffuse\" \"rgb L\" [15 14 12]" +
               keyed("float scale", "1", "0") + "Shape \"disk\" \"float radius\" 0.5 AttributeEnd\n" +
               "LightSource \"spot\" \"rgb I\" [9 9 9] \"point3 from\" [0.5 1.4 -1] \"point3 to\" [0 -1 0] " +
               keyed("float coneangle", "30", "50") + "\n";
      case 0: return "LightSource \"point\" \"rgb I\" [6 5 4] \"point3 from\" [0.4 1.2 -1]\n";
      case 1:
        return "LightSource \"spot\" \"rgb I\" [20 20 20] \"point3 from\" [0.5 1.4 -1] \"point3 to\" [0 -1 0] " +
               keyed("float scale", "1", "3") + "\n";
      case 2: return "LightSource \"distant\" \"rgb L\" [2 2 2] \"point3 from\" [1 2 -1] \"point3 to\" [0 0 0]\n";
      case 3: return "LightSource \"infinite\" \"rgb L\" [.5 .6 .8]\n";
      case 4: return "LightSource \"infinite\" \"string filename\" " + files()["square.exr"] + "\n";
      case 5: return "LightSource \"infinite\" \"string filename\" " + files()["sky.exr"] + "\n";
      case 6:
        return fmt::format(
            "DynamicBegin \"lamp\" Keyframe 1 Translate -0.5 1.3 0 Keyframe {} Translate 0.6 1.3 0 KeyframeEnd "
            "AreaLightSource \"diffuse\" \"rgb L\" [20 18 15] Rotate 90 1 0 0 Shape \"disk\" \"float radius\" 0.3 "
            "DynamicEnd\n",
            last());
      default:
        return "AttributeBegin Translate 0 1.45 0 Rotate 90 1 0 0 AreaLightSource \"diffuse\" \"rgb L\" [15 14 12]\n"
               "\"bool twosided\" true Shape \"disk\" \"float radius\" 0.5 AttributeEnd\n";
    }
  }

  /// An object that is placed twice.
  std::string table() {
    if (whole(0, 2) > 0) return "";
    return "ObjectBegin \"table\" Material \"coateddiffuse\" Shape \"disk\" \"float radius\" 0.2 "
           "Shape \"cylinder\" \"float radius\" 0.05 \"float zmin\" -0.3 \"float zmax\" 0 ObjectEnd\n"
           "AttributeBegin Translate -0.9 -0.9 0 Rotate -90 1 0 0 ObjectInstance \"table\" AttributeEnd\n"
           "AttributeBegin Translate 0.8 -0.9 0.3 Rotate -90 1 0 0 ObjectInstance \"table\" AttributeEnd\n";
  }

  std::string place() { return fmt::format("Translate {} {} {}\n", real(-1, 1), real(-0.9f, 0.6f), real(-0.8f, 0.9f)); }

  std::string material() {
    const auto rough = [&](float low, float high) {
      return whole(0, 3) == 0 ? std::string(" \"texture roughness\" \"grain\"")
                              : fmt::format(" \"float roughness\" {}", real(low, high));
    };
    switch (whole(0, 21)) {
      case 16:
        return "Material \"mix\" \"string materials\" [\"rusty\" \"steel\"]" + keyed("float amount", ".2", ".9") + "\n";
      case 17: return "Material \"mix\" \"string materials\" [\"steel\" \"dented\"] \"texture amount\" \"grain\"\n";
      case 18:
        return "Material \"diffuse\"" + keyed("rgb reflectance", "[.8 .1 .1]", "[.1 .2 .9]") + "\"string normalmap\" " +
               files()["normals.png"] + "\n";
      case 19:
        return std::string("Material ") + (whole(0, 1) ? "\"coateddiffuse\"" : "\"dielectric\"") +
               " \"texture displacement\" \"swell\"" + rough(0, 0.3f) + "\n";
      case 20:
        return "Material \"subsurface\" \"rgb mfp\" [.2 .1 .1]" + keyed("rgb reflectance", "[.9 .5 .4]", "[.4 .6 .8]") +
               "\n";
      case 21: return whole(0, 1) ? "Material \"interface\"\n" : "Material \"subsurface\" \"float roughness\" .1\n";
      case 11:
        return "Material \"coateddiffuse\"" +
               keyed("rgb reflectance", "[.8 .1 .1]", whole(0, 1) ? "[0 0 0]" : "[.1 .2 .9]") + "\n";
      case 12:
        return "Material \"coateddiffuse\" \"texture reflectance\" \"" + any_texture() + "\"" +
               keyed("float roughness", "0.05", "0.4") + "\n";
      case 13:
        return "Material \"conductor\"" + keyed("rgb reflectance", "[.9 .6 .2]", "[.6 .7 .9]") + rough(0.1f, 0.3f) +
               "\n";
      case 14: return "Material \"conductor\"" + keyed("float roughness", "0.3", "0.02") + "\n";
      case 15: return "Material \"dielectric\" \"float abbe\" 15" + keyed("float roughness", "0", "0.3") + "\n";
      case 0: return "Material \"diffuse\" \"rgb reflectance\" [.6 .2 .3]\n";
      case 1: return "Material \"conductor\"\n";
      case 2: return "Material \"conductor\"" + rough(0.01f, 0.5f) + "\n";
      case 3: return "Material \"dielectric\" \"string glass\" \"SF11\"\n";
      case 4: return "Material \"dielectric\"" + rough(0.02f, 0.4f) + "\n";
      case 5: return "Material \"thindielectric\"\n";
      case 6: return "Material \"coateddiffuse\"\n";
      case 7: return "Material \"coateddiffuse\"" + rough(0.05f, 0.4f) + "\n";
      case 8: return "Material \"dielectric\"" + keyed("float eta", "1.3", "1.6") + "\n";
      case 9: return "Material \"diffuse\" \"texture reflectance\" \"" + any_texture() + "\"\n";
      default: return "Material \"diffuse\"" + keyed("rgb reflectance", "[.8 .1 .1]", "[.1 .2 .9]") + "\n";
    }
  }

  /// Some of them with holes.
  std::string still_shape() {
    std::string s = whole_shape();
    if (whole(0, 3) == 0) s.insert(s.size() - 1, whole(0, 1) ? " \"texture alpha\" \"spots\"" : " \"float alpha\" 0.6");
    return s;
  }

  std::string whole_shape() {
    switch (whole(0, 7)) {
      case 7:
        return "Shape \"bilinearmesh\" \"integer indices\" [0 1 2 3 2 3 4 5] \"point3 P\" [-.4 -.3 0 .4 -.3 .1 -.4 .1 "
               ".2 .3 .2 -.1 -.3 .5 0 .4 .4 .3]\n";
      case 0: return "Shape \"cylinder\" \"float radius\" 0.3 \"float zmin\" -0.3 \"float zmax\" 0.4\n";
      case 1: return "Rotate 40 1 1 0 Shape \"disk\" \"float radius\" 0.5\n";
      case 2:
        return "Shape \"loopsubdiv\" \"integer levels\" 2 \"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 "
               "5 0 3 5] "
               "\"point3 P\" [.6 0 0 -.6 0 0 0 .6 0 0 -.6 0 0 0 .6 0 0 -.6]\n";
      case 3: return "Shape \"plymesh\" \"string filename\" " + files()["blob.001.ply"] + "\n";
      case 4: return "Shape \"objmesh\" \"string filename\" " + files()["box.obj"] + "\n";
      case 5: return "Shape \"sphere\" \"float radius\" 0.4 \"float zmin\" -0.2 \"float phimax\" 250\n";
      default: return "Shape \"sphere\" \"float radius\" 0.4\n";
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
    s += material();
    switch (frames_ > 1 ? whole(0, 3) : 3) {
      case 0: return s + "Shape \"sphere\"" + keyed("float radius", "0.3", "0.5") + "DynamicEnd\n";
      case 1: return s + "Shape \"plymesh\" \"string filename\" " + files()["blob.%03d.ply"] + " DynamicEnd\n";
      default: return s + still_shape() + "DynamicEnd\n";
    }
  }

  /// A ball in finishes of any kind, under a lamp that some of them dim.
  std::string product() {
    const int finishes = whole(2, 4);
    if (frames_ * finishes > kMaxFrames || whole(0, 2) > 0) return "";
    std::string s = "MakeNamedMaterial \"finish\" \"string type\" \"diffuse\"\nAttributeBegin " + place() +
                    "NamedMaterial \"finish\" Shape \"sphere\" \"float radius\" 0.5 AttributeEnd\n"
                    "LightSource \"point\" \"string name\" \"lamp\" \"rgb I\" [2 3 2] \"point3 from\" [-1 1.2 -1]\n";
    for (int i = 0; i < finishes; ++i) {
      std::string made = material();
      made.replace(0, std::string("Material ").size(), "MakeNamedMaterial \"finish\" \"string type\" ");
      s += fmt::format("VariationBegin \"f{}\" {}", i, made);
      if (whole(0, 1)) s += fmt::format("Light \"lamp\" \"float scale\" {}\n", real(0, 2));
      s += "VariationEnd\n";
    }
    return s;
  }

  /// Curves of any type, still or turning.
  std::string curves() {
    if (whole(0, 2) > 0) return "";
    const char* types[] = {"flat\"", "cylinder\"", "ribbon\" \"normal N\" [0 0 -1 .6 0 -.8]"};
    const char* looks[] = {"\"diffuse\"", "\"conductor\" \"float roughness\" .4", "\"coateddiffuse\"",
                           "\"diffusetransmission\""};
    const bool turn = whole(0, 1);
    std::string s = !turn ? "AttributeBegin\n"
                          : fmt::format(
                                "DynamicBegin \"lock\" Keyframe 1 Rotate 0 0 1 0 Keyframe {} Rotate 40 0 1 0 "
                                "KeyframeEnd\n",
                                last());
    s += "Material " +
         (whole(0, 1) ? "\"hair\"" + keyed("rgb sigma_a", "[.1 .3 .6]", "[.6 .3 .1]") : looks[whole(0, 3)]);
    for (int i = 0; i < 4; ++i) {
      const float x = real(-1, 1), z = real(-1, 0);
      s += fmt::format("\nShape \"curve\" \"string type\" \"{} \"float width0\" {} \"float width1\" {}",
                       types[whole(0, 2)], real(0.05f, 0.2f), real(0.05f, 0.2f)) +
           fmt::format(" \"point3 P\" [{0} -1.1 {1} {2} -.4 {1} {0} .3 {3} {2} 1 {1}]", x, z, x + real(-0.3f, 0.3f),
                       z + 0.2f);
    }
    return s + (turn ? "\nDynamicEnd\n" : "\nAttributeEnd\n");
  }

  static const SceneFiles& files() {
    static const SceneFiles all;
    return all;
  }

  std::mt19937 random_;
  int frames_;
};

}  // namespace dspm::test
