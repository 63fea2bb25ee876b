// MakeNamedMedium "mist" "string type" "rgbgrid" "integer nx" 2 "integer ny" 1 "integer nz" 1 "rgb sigma_s" [1 0 0 0 0 1]
//
// Absorption and scattering by colour on a grid, linear between the middles of voxels, and 0 outside of the box.
//
// | parameter        | default | meaning |
// | ---------------- | ------- | ------- |
// | nx, ny, nz       | 1       | number of voxels along each axis |
// | sigma_a, sigma_s | 1 in the box | nx * ny * nz colours, x fastest and z slowest, per unit of length in the world |
// | Le               | 0       | in the same way: radiance that what absorbs gives off |
// | p0, p1           | 0 0 0, 1 1 1 | corners of the box, in the medium's space |
// | scale            | 1       | multiplies sigma_a and sigma_s |
// | g                | 0       | mean cosine of scattering, between -1 and 1 |
// | Lescale          | 1       | multiplies Le |
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 11.4.4]
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/media/grid_params.h"
#include "dspm/media/medium.h"
#include "dspm/media/medium_box.h"

namespace dspm {
namespace {

class RgbGrid final : public Medium {
 public:
  struct Grids {
    Voxels<Rgb> sigma_a, sigma_s;  // empty: 1
    Voxels<Rgb> emission;          // empty: black
  };
  RgbGrid(const MediumBox& box, Grids grids, float scale, float emission_scale, float g)
      : box_(box), grids_(std::move(grids)), scale_(scale), emission_scale_(emission_scale), g_(g) {}

  MediumProperties at(const Vec3& p) const override {
    const Vec3 place = box_.place_of(p);
    if (!is_within_unit_box(place)) return {};
    const auto value = [&](const Voxels<Rgb>& grid) { return grid.empty() ? Rgb(1) : grid.at(place); };
    MediumProperties here{scale_ * value(grids_.sigma_a), scale_ * value(grids_.sigma_s), {}, g_};
    if (!grids_.emission.empty()) here.emitted = here.sigma_a * grids_.emission.at(place) * emission_scale_;
    return here;
  }

  Rgb majorant(const Bounds3& box) const override {
    const Bounds3 places = box_.places_of(box);
    const auto most = [&](const Voxels<Rgb>& grid) {
      if (grid.empty()) return Rgb(1);
      Rgb largest;
      grid.for_each_in(places, [&](const Rgb& c) {
        for (int i = 0; i < 3; ++i) largest[i] = std::max(largest[i], c[i]);
      });
      return largest;
    };
    return scale_ * (most(grids_.sigma_a) + most(grids_.sigma_s));
  }

  std::optional<Bounds3> extent() const override { return box_.extent(); }
  bool glows() const override { return !grids_.emission.empty(); }

 private:
  MediumBox box_;
  Grids grids_;
  float scale_, emission_scale_, g_;
};

}  // namespace

std::unique_ptr<Medium> make_rgb_grid(ParamReader& reader, const MediumContext& context) {
  const MediumBox box(reader, context.to_world);
  const auto counts = read_counts(reader);
  std::vector<Rgb> sigma_a = reader.colours("sigma_a", SpectrumRole::unbounded, "absorption in each voxel"),
                   sigma_s = reader.colours("sigma_s", SpectrumRole::unbounded, "scattering in each voxel"),
                   emission = reader.colours("Le", SpectrumRole::illuminant, "radiance that what absorbs gives off");
  const float scale = reader.number("scale", 1, "", "multiplies sigma_a and sigma_s"),
              emission_scale = reader.number("Lescale", 1, "", "multiplies Le"),
              g = reader.number("g", 0, "", "mean cosine of scattering, between -1 (back) and 1 (on)");
  reader.finish();
  if (!(std::abs(g) < 1)) reader.error("g", "\"g\" of " + reader.subject() + " must be between -1 and 1");
  for (const char* name : {"scale", "Lescale"})
    if (!((name[0] == 's' ? scale : emission_scale) >= 0))
      reader.error(name, std::string("\"") + name + "\" of " + reader.subject() + " must not be negative");
  RgbGrid::Grids grids{grid_of(reader, "sigma_a", std::move(sigma_a), counts),
                       grid_of(reader, "sigma_s", std::move(sigma_s), counts),
                       grid_of(reader, "Le", std::move(emission), counts)};
  return std::make_unique<RgbGrid>(box, std::move(grids), scale, emission_scale, g);
}

}  // namespace dspm
