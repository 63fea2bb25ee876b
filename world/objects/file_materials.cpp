// Materials that geometry files bring along.
#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/shapes/mtl.h"
#include "dspm/textures/normal_picture.h"
#include "dspm/world/objects/looks.h"

namespace dspm {
namespace {

Param file_param(const char* name, const std::filesystem::path& file, const SourceLocation& where) {
  return param_of(ParamType::text, name, std::vector{file.string()}, where);
}

/// Returns the picture's imagemap. A picture of numbers holds no colours, whatever its format.
TextureUse texture_use(const FileTexture& picture, const SourceLocation& where) {
  TextureUse use;
  use.type = "imagemap", use.name = picture.name, use.is_spectrum = picture.is_spectrum;
  use.where = use.type_where = where;
  use.params.params.push_back(file_param("filename", picture.file, where));
  if (!picture.is_spectrum)
    use.params.params.push_back(param_of(ParamType::text, "encoding", std::vector<std::string>{"linear"}, where));
  return use;
}

/// Adds holes and light as parameters of the material.
void add_holes_and_light(ParamList& params, std::vector<FileTexture>& textures, const FileMaterial& file,
                         const SourceLocation& where) {
  if (!file.alpha.empty()) {
    const std::string name = name_of_holes(file);
    textures.push_back({name, file.alpha, false});
    params.params.push_back(param_of(ParamType::texture, "alpha", std::vector{name}, where));
  }
  if (file.radiance) {
    const Rgb& c = *file.radiance;
    params.params.push_back(param_of(ParamType::rgb, "emission", std::vector{c.r, c.g, c.b}, where));
  }
}

/// Moves the picture's parameters, which are among the material's, to the picture.
void take_params_of_picture(TextureUse& picture, ParamList& material) {
  const std::string ending = of_picture("", picture.name);
  for (Param& param : material.params)
    if (param.name.ends_with(ending)) {
      param.name.resize(param.name.size() - ending.size());
      picture.params.params.push_back(std::move(param));
    }
  std::erase_if(material.params, [](const Param& param) { return param.name.empty(); });
}

/// Sorts out the material's relief: a picture of heights or, if it holds them, one of normals.
void sort_out_relief(ParamList& params, const std::vector<FileTexture>& textures) {
  const auto displacement = std::find_if(params.params.begin(), params.params.end(),
                                         [](const Param& param) { return param.name == "displacement"; });
  if (displacement == params.params.end()) return;
  const std::string name = std::get<std::vector<std::string>>(displacement->values).front();
  for (const FileTexture& texture : textures)
    if (texture.name == name && holds_normals(texture.file))
      *displacement = file_param("normalmap", texture.file, displacement->where);
}

}  // namespace

int Looks::add(const FileMaterial& file, const SourceLocation& where) {
  if (const auto own = by_name_.find(file.name); own != by_name_.end()) return own->second;
  const auto key = std::make_pair(file.file, file.name);
  if (const auto found = from_files_.find(key); found != from_files_.end()) return found->second;
  std::vector<FileTexture> textures = file.textures;
  MaterialUse& use = material_uses_.emplace_back();
  use.type = file.type, use.name = file.name, use.params = file.params;
  use.where = use.type_where = where;
  add_holes_and_light(use.params, textures, file, where);
  for (const FileTexture& texture : textures) {
    TextureUse& picture = texture_uses_.emplace_back(texture_use(texture, where));
    take_params_of_picture(picture, use.params);
    add_texture(picture);
  }
  sort_out_relief(use.params, textures);
  const int material = add_material(use, fmt::format("material \"{}\" of the file", file.name), file.name);
  from_files_.emplace(key, material);
  by_name_in_files_.emplace(file.name, material);
  return material;
}

}  // namespace dspm
