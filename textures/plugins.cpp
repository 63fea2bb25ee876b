#include "dspm/textures/plugins.h"

#include <type_traits>

#include "dspm/base/colour/rgb.h"
#include "dspm/textures/watched_texture.h"

namespace dspm {

// One file per texture; each makes both kinds.
template <class T>
TexturePtr<T> make_angle(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_bilerp(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_checkerboard(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_constant(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_directionmix(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_dots(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_fbm(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_imagemap(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_marble(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_mix(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_product(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_scale(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_threshold(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_vertexcolor(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_windy(ParamReader& reader, const TextureContext& context);
template <class T>
TexturePtr<T> make_wrinkled(ParamReader& reader, const TextureContext& context);

template <class T>
PluginTable<Plugin<MakeTexture<T>>>& texture_plugins() {
  static PluginTable<Plugin<MakeTexture<T>>> table(
      "texture",
      {
          {"angle", "the angle of a direction in a texture of colours", make_angle<T>},
          {"bilerp", "four values at the corners of a square, and what lies between", make_bilerp<T>},
          {"checkerboard", "two textures in alternating squares or cubes", make_checkerboard<T>},
          {"constant", "one value everywhere", make_constant<T>},
          {"directionmix", "a blend of two textures by where the surface faces", make_directionmix<T>},
          {"dots", "two textures, one in scattered dots", make_dots<T>},
          {"fbm", "noise of several sizes", make_fbm<T>},
          {"imagemap", "a picture, or one per frame", make_imagemap<T>},
          {"marble", "layers of marble, distorted by noise", make_marble<T>},
          {"mix", "a blend of two textures", make_mix<T>},
          {"product", "a texture times another of its kind", make_product<T>},
          {"scale", "a texture times another", make_scale<T>},
          {"threshold", "a texture of numbers cut off: 0 below an edge, 1 from there on", make_threshold<T>},
          {"vertexcolor", "the colours of a mesh's vertices", make_vertexcolor<T>},
          {"windy", "waves under gusts of wind", make_windy<T>},
          {"wrinkled", "noise with creases", make_wrinkled<T>},
      },
      {"ptex"});
  return table;
}

template <class T>
TexturePtr<T> make_texture(std::string_view type, ParamReader& reader, const TextureContext& context) {
  if (type == "ptex")
    reader.diagnostics().unsupported(reader.where(), "texture \"ptex\" is not supported by dspm",
                                     "its library is not in Debian 12; with --lenient, grey stands in for it");
  else if (const auto* plugin = texture_plugins<T>().find(type, reader.where(), reader.diagnostics()))
    return plugin->origin.empty() ? plugin->make(reader, context)
                                  : watched(plugin->make(reader, context), reader.where(), type);
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

template PluginTable<Plugin<MakeTexture<float>>>& texture_plugins<float>();
template PluginTable<Plugin<MakeTexture<Rgb>>>& texture_plugins<Rgb>();
template TexturePtr<float> make_texture<float>(std::string_view, ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_texture<Rgb>(std::string_view, ParamReader&, const TextureContext&);
template ValueOrTexture<float> value_or_texture<float>(ParamReader&, std::string_view, float, std::string_view);
template ValueOrTexture<Rgb> value_or_texture<Rgb>(ParamReader&, std::string_view, float, std::string_view);

}  // namespace dspm
