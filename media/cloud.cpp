// MakeNamedMedium "cumulus" "string type" "cloud" "float density" 2
//
// A cloud made of noise: dense in the lower half of the box, frayed above.
//
// | parameter        | default | meaning |
// | ---------------- | ------- | ------- |
// | density          | 1       | how much of the box the cloud fills |
// | wispiness        | 1       | how far it is frayed |
// | frequency        | 5       | how fine it is, per unit of the medium's space |
// | p0, p1           | 0 0 0, 1 1 1 | corners of the box, in the medium's space, where y = 1 is the top |
// | preset           |         | a measured medium, per millimetre, instead of both sigmas |
// | sigma_a, sigma_s | 1       | absorption and scattering per unit of length in the world, where it is densest |
// | scale            | 1       | multiplies both |
// | g                | 0       | mean cosine of scattering, between -1 and 1 |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 11.4.5]
#include <algorithm>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/media/coefficients.h"
#include "dspm/media/medium.h"
#include "dspm/media/medium_box.h"
#include "dspm/textures/noise.h"

namespace dspm {
namespace {

struct Looks {
  float density, wispiness, frequency;
};

/// The slopes of the noise along the three axes.
Vec3 slopes_of_noise(const Vec3& p) {
  constexpr float kStep = 0.01f;
  const float here = noise(p);
  return Vec3{noise(p + Vec3{kStep, 0, 0}) - here, noise(p + Vec3{0, kStep, 0}) - here,
              noise(p + Vec3{0, 0, kStep}) - here} /
         kStep;
}

float density_at(const Vec3& p, const Looks& shape) {
  Vec3 place = p * shape.frequency;
  if (shape.wispiness > 0) {
    float strength = 0.05f * shape.wispiness, fineness = 10;
    for (int octave = 0; octave < 2; ++octave, strength *= 0.5f, fineness *= 1.99f)
      place = place + strength * slopes_of_noise(fineness * place);
  }
  float sum = 0, strength = 0.5f, fineness = 1;
  for (int octave = 0; octave < 5; ++octave, strength *= 0.5f, fineness *= 1.99f)
    sum += strength * noise(fineness * place);
  const float frayed = std::clamp((1 - p.y) * 4.5f * shape.density * sum, 0.f, 1.f);
  return std::clamp(frayed + 2 * std::max(0.f, 0.5f - p.y), 0.f, 1.f);
}

class Cloud final : public Medium {
 public:
  Cloud(const MediumBox& box, const Coefficients& coefficients, const Looks& shape)
      : box_(box), coefficients_(coefficients), shape_(shape) {}

  MediumProperties at(const Vec3& p) const override {
    if (!is_within_unit_box(box_.place_of(p))) return {};
    const float density = density_at(box_.point_of(p), shape_);
    return {coefficients_.sigma_a * density, coefficients_.sigma_s * density, {}, coefficients_.g};
  }
  Rgb majorant(const Bounds3&) const override { return coefficients_.sigma_a + coefficients_.sigma_s; }
  std::optional<Bounds3> extent() const override { return box_.extent(); }

 private:
  MediumBox box_;
  Coefficients coefficients_;
  Looks shape_;
};

}  // namespace

std::unique_ptr<Medium> make_cloud(ParamReader& reader, const MediumContext& context) {
  const MediumBox box(reader, context.to_world);
  const Coefficients coefficients = read_coefficients(reader, Rgb(1), Rgb(1));
  const Looks shape{reader.number("density", 1, "", "how much of the box the cloud fills"),
                    reader.number("wispiness", 1, "", "how far it is frayed"),
                    reader.number("frequency", 5, "", "how fine it is, per unit of the medium's space")};
  reader.finish();
  auto medium = std::make_unique<Cloud>(box, coefficients, shape);
  medium->set_spectra(coefficients.spectra);
  return medium;
}

}  // namespace dspm
