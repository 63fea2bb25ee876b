// LightSource "goniometric" "string filename" "lamp.ies" "point3 from" [0 3 0]
//
// A point light whose intensity depends on the direction: as an image says, or a lamp maker's photometric file. Photons
// follow it exactly.
//
// | parameter | default  | meaning |
// | --------- | -------- | ------- |
// | filename  | required | an image, of any format of image.h, of which the mean of red, green and blue counts; or an IES file |
// | mapping   | auto     | of an image, as of "infinite": equalarea, equirectangular; auto: by the aspect |
// | I         | 1        | colour and factor of what the file says (W/sr, or cd if its luminance is 1) |
// | scale     | 1        | multiplies I |
// | power     | -1       | if above 0: the light is scaled to this many lumens, as if the luminance of I were 1 |
//
// The light is at the origin of light space. The middle of a square image, and the top row of a latitude-longitude one,
// is +y. An IES file's lamp hangs there and shines down, along -y; its horizontal angles begin at +x and turn to +z.
// Images are bilinear between the centres of their pixels, as those of "infinite".
// An IES file's intensities are in candela, linear between the angles that were measured, and here between angles a
// third of a degree apart. Its factors for the ballast apply, those for tilted lamps do not; its lamp's size does not
// count.
//
// [Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 12.2.3; ANSI/IES LM-63-19]
#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/plain_text.h"
#include "dspm/base/system/read_file.h"
#include "dspm/image/image.h"
#include "dspm/lights/environment_map.h"
#include "dspm/lights/ies.h"
#include "dspm/lights/light.h"
#include "dspm/lights/light_space.h"
#include "dspm/lights/read_environment.h"
#include "dspm/lights/shaped_point.h"
#include "dspm/lights/strength.h"

namespace dspm {
namespace {

/// Makes a map of latitude and longitude, whose first row looks up.
EnvironmentMap map_of(const Photometry& photometry) {
  constexpr int kRows = 540;
  Image image(photometry.is_symmetric() ? 1 : 2 * kRows, kRows);
  const auto middle = [](int cell, int cells) { return (static_cast<float>(cell) + 0.5f) / static_cast<float>(cells); };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = Rgb(photometry.intensity(180 * (1 - middle(y, image.height)), 360 * middle(x, image.width)));
  return EnvironmentMap(image, SphereMapping::equirectangular);
}

/// Returns nullopt if it is another kind of file.
std::optional<Photometry> read_ies(const std::filesystem::path& file) {
  try {
    const std::string bytes = read_file(file);
    if (is_ies(bytes)) return parse_ies(plain_text(bytes));
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(fmt::format("cannot read the IES file {}: {}", file.string(), e.what()));
  }
  return std::nullopt;
}

EnvironmentMap read_intensities(const std::filesystem::path& file, const std::string& mapping, ParamReader& reader) {
  if (const auto photometry = read_ies(file)) return map_of(*photometry);
  Image image = read_light_image(file, reader);
  for (Rgb& pixel : image.pixels) pixel = Rgb((pixel.r + pixel.g + pixel.b) / 3);
  const SphereMapping kind = mapping_of(image, mapping);
  return EnvironmentMap(image, kind);
}

}  // namespace

std::unique_ptr<Light> make_goniometric(ParamReader& reader, const LightContext& context) {
  const std::filesystem::path file = reader.file("filename", "an image of the intensities, or an IES file");
  const std::string mapping =
      reader.choice("mapping", "auto", kMappingWords, "how the image covers the sphere; auto: by its aspect ratio");
  const Rgb intensity =
      reader.rgb("I", Rgb(1), SpectrumRole::illuminant, "colour and factor of the file's intensities");
  const Strength strength = read_power(reader);
  reader.finish();
  EnvironmentMap map(Image(1, 1), SphereMapping::equal_area);
  try {
    if (!file.empty()) map = read_intensities(file, mapping, reader);
  } catch (const std::runtime_error& e) {
    reader.error("filename", e.what());
  }
  const float factor = strength.factor(map.fluence().g);
  const LightSpace space(context.to_world, LightSpace::Up::y);
  return std::make_unique<ShapedPoint<EnvironmentMap>>(context.to_world.point({}), space, std::move(map),
                                                       intensity * factor);
}

}  // namespace dspm
