// The parameters of the Film directive as plain settings, and the arithmetic that follows from them.
//   Film "rgb" "integer xresolution" 512 "integer yresolution" 512 "string filename" "water.exr"
// film.cpp reads the parameters, read_sensor.cpp those of the sensor.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/sensor.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/image/film/pixel_rect.h"

namespace dspm {

struct FilmSettings {
  int width = 1280, height = 720;                   // of the full image
  std::string filename = "pbrt.exr";                // see is_image_name(); frames are numbered, see image_name.h
  std::optional<std::array<float, 4>> crop_window;  // x0 x1 y0 y1 in 0..1; takes precedence over pixel_bounds
  std::optional<std::array<int, 4>> pixel_bounds;   // x0 x1 y0 y1
  float diagonal = 0.035f;                          // of the film, in metres
  float iso = 100;
  float white_kelvin = 0;                 // this daylight becomes white; 0: as it is
  ColourSpace space = ColourSpace::srgb;  // of EXR files
  float max_component = kInfinity;
  bool save_half = true;                           // else single precision
  bool surface_outputs = false;                    // next to radiance, what the camera sees first
  bool transparent = false;                        // with alpha, and without what lies behind all surfaces
  bool in_camera_space = false;                    // positions and normals among them; else in world space
  bool spectral = false;                           // paths carry wavelengths, unless Option "colour" says otherwise
  std::shared_ptr<const Sensor> sensor = nullptr;  // of spectral renders; null: the observer of 1931
};

/// What image files may be, by their extensions, in words.
inline constexpr std::string_view kImageNames = ".exr, .png, .webp, .pfm or .hdr";
bool is_image_name(const std::string& filename);

/// Returns the pixels to render, with pbrt's rounding; empty if nothing of the image is left.
PixelRect crop_of(const FilmSettings& film);
/// Returns the same picture in another resolution: pixel bounds are scaled, too. A side has at least one pixel and at
/// most 65536.
FilmSettings scaled(FilmSettings film, int width, int height);
FilmSettings scaled(const FilmSettings& film, double share);

/// Returns the values of the image file over radiance, for a shutter that is open that long (pbrt's imaging ratio).
inline float imaging_ratio(const FilmSettings& film, float exposure_seconds) {
  return exposure_seconds * film.iso / 100;
}

/// Returns the matrix for colours in Rec. 709; nullopt if they stay as they are.
std::optional<ColourMatrix> white_balance(const FilmSettings& film);
/// Returns the matrix from Rec. 709 to the film's colour space; nullopt if they are the same.
std::optional<ColourMatrix> to_film_space(const FilmSettings& film);

/// Scales a colour down until its largest component is at most `limit`; the hue stays.
inline Rgb limited(const Rgb& color, float limit) {
  const float largest = max_component(color);
  return largest > limit ? color * (limit / largest) : color;
}

using MakeFilm = std::unique_ptr<FilmSettings>(ParamReader&);
PluginTable<Plugin<MakeFilm>>& film_plugins();

}  // namespace dspm
