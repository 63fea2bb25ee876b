// Textures of modules, whose values may be anything: what no texture can give is taken for 0, and the texture is named.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dspm/base/params/errors.h"
#include "dspm/textures/texture.h"

namespace dspm {

struct TextureFault {
  std::string place, type;  // "scene.dsc:7: ", as the scene may be gone by the time that it is told
  friend bool operator==(const TextureFault&, const TextureFault&) = default;
};

/// Returns the texture, watched. Numbers must be finite; colours must not be negative, either.
template <class T>
TexturePtr<T> watched(TexturePtr<T> texture, const SourceLocation& where, std::string_view type);

/// Returns textures that gave other values since the last call, each once in the life of the process.
std::vector<TextureFault> take_texture_faults();

}  // namespace dspm
