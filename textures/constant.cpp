// One value everywhere.
//
//   Texture "grey" "spectrum" "constant" "rgb value" [.5 .5 .5]
//
//   | value | 1 | a number, or a colour in 0..1 |
#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plugins.h"

namespace dspm {

template <class T>
TexturePtr<T> make_constant(ParamReader& reader, const TextureContext& context) {
  const auto value = value_or_texture<T>(reader, "value", 1, "the value");
  reader.finish();
  return texture_of(value, context.textures, reader.diagnostics());
}

template TexturePtr<float> make_constant<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_constant<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
