// MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [.1 .1 .1] "rgb sigma_a" [0 0 0]
//
// The same at every point.
//
// | parameter        | default               | meaning |
// | ---------------- | --------------------- | ------- |
// | preset           |                       | a measured medium, per millimetre, instead of both sigmas |
// | sigma_a, sigma_s | milk's, per millimetre | absorption and scattering per unit of length in the world |
// | scale            | 1                     | multiplies both |
// | g                | 0                     | mean cosine of scattering, between -1 and 1 |
// | Le               | 0                     | radiance that what absorbs gives off: sigma_a Le per unit of length |
// | Lescale          | 1                     | multiplies Le |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 11.4]
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/media/coefficients.h"
#include "dspm/media/medium.h"

namespace dspm {
namespace {

class Homogeneous final : public Medium {
 public:
  explicit Homogeneous(const MediumProperties& properties) : properties_(properties) {}

  MediumProperties at(const Vec3&) const override { return properties_; }
  Rgb majorant(const Bounds3&) const override { return properties_.sigma_t(); }
  bool glows() const override { return !is_black(properties_.emitted); }
  std::optional<MediumProperties> everywhere() const override { return properties_; }

 private:
  MediumProperties properties_;
};

}  // namespace

std::unique_ptr<Medium> make_homogeneous_medium(ParamReader& reader, const MediumContext&) {
  Coefficients read = read_coefficients(reader, {.0011f, .0024f, .014f}, {2.55f, 3.21f, 3.77f});
  const Rgb radiance = read_emitted_radiance(reader, read);
  const float scale = reader.number("Lescale", 1, "", "multiplies Le");
  if (!(scale >= 0)) reader.error("Lescale", "\"Lescale\" of " + reader.subject() + " must not be negative");
  reader.finish();
  auto medium = std::make_unique<Homogeneous>(
      MediumProperties{read.sigma_a, read.sigma_s, read.sigma_a * (radiance * scale), read.g});
  medium->set_spectra(read.spectra);
  return medium;
}

}  // namespace dspm
