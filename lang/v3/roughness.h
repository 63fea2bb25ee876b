// The roughness of pbrt-v3's materials as v4's.
#pragma once

#include <string>
#include <string_view>

#include "dspm/lang/v3/edit.h"

namespace dspm::v3 {

/// Puts `Texture "name" "float" "scale" "texture tex" of "float scale" by` before the directive, under a name of its
/// own, which it returns.
std::string scaled_texture(Edit& edit, std::string_view type, const std::string& of, float by);

/// Converts "roughness", "uroughness" and "vroughness": numbers become alpha itself, unless textures are among them.
void convert_roughness(Edit& edit);

}  // namespace dspm::v3
