// The settings that say how outputs besides radiance are kept: as layers of the image's file or in files of their own,
// and how precisely.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dspm/image/exr.h"
#include "dspm/image/film/film.h"
#include "dspm/integrators/output_info.h"

namespace dspm {

/// The header's text with all outputs of light groups, if the file has them.
inline constexpr const char* kLightGroupsText = "light groups";

/// The header's number that says, by 1, that colours are multiplied by the alpha and nothing else is behind it.
inline constexpr const char* kTransparentNumber = "transparent";

struct LayerSettings {
  bool aov_files = false;                         // a file for each output
  ExrFormat exr;                                  // of all EXR files
  std::vector<std::string> halves, singles = {};  // outputs of another precision than usual

  /// Sets the compression by its name. Throws UsageError.
  void compress(const std::string& name);
  /// Throws UsageError if they do not fit these outputs.
  void check(const std::vector<std::string>& outputs) const;
  /// Returns the precision of an output. Ids are single, whatever is asked for: as halves they would be different ids.
  ExrPixels pixels_of(const OutputInfo& output, const FilmSettings& film) const;
};

/// Returns the label of an output's file: what comes before the first dot of its name. Outputs with the same label
/// share a file of their own.
std::string_view file_label(std::string_view output);
/// Returns the labels of all outputs, in order.
std::vector<std::string> file_labels(const std::vector<std::string>& outputs);

}  // namespace dspm
