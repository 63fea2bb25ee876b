// The RGB colour spaces that scene files may speak in. dspm computes in linear Rec. 709, the primaries of sRGB.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/colour/spectrum.h"

namespace dspm {

enum class ColourSpace { srgb, rec2020, aces2065_1, dci_p3 };

/// pbrt's words: srgb, rec2020, aces2065-1, dci-p3 (whose white is D65), and back.
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

/// Takes linear colours, as columns, to others.
using ColourMatrix = std::array<std::array<double, 3>, 3>;
ColourMatrix operator*(const ColourMatrix& a, const ColourMatrix& b);
Rgb operator*(const ColourMatrix& m, const Rgb& c);

/// Y of white is 1.
ColourMatrix xyz_from_rgb(const Chromaticities& space);
ColourMatrix rgb_from_xyz(const Chromaticities& space);
/// In XYZ: colours under one white look as they did under the other. [Bradford's variant of von Kries's adaptation, ICC
/// specification, annex E]
ColourMatrix adaptation(const Chromaticity& from, const Chromaticity& to);

/// Daylight of that correlated colour temperature in kelvin, [CIE 15] which below 4000 is that of a black body; as in
/// pbrt, the names of daylights are of 1931, when the second radiation constant was 1.438.
Chromaticity white_of(double kelvin);

/// A colour of `space` in Rec. 709, never negative: colours outside are clamped to it. An albedo of 1 stays 1, as white
/// as the light; light keeps its chromaticity and luminance, so the white of aces2065-1 is a little yellow.
Rgb to_rec709(const Rgb& c, ColourSpace space, SpectrumRole role);

}  // namespace dspm
