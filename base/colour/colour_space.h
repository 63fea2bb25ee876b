// The RGB colour spaces that scene files may speak in. dspm computes in linear Rec. 709, the primaries of sRGB.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectral_curve.h"

namespace dspm {

enum class ColourSpace { srgb, rec2020, aces2065_1, dci_p3 };

/// Converts pbrt's words (srgb, rec2020, aces2065-1, dci-p3) and back; the white of dci-p3 is D65.
std::optional<ColourSpace> colour_space(std::string_view word);
std::string_view word_of(ColourSpace space);
std::vector<std::string> colour_space_words();

/// CIE x and y.
struct Chromaticity {
  double x = 0, y = 0;
};
struct Chromaticities {
  Chromaticity red, green, blue, white;
};
const Chromaticities& chromaticities(ColourSpace space);

/// Maps linear colours, as columns, from one space to another.
using ColourMatrix = std::array<std::array<double, 3>, 3>;
ColourMatrix operator*(const ColourMatrix& a, const ColourMatrix& b);
Rgb operator*(const ColourMatrix& m, const Rgb& c);

/// Returns the matrix that gives the space's white a Y of 1.
ColourMatrix xyz_from_rgb(const Chromaticities& space);
ColourMatrix rgb_from_xyz(const Chromaticities& space);
/// Returns the matrix in XYZ that makes colours look under one white as they did under the other. [Bradford's variant
/// of von Kries's adaptation, ICC specification, annex E]
ColourMatrix adaptation(const Chromaticity& from, const Chromaticity& to);

/// Returns daylight of this correlated colour temperature in kelvin [CIE 15], or black-body light below 4000. As in
/// pbrt, the names of daylights are of 1931, when the second radiation constant was 1.438.
Chromaticity white_of(double kelvin);

/// Converts a colour of `space` to Rec. 709. Components are negative if it lies outside, see to_rec709().
Rgb beyond_rec709(const Rgb& c, ColourSpace space, SpectrumRole role);
/// Converts a colour of `space` to Rec. 709 and clamps it to what is never negative. An albedo of 1 stays 1, as white
/// as the light; light keeps its chromaticity and luminance, so the white of aces2065-1 is a little yellow.
Rgb to_rec709(const Rgb& c, ColourSpace space, SpectrumRole role);

}  // namespace dspm
