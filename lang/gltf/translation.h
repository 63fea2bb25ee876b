// A glTF file as a scene in dspm's language. The text refers to meshes and pictures as files within the glTF file
// ("shoe.glb/seat.ply"), which are made when they are read: so what --to-dsc writes is what is rendered.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dspm::gltf {

/// How the camera sees the picture that lights a file: as it is, blurred, or a plain background instead.
enum class Backdrop { shown, blurred, hidden };

/// The animation of the scene that a file becomes a part of.
struct Around {
  int frames = 1;
  std::optional<double> fps;
};

struct Settings {
  double fps = 24;
  std::string animation;                // its name; empty: the first, and those that set other things
  std::string camera;                   // its name or number, from 1; empty: the first
  std::string studio = "auto";          // on, off, or auto: what is missing
  std::string hdr;                      // a picture of the light around; empty: none
  Backdrop backdrop = Backdrop::shown;  // of that picture
  /// It becomes part of a scene, without camera and studio; else it is a whole scene.
  std::optional<Around> around = std::nullopt;
  bool is_defined = false;  // names of materials and variants are known, as of a file that comes again
};

struct Translation {
  std::string text;
  std::map<std::string, std::function<std::string()>> files;  // by the name in the text
  // What files that change with time are so many frames later, by names that are in `files` as well.
  std::map<std::string, std::function<std::string(double)>> files_later;
  std::vector<std::string> notes;  // what is left out, or chosen
};

bool is_gltf_name(const std::filesystem::path& path);

/// Translates a file; `folder` goes before the names of files. Throws std::runtime_error with a sentence that does not
/// name the file.
Translation translate(const std::filesystem::path& path, const std::string& folder, const Settings& settings);

class Document;
Translation translate(std::shared_ptr<const Document> document, const std::string& folder, const Settings& settings);

}  // namespace dspm::gltf
