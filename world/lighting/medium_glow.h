// The light that a medium gives off, as one that photon paths start from. Camera paths see it on their way through the medium, so
// no shadow ray looks for it.
#pragma once

#include <memory>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/distribution.h"
#include "dspm/base/math/vec.h"
#include "dspm/lights/light.h"
#include "dspm/media/medium.h"

namespace dspm {

class MediumGlow final : public Light {
 public:
  /// `box` holds all of the medium, and may hold points that are in another one: paths that start there are none.
  MediumGlow(std::shared_ptr<const Medium> medium, const Bounds3& box);

  Rgb power() const override { return power_; }  // of the whole box
  std::optional<Emission> emit(Vec2 u_position, Vec2 u_direction) const override;
  std::optional<Illumination> illuminate(const Vec3&, Vec2) const override { return std::nullopt; }

 private:
  struct Cell {
    Bounds3 box;
    Rgb emitted;  // the mean over a few of its points
    bool may_glow = false;
  };
  std::vector<Cell> cells_in(const Bounds3& box) const;
  Cell cell_of(const Bounds3& box) const;

  std::shared_ptr<const Medium> medium_;
  std::vector<Cell> cells_;  // along a curve through space, so that starts by numbers that are close are close
  std::unique_ptr<const Distribution1D> choice_;  // null: nothing glows
  Rgb power_;
};

}  // namespace dspm
