// A medium says what happens to light between surfaces: fog, smoke, clouds, liquids. Plugins: homogeneous.cpp is the shortest
// to copy; plugins.cpp is the table.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "dspm/base/colour/colour.h"
#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"

namespace dspm {

/// What a medium does to light at a point, per unit of length in the world.
template <class C>
struct MediumPropertiesIn {
  C sigma_a;    // the share that is absorbed
  C sigma_s;    // the share that is scattered
  C emitted;    // the radiance that is added
  float g = 0;  // the mean cosine of scattering, between -1 and 1 [Henyey and Greenstein 1941]

  C sigma_t() const { return sigma_a + sigma_s; }
  /// The share of what is not passed on that is scattered.
  C albedo() const {
    const C all = sigma_t();
    C share;
    for (int c = 0; c < 3; ++c) share[c] = all[c] > 0 ? sigma_s[c] / all[c] : 0;
    return share;
  }
};
using MediumProperties = MediumPropertiesIn<Rgb>;
/// The same as paths carry it.
using CarriedMedium = MediumPropertiesIn<Spectrum>;

/// What a medium's sigmas are multiples of, if they are given as spectra, and what it gives off: by wavelength, over the
/// luminance of what it gives off as a colour. Null: the colour says all.
struct MediumSpectra {
  Colour sigma_a, sigma_s;
  std::shared_ptr<const SpectrumByNm> emitted = nullptr;
  bool are_given() const { return sigma_a.spectrum || sigma_s.spectrum; }
};

class Medium {
 public:
  virtual ~Medium() = default;
  /// The properties at a point of the world.
  virtual MediumProperties at(const Vec3& p) const = 0;
  /// Returns at least the largest sigma_t in a box of the world, by colour. Paths collide with the medium so often, and more
  /// of these collisions have no effect the looser the bound is.
  virtual Rgb majorant(const Bounds3& box) const = 0;
  /// Returns a box of the world outside of which there is nothing of it; nullopt if it fills all space.
  virtual std::optional<Bounds3> extent() const { return std::nullopt; }
  /// Returns whether it gives off light.
  virtual bool glows() const { return false; }
  /// Returns the properties if they are the same everywhere: light that is left after a distance is then computed, not
  /// estimated.
  virtual std::optional<MediumProperties> everywhere() const { return std::nullopt; }

  /// The spectra, for any plugin. Set once, when the medium is made.
  const MediumSpectra& spectra() const { return spectra_; }
  void set_spectra(MediumSpectra spectra) { spectra_ = std::move(spectra); }
  /// Returns properties that the medium gave, as paths carry them.
  CarriedMedium carried(const MediumProperties& here, const Palette& palette) const;

 private:
  MediumSpectra spectra_;
};

struct MediumContext {
  Transform to_world;
};

using MakeMedium = std::unique_ptr<Medium>(ParamReader&, const MediumContext&);
PluginTable<Plugin<MakeMedium>>& medium_plugins();

}  // namespace dspm
