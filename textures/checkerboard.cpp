// Two textures in alternating squares of unit side in the plane of the mapping, or in cubes of unit side in the
// texture's own space.
//
//   Texture "floor" "spectrum" "checkerboard" "float uscale" 8 "float vscale" 8 "rgb tex1" [.8 .8 .8]
//
//   | dimension | 2 | 2: squares, 3: cubes                                     |
//   | tex1      | 1 | in the square or cube whose lower corner is the origin   |
//   | tex2      | 0 | in the adjacent ones                                     |
//   and the mapping's parameters, see mapping.h, which apply to squares
//
// Within a footprint, squares and cubes are averaged by a product of triangle filters along their edges, whose radius
// is one and a half footprints, as in pbrt. [Pharr, Jakob, Humphreys, Physically Based Rendering, 10.2]
#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/plain_part.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

/// Returns the mean of sign_of_cell() by a triangle filter of that radius.
float sign(float x, float radius) {
  if (!(std::floor(x - radius) < std::floor(x + radius))) return sign_of_cell(x);
  // The sign is the second derivative of this function, so its mean is a second difference; in double, as the radius
  // may be small.
  const auto integral = [](double at) {
    const double y = at / 2 - std::floor(at / 2) - 0.5;
    return y * (1 - 2 * std::abs(y));
  };
  const double c = x, r = radius;
  const double mean = (integral(c + r) - 2 * integral(c) + integral(c - r)) / (r * r);
  return static_cast<float>(std::clamp(mean, -1., 1.));
}

float radius(float along_x, float along_y) { return 1.5f * std::max(std::abs(along_x), std::abs(along_y)); }

template <class T>
class CheckerboardTexture final : public Texture<T> {
 public:
  CheckerboardTexture(TexturePtr<T> first, TexturePtr<T> second, bool cubes, const TextureMapping& mapping,
                      const Transform& world_from_texture)
      : first_(std::move(first)),
        second_(std::move(second)),
        plain_first_(first_),
        plain_second_(second_),
        cubes_(cubes),
        mapping_(mapping),
        world_from_texture_(world_from_texture) {}

  T evaluate(const TexturePoint& at) const override { return value(at, Evaluate{at}); }
  Carried<T> carried(const TexturePoint& at) const override { return value(at, Carry{at}); }

  std::optional<T> constant() const override {
    const auto first = first_->constant(), second = second_->constant();
    return first && second && *first == *second ? first : std::nullopt;
  }
  bool averages() const override {
    return first_->constant() && second_->constant() && first_->averages() && second_->averages();
  }
  std::optional<PlainTexture<T>> plain() const override {
    const auto mapping = mapping_.plain();
    if (!mapping) return std::nullopt;
    return if_sound(PlainTexture<T>(PlainCheckerboard<T>{plain_first_.get(), plain_second_.get(), cubes_, *mapping}));
  }

 private:
  template <class Look>
  auto value(const TexturePoint& at, const Look& look) const {
    const float share = (1 - (cubes_ ? cube(at) : square(at))) / 2;  // of the second
    if (share == 0) return look(first_);
    if (share == 1) return look(second_);
    return look(first_) * (1 - share) + look(second_) * share;
  }
  float square(const TexturePoint& at) const {
    const TextureCoordinates c = mapping_.map(at);
    return sign(c.st.x, radius(c.dstdx.x, c.dstdy.x)) * sign(c.st.y, radius(c.dstdx.y, c.dstdy.y));
  }
  float cube(const TexturePoint& at) const {
    const SpaceCoordinates c = in_own_space(world_from_texture_, at);
    return sign(c.p.x, radius(c.dpdx.x, c.dpdy.x)) * sign(c.p.y, radius(c.dpdx.y, c.dpdy.y)) *
           sign(c.p.z, radius(c.dpdx.z, c.dpdy.z));
  }

  TexturePtr<T> first_, second_;
  PlainPart<T> plain_first_, plain_second_;
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
