// MakeNamedMedium "smoke" "string type" "nanovdb" "string filename" "smoke.nvdb"
//
// A density, and flames' temperatures, on the sparse grids of a NanoVDB file, linear between voxels.
//
// | parameter         | default     | meaning |
// | ----------------- | ----------- | ------- |
// | filename          |             | the file; "smoke.%04d.nvdb" is a file for each frame |
// | gridname          | density     | the grid with the density |
// | temperaturename   | temperature | the grid with temperatures, if the file has one, in kelvin: what absorbs glows as a black body |
// | temperatureoffset, temperaturescale | 0, 1 | the temperature is (t - offset) scale; below 100 K nothing glows |
// | Lescale           | 1           | multiplies what glows |
// | preset            |             | a measured medium, per millimetre, instead of both sigmas |
// | sigma_a, sigma_s  | 1           | absorption and scattering per unit of length in the world, for a density of 1 |
// | scale             | 1           | multiplies both |
// | g                 | 0           | mean cosine of scattering, between -1 and 1 |
//
// [Museth 2021, NanoVDB: A GPU-Friendly and Portable VDB Data Structure]
#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/media/coefficients.h"
#include "dspm/media/glow.h"
#include "dspm/media/medium.h"
#include "dspm/media/read_nanovdb.h"
#include "dspm/media/read_openvdb.h"

namespace dspm {
namespace {

class SparseMedium final : public Medium {
 public:
  SparseMedium(const Transform& to_world, const Coefficients& coefficients, SparseGrid density,
               std::optional<SparseGrid> temperature, const Glow& glow)
      : to_world_(to_world),
        coefficients_(coefficients),
        density_(std::move(density)),
        temperature_(std::move(temperature)),
        glow_(glow) {}

  MediumProperties at(const Vec3& p) const override {
    const Vec3 place = to_world_.inverse_point(p);
    const float density = density_.at(place);
    MediumProperties here{coefficients_.sigma_a * density, coefficients_.sigma_s * density, {}, coefficients_.g};
    if (temperature_ && density > 0) here.emitted = here.sigma_a * glow_.at(temperature_->at(place));
    return here;
  }

  Rgb majorant(const Bounds3& box) const override {
    return (coefficients_.sigma_a + coefficients_.sigma_s) * density_.largest_in(to_world_.inverse_bounds(box));
  }

  std::optional<Bounds3> extent() const override { return to_world_.bounds(density_.extent()); }
  bool glows() const override { return temperature_.has_value(); }

 private:
  Transform to_world_;
  Coefficients coefficients_;
  SparseGrid density_;
  std::optional<SparseGrid> temperature_;
  Glow glow_;
};

/// Returns nullopt if the file has no such grid, or after an error.
std::optional<SparseGrid> read_grid(ParamReader& reader, const std::filesystem::path& file, const std::string& name) {
  try {
    return file.extension() == ".vdb" ? read_openvdb(file, name) : read_nanovdb(file, name);
  } catch (const std::runtime_error& error) {
    reader.error("filename", fmt::format("\"{}\" cannot be read: {}", file.string(), error.what()));
    return std::nullopt;
  }
}

}  // namespace

std::unique_ptr<Medium> make_nanovdb(ParamReader& reader, const MediumContext& context) {
  const std::filesystem::path file = reader.file("filename", "the file: .nvdb is NanoVDB's, .vdb OpenVDB's");
  const std::string density_name = reader.text("gridname", "density", "the grid with the density"),
                    temperature_name =
                        reader.text("temperaturename", "temperature", "the grid with temperatures, if any");
  const Coefficients coefficients = read_coefficients(reader, Rgb(1), Rgb(1));
  Glow glow(reader);
  glow.multiply(reader.number("Lescale", 1, "", "multiplies what glows"));
  reader.finish();
  if (file.empty()) return nullptr;
  std::optional<SparseGrid> density = read_grid(reader, file, density_name);
  const bool sound = reader.diagnostics().error_count() == 0;
  if (!density && sound)
    reader.error("gridname", fmt::format("\"{}\" has no grid \"{}\"", file.string(), density_name));
  if (!density) return nullptr;
  auto medium = std::make_unique<SparseMedium>(context.to_world, coefficients, *std::move(density),
                                               read_grid(reader, file, temperature_name), glow);
  medium->set_spectra(coefficients.spectra);
  return medium;
}

}  // namespace dspm
