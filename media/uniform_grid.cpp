// MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 1 "integer nz" 1 "float density" [0 1]
//
// A density on a grid, linear between the middles of voxels, and 0 outside of the box. Flames have a grid of temperatures.
//
// | parameter         | default | meaning |
// | ----------------- | ------- | ------- |
// | nx, ny, nz        | 1       | number of voxels along each axis |
// | density           |         | nx * ny * nz numbers, x fastest and z slowest |
// | temperature       |         | in the same way, kelvin: what absorbs glows as a black body |
// | temperatureoffset, temperaturescale | 0, 1 | the temperature is (t - offset) scale; below 100 K nothing glows |
// | p0, p1            | 0 0 0, 1 1 1 | corners of the box, in the medium's space |
// | preset            |         | a measured medium, per millimetre, instead of both sigmas |
// | sigma_a, sigma_s  | 1       | absorption and scattering per unit of length in the world, for a density of 1 |
// | scale             | 1       | multiplies both |
// | g                 | 0       | mean cosine of scattering, between -1 and 1 |
// | Le                | 0       | radiance that what absorbs gives off |
// | Lescale           | 1       | multiplies Le or what glows: one number, or one for each voxel |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 11.4.3]
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/media/coefficients.h"
#include "dspm/media/glow.h"
#include "dspm/media/grid_params.h"
#include "dspm/media/medium.h"
#include "dspm/media/medium_box.h"

namespace dspm {
namespace {

class UniformGrid final : public Medium {
 public:
  struct Emission {
    Rgb colour;
    Voxels<float> scale;  // empty: 1
    Voxels<float> temperature;
    Glow glow;
  };
  UniformGrid(const MediumBox& box, const Coefficients& coefficients, Voxels<float> density, Emission emission)
      : box_(box), coefficients_(coefficients), density_(std::move(density)), emission_(std::move(emission)) {}

  MediumProperties at(const Vec3& p) const override {
    const Vec3 place = box_.place_of(p);
    if (!is_within_unit_box(place)) return {};
    const float density = density_.at(place);
    MediumProperties here{coefficients_.sigma_a * density, coefficients_.sigma_s * density, {}, coefficients_.g};
    here.emitted = here.sigma_a * emitted_at(place);
    return here;
  }

  Rgb majorant(const Bounds3& box) const override {
    float most = 0;
    density_.for_each_in(box_.places_of(box), [&](float density) { most = std::max(most, density); });
    return (coefficients_.sigma_a + coefficients_.sigma_s) * most;
  }

  std::optional<Bounds3> extent() const override { return box_.extent(); }
  bool glows() const override { return !emission_.temperature.empty() || !is_black(emission_.colour); }

 private:
  Rgb emitted_at(const Vec3& place) const {
    const float scale = emission_.scale.empty() ? 1 : emission_.scale.at(place);
    if (emission_.temperature.empty()) return emission_.colour * scale;
    return emission_.glow.at(emission_.temperature.at(place)) * scale;
  }

  MediumBox box_;
  Coefficients coefficients_;
  Voxels<float> density_;
  Emission emission_;
};

}  // namespace

std::unique_ptr<Medium> make_uniform_grid(ParamReader& reader, const MediumContext& context) {
  const MediumBox box(reader, context.to_world);
  const auto counts = read_counts(reader);
  std::vector<float> density = reader.numbers("density", "density of each voxel, x fastest and z slowest"),
                     temperature = reader.numbers("temperature", "temperature of each voxel, in kelvin");
  Coefficients coefficients = read_coefficients(reader, Rgb(1), Rgb(1));
  UniformGrid::Emission emission{read_emitted_radiance(reader, coefficients), {}, {}, Glow(reader)};
  std::vector<float> scale =
      reader.numbers("Lescale", "multiplies Le or what glows: one number, or one for each voxel");
  reader.finish();
  if (density.empty()) reader.error("density", reader.subject() + " needs a \"density\"");
  if (!temperature.empty() && reader.has("Le"))
    reader.error("Le", "\"Le\" and \"temperature\" of " + reader.subject() + " exclude each other");
  if (scale.size() == 1) {
    emission.colour *= scale.front();
    emission.glow.multiply(scale.front());
    scale.clear();
  }
  emission.scale = grid_of(reader, "Lescale", std::move(scale), counts);
  emission.temperature = grid_of(reader, "temperature", std::move(temperature), counts);
  auto medium = std::make_unique<UniformGrid>(box, coefficients, grid_of(reader, "density", std::move(density), counts),
                                              std::move(emission));
  medium->set_spectra(coefficients.spectra);
  return medium;
}

}  // namespace dspm
