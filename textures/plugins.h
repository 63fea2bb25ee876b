// The table of textures, and the input of their factories.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "dspm/base/math/transform.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/textures/image_cache.h"
#include "dspm/textures/texture_set.h"

namespace dspm {

struct TextureContext {
  const TextureSet& textures;  // those defined so far
  Transform world_from_texture;
  ImageCache& images;
};

/// A factory; T is float for "float" textures and Rgb for "spectrum" textures.
template <class T>
using MakeTexture = TexturePtr<T>(ParamReader& reader, const TextureContext& context);

template <class T>
PluginTable<Plugin<MakeTexture<T>>>& texture_plugins();

/// Makes a texture of that type, never null: a grey one after an error, or if --lenient lets an unsupported one pass.
template <class T>
TexturePtr<T> make_texture(std::string_view type, ParamReader& reader, const TextureContext& context);

/// Reads a parameter that is a number or, in a texture of colours, a colour; or a texture of those.
template <class T>
ValueOrTexture<T> value_or_texture(ParamReader& reader, std::string_view name, float fallback,
                                   std::string_view sentence);

}  // namespace dspm
