#include "dspm/shapes/mtl_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dspm/base/system/file_access.h"
#include "dspm/shapes/obj_statements.h"

namespace dspm {

std::optional<std::string> MtlPictures::add(const MtlPicture& picture, bool is_spectrum, FileMaterial& to) {
  const auto file = find(picture, to);
  if (!file) return std::nullopt;
  std::string name = fmt::format("{} of {} in {}", picture.statement, to.name, mtl_.string());
  to.textures.push_back({name, *file, is_spectrum});
  add_options(picture, name, is_spectrum, to);
  return name;
}

std::optional<std::filesystem::path> MtlPictures::holes(const MtlPicture& picture, FileMaterial& of) {
  const auto file = find(picture, of);
  if (file) add_options(picture, name_of_holes(of), false, of);
  return file;
}

std::optional<std::string> MtlPictures::add_normals(const MtlPicture& picture, FileMaterial& to) {
  tinyobj::texture_option_t options = picture.options;
  const float slopes = std::exchange(options.bump_multiplier, 1.f);
  const auto name = add({picture.statement, picture.file, options}, true, to);
  if (!name) return name;
  std::vector<Param>& params = to.params.params;
  params.push_back(param_of(ParamType::text, of_picture("encoding", *name), std::vector<std::string>{"linear"}, {}));
  if (slopes != 1) params.push_back(param_of(ParamType::number, "normalscale", std::vector<float>{slopes}, {}));
  return name;
}

std::optional<std::filesystem::path> MtlPictures::find(const MtlPicture& picture, const FileMaterial& of) {
  const std::string file = trimmed(picture.file);
  if (file.empty()) return std::nullopt;
  std::vector<std::string> spellings = spellings_of(file);
  if (std::string bare = without_folders(file); !bare.empty()) spellings.push_back(std::move(bare));
  for (const std::string& spelling : spellings)
    if (const std::filesystem::path path = mtl_.parent_path() / spelling; seems_to_exist(path))
      return std::filesystem::absolute(path);
  complaints_.push_back(fmt::format("there is no texture file \"{}\" for material \"{}\"", file, of.name));
  return std::nullopt;
}

/// Adds where the picture lies and what multiplies it: s = scale u + offset, as exporters mean it.
void MtlPictures::add_options(const MtlPicture& picture, const std::string& texture, bool is_spectrum,
                              FileMaterial& to) {
  const tinyobj::texture_option_t& options = picture.options;
  std::vector<Param>& params = to.params.params;
  const auto set = [&](const char* name, float value, float usual) {
    if (value != usual)
      params.push_back(param_of(ParamType::number, of_picture(name, texture), std::vector<float>{value}, {}));
  };
  const auto say = [&](const char* name, const char* word) {
    params.push_back(param_of(ParamType::text, of_picture(name, texture), std::vector<std::string>{word}, {}));
  };
  set("uscale", options.scale[0], 1), set("vscale", options.scale[1], 1);
  set("udelta", options.origin_offset[0], 0), set("vdelta", options.origin_offset[1], 0);
  if (options.clamp) say("wrap", "clamp");
  const float gain = options.brightness == 0 ? options.contrast : 1;
  set("scale", options.bump_multiplier * gain, 1);
  leave_out(picture, "-mm", options.brightness != 0, to);
  for (const char* channel : {"red", "green", "blue"})
    if (!is_spectrum && options.imfchan == *channel) say("channel", channel);
  leave_out(picture, "-t", options.turbulence[0] != 0 || options.turbulence[1] != 0, to);
}

void MtlPictures::leave_out(const MtlPicture& picture, const char* option, bool is_there, const FileMaterial& of) {
  if (is_there) left_out_[fmt::format("{} of {}", option, picture.statement)].push_back(of.name);
}

}  // namespace dspm
