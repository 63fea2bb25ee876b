// A measured reflection as RGL's files store it. Directions are in the shading frame, above it.
#pragma once

#include <map>
#include <string>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/sampled_spectra.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/vec.h"
#include "dspm/materials/measured/bilinear_warp.h"
#include "dspm/materials/measured/tensor_file.h"

namespace dspm {

class MeasuredFile {
 public:
  /// Throws std::runtime_error with what is wrong with the tables.
  explicit MeasuredFile(const std::map<std::string, Tensor>& tables);

  Spectrum f(const Vec3& wo, const Vec3& wi, const Palette& palette) const;
  /// Returns a direction that may lie below the surface: then light is absorbed.
  Vec3 sample(const Vec3& wo, const Vec2& u) const;
  float density(const Vec3& wo, const Vec3& wi) const;
  /// The alpha of GGX with the same peak.
  float alpha() const { return alpha_; }

 private:
  struct Grid {
    int width, height;
    std::vector<float> values;
    float at(const Vec2& p) const;
  };
  struct Facet;  // between two directions, in the tables' coordinates

  static Grid grid_of(const Tensor& table);
  void read_reflectance(const std::map<std::string, Tensor>& tables);
  float measure_alpha() const;
  Spectrum reflectance(const Vec2& p, const GridMix& mix, const Palette& palette) const;
  float turn(float phi_of_facet, float phi_o) const { return is_isotropic_ ? phi_of_facet - phi_o : phi_of_facet; }

  GridParameters parameters_;  // azimuth and angle to the normal of wo
  bool is_isotropic_;
  Grid facets_, projected_;  // D and sigma
  BilinearWarp visible_, luminance_;
  int side_ = 0;                  // of the square of `reflectance_`
  std::vector<Rgb> reflectance_;  // by grid
  SampledSpectra spectra_;        // likewise; empty: it was measured in RGB
  float alpha_;
};

}  // namespace dspm
