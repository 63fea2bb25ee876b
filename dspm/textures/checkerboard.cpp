// Two textures in alternating squares of unit side in the plane of the mapping, or in cubes of unit side in the
// texture's own space.
//
//   Texture "floor" "spectrum" "checkerboard" "float uscale" 8 "float vscale" 8 "rgb tex1" [.8 .8 .8]
//
//   | dimension | 2 | 2: squares, 3: cubes                                     |
//   | tex1      | 1 | in the square or cube whose lower corner is the origin   |
//   | tex2      | 0 | in the adjacent ones                                     |
//   and the mapping's parameters, see mapping.h, which apply to squares
#include <cmath>

#include "dspm/colour/rgb.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

template <class T>
class CheckerboardTexture final : public Texture<T> {
 public:
  CheckerboardTexture(TexturePtr<T> first, TexturePtr<T> second, bool cubes, const TextureMapping& mapping,
                      const Transform& world_from_texture)
      : first_(std::move(first)),
        second_(std::move(second)),
        cubes_(cubes),
        mapping_(mapping),
        world_from_texture_(world_from_texture) {}

  T evaluate(const TexturePoint& at) const override {
    return in_second(at) ? second_->evaluate(at) : first_->evaluate(at);
  }

  std::optional<T> constant() const override {
    const auto first = first_->constant(), second = second_->constant();
    return first && second && *first == *second ? first : std::nullopt;
  }

 private:
  bool in_second(const TexturePoint& at) const {
    float sum = 0;  // of the cell's coordinates; in floats, because they may exceed every integer type
    if (cubes_) {
      const Vec3 p = world_from_texture_.inverse_point(at.p);
      sum = std::floor(p.x) + std::floor(p.y) + std::floor(p.z);
    } else {
      const Vec2 st = mapping_.at(at);
      sum = std::floor(st.x) + std::floor(st.y);
    }
    return sum != 2 * std::floor(sum / 2);
  }

  TexturePtr<T> first_, second_;
  bool cubes_;
  TextureMapping mapping_;
  Transform world_from_texture_;
};

}  // namespace

template <class T>
TexturePtr<T> make_checkerboard(ParamReader& reader, const TextureContext& context) {
  const int dimension = reader.integer("dimension", 2, {}, "2: squares, 3: cubes");
  const auto first = value_or_texture<T>(reader, "tex1", 1, "in the square at the origin and every second one");
  const auto second = value_or_texture<T>(reader, "tex2", 0, "in the others");
  const TextureMapping mapping = TextureMapping::read(reader, context.world_from_texture);
  reader.finish();
  if (dimension != 2 && dimension != 3) reader.error("dimension", "the dimension of a checkerboard must be 2 or 3");
  Diagnostics& diagnostics = reader.diagnostics();
  return std::make_shared<CheckerboardTexture<T>>(texture_of(first, context.textures, diagnostics),
                                                  texture_of(second, context.textures, diagnostics), dimension == 3,
                                                  mapping, context.world_from_texture);
}

template TexturePtr<float> make_checkerboard<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_checkerboard<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
