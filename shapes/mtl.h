// The materials of MTL files, as the materials of a scene.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/shapes/shape.h"

namespace dspm {

/// The statements of MTL that were left out, by name, and of which materials.
using MtlLeftOut = std::map<std::string, std::vector<std::string>>;

/// Returns the name under which a parameter of one of the material's pictures is among its own; `texture` is
/// FileTexture::name.
inline std::string of_picture(const std::string& parameter, const std::string& texture) {
  return parameter + " of " + texture;
}

/// Returns the name of the texture of FileMaterial::alpha.
inline std::string name_of_holes(const FileMaterial& of) { return "alpha of " + of.name + " in " + of.file.string(); }

/// Returns a name as OBJ and MTL files end them: with the line.
std::string trimmed(std::string_view text);

/// Returns the materials in the text of the MTL file `path`, read by tinyobjloader. The caller sets the places of
/// parameters. What there is no picture for is added to `complaints`, what dspm does not have to `left_out`.
std::vector<FileMaterial> read_mtl(const std::string& text, const std::filesystem::path& path,
                                   std::vector<std::string>& complaints, MtlLeftOut& left_out);

/// Returns `Ks and Ns of material "red" (and 3 more) are left out` and the like.
std::vector<std::string> in_words(const MtlLeftOut& left_out);

}  // namespace dspm
