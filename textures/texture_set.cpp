#include "dspm/textures/texture_set.h"

#include <type_traits>

#include "dspm/base/colour/rgb.h"

namespace dspm {
namespace {

constexpr std::string_view word_of_kind(bool is_float) { return is_float ? "float" : "spectrum"; }

/// Returns the likely reason why no texture has that name and kind.
template <class T>
std::string hint(const std::string& name, const TextureSet& textures) {
  using Other = std::conditional_t<std::is_same_v<T, float>, Rgb, float>;
  if (!textures.find<Other>(name)) return did_you_mean(name, textures.names<T>());
  constexpr bool is_float = std::is_same_v<T, float>;
  return "\"" + name + "\" is a " + std::string(word_of_kind(!is_float)) + " texture, but a " +
         std::string(word_of_kind(is_float)) + " texture is needed";
}

}  // namespace

template <class T>
TexturePtr<T> texture_of(const ValueOrTexture<T>& parameter, const TextureSet& textures, Diagnostics& diagnostics) {
  if (!parameter.texture.empty()) {
    if (auto texture = textures.find<T>(parameter.texture)) return texture;
    diagnostics.error(parameter.where, "there is no texture \"" + parameter.texture + "\" before this line",
                      hint<T>(parameter.texture, textures));
  }
  if constexpr (std::is_same_v<T, Rgb>)
    if (parameter.spectrum) return std::make_shared<SpectrumTexture>(Colour{parameter.value, parameter.spectrum});
  return std::make_shared<ConstantTexture<T>>(parameter.value);
}

template TexturePtr<float> texture_of(const ValueOrTexture<float>&, const TextureSet&, Diagnostics&);
template TexturePtr<Rgb> texture_of(const ValueOrTexture<Rgb>&, const TextureSet&, Diagnostics&);

}  // namespace dspm
