// The pictures of MTL materials, with their options.
#pragma once

#include <tiny_obj_loader.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dspm/shapes/mtl.h"

namespace dspm {

/// A picture and the statement that names it.
struct MtlPicture {
  const char* statement;
  std::string file;
  const tinyobj::texture_option_t& options;
};

class MtlPictures {
 public:
  /// Takes the path of the file, `mtl`; the rest is as in read_mtl.
  MtlPictures(const std::filesystem::path& mtl, std::vector<std::string>& complaints, MtlLeftOut& left_out)
      : mtl_(mtl), complaints_(complaints), left_out_(left_out) {}

  /// Adds an imagemap of that file to the material, with its options. Returns its name, if the file is there.
  std::optional<std::string> add(const MtlPicture& picture, bool is_spectrum, FileMaterial& to);
  /// Returns where the picture of FileMaterial::alpha is, if it is there; adds its options.
  std::optional<std::filesystem::path> holes(const MtlPicture& picture, FileMaterial& of);
  /// Adds a picture of normals as add() does; -bm multiplies their slopes.
  std::optional<std::string> add_normals(const MtlPicture& picture, FileMaterial& to);

 private:
  std::optional<std::filesystem::path> find(const MtlPicture& picture, const FileMaterial& of);
  void add_options(const MtlPicture& picture, const std::string& texture, bool is_spectrum, FileMaterial& to);
  void leave_out(const MtlPicture& picture, const char* option, bool is_there, const FileMaterial& of);

  const std::filesystem::path& mtl_;
  std::vector<std::string>& complaints_;
  MtlLeftOut& left_out_;
};

}  // namespace dspm
