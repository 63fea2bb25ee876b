// The light of what is hot.
#pragma once

#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"

namespace dspm {

/// A black body's colour by temperature, its spectrum's peak scaled to 1 as in pbrt.
class Glow {
 public:
  /// Reads "temperatureoffset" and "temperaturescale".
  explicit Glow(ParamReader& reader);

  /// Returns the radiance; black below 100 K.
  Rgb at(float temperature) const;
  void multiply(float factor) { factor_ *= factor; }

 private:
  float offset_, scale_, factor_ = 1;
};

}  // namespace dspm
