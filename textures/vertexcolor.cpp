// The colours of a mesh's vertices, and what lies between them; 1 where a shape has none.
//
//   Texture "paint" "spectrum" "vertexcolor"
//   Texture "holes" "float" "vertexcolor"
//
//   | channel | "alpha" | of a texture of numbers: red, green, blue or alpha |
//
// Colours come from a PLY file's red, green, blue and alpha, or an OBJ file's vertices. They are linear light between
// the vertices.
#include <type_traits>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class VertexColourTexture final : public Texture<T> {
 public:
  explicit VertexColourTexture(std::size_t channel) : channel_(channel) {}

  T evaluate(const TexturePoint& at) const override {
    if (at.vertices.data == nullptr) return T(1);
    const auto c = at.vertices.data->vertex_colour(at.vertices.triangle, at.vertices.at);
    if constexpr (std::is_same_v<T, float>)
      return c[channel_];
    else
      return {c[0], c[1], c[2]};
  }

 private:
  std::size_t channel_;
};

}  // namespace

template <class T>
TexturePtr<T> make_vertexcolor(ParamReader& reader, const TextureContext&) {
  const std::string word =
      reader.choice("channel", "alpha", {"red", "green", "blue", "alpha"}, "that a texture of numbers takes");
  reader.finish();
  return std::make_shared<VertexColourTexture<T>>(word == "red" ? 0 : word == "green" ? 1 : word == "blue" ? 2 : 3);
}

template TexturePtr<float> make_vertexcolor<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_vertexcolor<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
