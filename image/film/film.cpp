#include "dspm/image/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "dspm/base/system/extension.h"
#include "dspm/image/film/read_sensor.h"

namespace dspm {

namespace {

constexpr int kMaxSide = 1 << 16;

/// Returns nullopt if the parameter is absent or, after an error, if it does not have four values.
template <class T>
std::optional<std::array<T, 4>> four(ParamReader& reader, const char* name, const std::vector<T>& values) {
  if (values.empty()) return std::nullopt;
  if (values.size() != 4) {
    reader.error(name, std::to_string(values.size()) + " values, but four are expected: x0 x1 y0 y1");
    return std::nullopt;
  }
  return std::array<T, 4>{values[0], values[1], values[2], values[3]};
}

/// Replaces an invalid side by `fallback`, so that one error does not cause others.
void check_side(ParamReader& reader, const char* name, int& side, int fallback) {
  if (side >= 1 && side <= kMaxSide) return;
  reader.error(name, "the resolution must be between 1 and 65536");
  side = fallback;
}

void check(ParamReader& reader, FilmSettings& film) {
  check_side(reader, "xresolution", film.width, FilmSettings().width);
  check_side(reader, "yresolution", film.height, FilmSettings().height);
  if (!is_image_name(film.filename))
    reader.error("filename", fmt::format("images are written as {}, not as \"{}\"", kImageNames, film.filename));
  if (film.crop_window && film.pixel_bounds) {
    reader.warning("cropwindow", "the crop window is used, the pixel bounds are not");
  }
  if (crop_of(film).empty()) {
    reader.error(film.crop_window ? "cropwindow" : "pixelbounds", "nothing is left of the image");
  }
  if (film.white_kelvin != 0 && !(film.white_kelvin >= 1000 && film.white_kelvin <= 25000))
    reader.error("whitebalance", "the white balance must be a temperature from 1000 to 25000 K, or 0");
  if (!(film.iso > 0)) reader.error("iso", "the ISO speed and the exposure time must be above 0");
  if (!(film.max_component > 0)) reader.error("maxcomponentvalue", "the largest value must be above 0");
}

void read_common(ParamReader& reader, FilmSettings& film) {
  film.width = reader.integer("xresolution", film.width, "pixels", "width of the full image");
  film.height = reader.integer("yresolution", film.height, "pixels", "height of the full image");
  film.filename =
      reader.text("filename", film.filename, "the image file, .exr, .png, .webp, .pfm or .hdr; frames are numbered");
  film.crop_window =
      four(reader, "cropwindow", reader.numbers("cropwindow", "x0 x1 y0 y1 in 0..1: the region to render"));
  film.pixel_bounds =
      four(reader, "pixelbounds", reader.integers("pixelbounds", "x0 x1 y0 y1 in pixels: the region to render"));
  film.diagonal = reader.number("diagonal", 35, "mm", "diagonal of the film") / 1000;
  film.iso = reader.number("iso", film.iso, "", "speed of the film: 200 doubles the values of 100");
  film.iso *= reader.number("exposuretime", 1, "s", "of early scenes: multiplies values, beside the camera's shutter");
  film.max_component = reader.number("maxcomponentvalue", film.max_component, "",
                                     "colours with a brighter component are scaled down to it");
  film.save_half = reader.flag("savefp16", film.save_half, "half precision in the EXR file, else single");
  film.transparent =
      reader.flag("transparent", film.transparent,
                  "an alpha channel: lights infinitely far away do not show behind the scene, though they light it");
  film.white_kelvin = reader.number("whitebalance", 0, "K", "daylight that becomes white; 0: colours stay as they are");
  read_sensor(reader, film);
  film.space = reader.space();
  reader.finish();
  check(reader, film);
}

std::unique_ptr<FilmSettings> make_rgb(ParamReader& reader) {
  auto film = std::make_unique<FilmSettings>();
  read_common(reader, *film);
  return film;
}

/// Makes a film of a spectral render, with buckets that nothing fills.
std::unique_ptr<FilmSettings> make_spectral(ParamReader& reader) {
  const int buckets = reader.integer("nbuckets", 16, "", "of the wavelengths, in pbrt");
  const float shortest = reader.number("lambdamin", 360, "nm", "shortest wavelength, in pbrt");
  const float longest = reader.number("lambdamax", 830, "nm", "longest wavelength, in pbrt");
  auto film = std::make_unique<FilmSettings>();
  film->spectral = true;
  read_common(reader, *film);
  if (buckets < 1) reader.error("nbuckets", "the number of buckets must be at least 1");
  if (!(shortest < longest)) reader.error("lambdamax", "the longest wavelength must be above the shortest");
  reader.diagnostics().note(reader.where(),
                            "film \"spectral\" is rendered by wavelength, but the image has no layers of single "
                            "wavelengths");
  return film;
}

std::unique_ptr<FilmSettings> make_gbuffer(ParamReader& reader) {
  auto film = std::make_unique<FilmSettings>();
  film->surface_outputs = true;
  film->in_camera_space =
      reader.choice("coordinatesystem", "camera", {"camera", "world"}, "space of positions and normals") == "camera";
  read_common(reader, *film);
  return film;
}

}  // namespace

PluginTable<Plugin<MakeFilm>>& film_plugins() {
  static PluginTable<Plugin<MakeFilm>> table("film",
                                             {{"rgb", "colour images, one per frame", make_rgb},
                                              {"gbuffer", "colours, and what the camera sees first", make_gbuffer},
                                              {"spectral", "by wavelength, into an image in RGB", make_spectral}});
  return table;
}

bool is_image_name(const std::string& filename) {
  const std::string extension = extension_of(filename);
  return extension == ".exr" || extension == ".png" || extension == ".webp" || extension == ".pfm" ||
         extension == ".hdr";
}

std::optional<ColourMatrix> white_balance(const FilmSettings& film) {
  if (film.white_kelvin == 0) return std::nullopt;
  const Chromaticities& rec709 = chromaticities(ColourSpace::srgb);
  return rgb_from_xyz(rec709) *
         (adaptation(white_of(static_cast<double>(film.white_kelvin)), chromaticities(film.space).white) *
          xyz_from_rgb(rec709));
}

std::optional<ColourMatrix> to_film_space(const FilmSettings& film) {
  if (film.space == ColourSpace::srgb) return std::nullopt;
  return rgb_from_xyz(chromaticities(film.space)) * xyz_from_rgb(chromaticities(ColourSpace::srgb));
}

PixelRect crop_of(const FilmSettings& film) {
  if (film.crop_window) {
    const auto& [xa, xb, ya, yb] = *film.crop_window;
    const auto edge = [](int size, float at) {
      return static_cast<int>(std::ceil(static_cast<float>(size) * std::clamp(at, 0.f, 1.f)));
    };
    return {edge(film.width, std::min(xa, xb)), edge(film.height, std::min(ya, yb)), edge(film.width, std::max(xa, xb)),
            edge(film.height, std::max(ya, yb))};
  }
  if (film.pixel_bounds) {
    const auto& [x0, x1, y0, y1] = *film.pixel_bounds;
    return {std::max(x0, 0), std::max(y0, 0), std::min(x1, film.width), std::min(y1, film.height)};
  }
  return {0, 0, film.width, film.height};
}

FilmSettings scaled(FilmSettings film, int width, int height) {
  const int old_width = film.width, old_height = film.height;
  film.width = std::clamp(width, 1, kMaxSide), film.height = std::clamp(height, 1, kMaxSide);
  if (!film.pixel_bounds) return film;
  const auto moved = [](int edge, int from, int to) {
    return static_cast<int>(std::lround(static_cast<double>(edge) * to / from));
  };
  auto& [x0, x1, y0, y1] = *film.pixel_bounds;
  x0 = moved(x0, old_width, film.width), y0 = moved(y0, old_height, film.height);
  x1 = std::max(moved(x1, old_width, film.width), x0 + 1), y1 = std::max(moved(y1, old_height, film.height), y0 + 1);
  return film;
}

FilmSettings scaled(const FilmSettings& film, double share) {
  const auto side = [&](int size) {
    return static_cast<int>(std::clamp(std::floor(size * share + 1e-9), 1., double{kMaxSide}));
  };
  return scaled(film, side(film.width), side(film.height));
}

}  // namespace dspm
