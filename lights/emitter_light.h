// A light all of whose light comes from a plain struct, its emitter, which GPUs share with the CPU. Emitters have no surface,
// give light for all numbers, and have functions named as those of Light, constexpr: power(), emit(u_position, u_direction),
// pdf_emit(start), emission_numbers(start), illuminate(p).
#pragma once

#include <optional>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/light.h"

namespace dspm {

template <class Emitter>
class EmitterLight : public Light {
 public:
  explicit EmitterLight(const Emitter& emitter) : emitter_(emitter) {}

  Rgb power() const final { return emitter_.power(); }
  std::optional<Emission> emit(Vec2 u_position, Vec2 u_direction) const final {
    return emitter_.emit(u_position, u_direction);
  }
  EmissionPdf pdf_emit(const Ray& start, const Vec3&, int) const final { return emitter_.pdf_emit(start); }
  EmissionNumbers emission_numbers(const Ray& start, const Vec3&, int) const final {
    return emitter_.emission_numbers(start);
  }
  std::optional<Illumination> illuminate(const Vec3& p, Vec2) const final { return emitter_.illuminate(p); }

 protected:
  const Emitter& emitter() const { return emitter_; }

 private:
  Emitter emitter_;
};

}  // namespace dspm
