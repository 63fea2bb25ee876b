// Photometric files of lamp makers: the luminous intensity that a goniometer measured in many directions.
// ANSI/IES LM-63, all versions; type C photometry.
#pragma once

#include <string_view>
#include <vector>

namespace dspm {

/// Luminous intensities around a vertical axis.
struct Photometry {
  std::vector<float> vertical;    // degrees from straight down, ascending
  std::vector<float> horizontal;  // degrees around the axis, ascending; one: it is the same all around
  std::vector<float> candela;     // for each horizontal angle, the values of all vertical ones

  /// Interpolates linearly between the angles that were measured, mirrored if only a half or a quarter was; zero above
  /// and below the vertical ones.
  float intensity(float from_down, float around) const;
  bool is_symmetric() const { return horizontal.size() == 1; }
};

/// Tests a file as it is.
bool is_ies(std::string_view bytes);
/// Reads the plain_text() of a file. Throws std::runtime_error with a sentence that does not name the file.
Photometry parse_ies(std::string_view text);

}  // namespace dspm
