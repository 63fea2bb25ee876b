#include "textures/plugins.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace dspm {

// One file a texture; each makes both kinds.
template <class T>
TexturePtr<T> make_checkerboard(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_constant(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_imagemap(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_mix(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_scale(ParamReader& reader, const TextureContext& context);

namespace {

template <class T>
constexpr Plugin<MakeTexture<T>> kTextures[] = {
    {"checkerboard", "two textures in alternating squares or cubes", make_checkerboard<T>},
    {"constant", "one value everywhere", make_constant<T>},
    {"imagemap", "a picture, or one a frame", make_imagemap<T>},
    {"mix", "a blend of two textures", make_mix<T>},
    {"scale", "a texture times another", make_scale<T>},
};

constexpr std::array<std::string_view, 8> kNotBuilt{"bilerp", "directionmix", "dots",  "fbm",
                                                    "marble", "ptex",         "windy", "wrinkled"};

}  // namespace

template <class T>
std::span<const Plugin<MakeTexture<T>>> texture_plugins() {
  return kTextures<T>;
}

template <class T>
TexturePtr<T> make_texture(std::string_view type, ParamReader& reader, const TextureContext& context) {
  Diagnostics& diagnostics = reader.diagnostics();
  if (std::find(kNotBuilt.begin(), kNotBuilt.end(), type) != kNotBuilt.end()) {
    const std::string message = "texture \"" + std::string(type) + "\" is not built in dspm";
    diagnostics.unsupported(reader.where(), message + (diagnostics.lenient() ? "; grey stands in for it" : ""));
  } else if (const auto* plugin = find_plugin(texture_plugins<T>(), "texture", type, reader.where(), diagnostics)) {
    return plugin->make(reader, context);
  }
  return std::make_shared<ConstantTexture<T>>(T(0.5f));
}

template <class T>
ValueOrTexture<T> value_or_texture(ParamReader& reader, std::string_view name, float fallback,
                                   std::string_view sentence) {
  if constexpr (std::is_same_v<T, float>)
    return reader.number_or_texture(name, fallback, {}, sentence);
  else
    return reader.rgb_or_texture(name, Rgb(fallback), SpectrumRole::albedo, sentence);
}

template std::span<const Plugin<MakeTexture<float>>> texture_plugins<float>();
template std::span<const Plugin<MakeTexture<Rgb>>> texture_plugins<Rgb>();
template TexturePtr<float> make_texture<float>(std::string_view, ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_texture<Rgb>(std::string_view, ParamReader&, const TextureContext&);
template ValueOrTexture<float> value_or_texture<float>(ParamReader&, std::string_view, float, std::string_view);
template ValueOrTexture<Rgb> value_or_texture<Rgb>(ParamReader&, std::string_view, float, std::string_view);

}  // namespace dspm
