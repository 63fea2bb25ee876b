// Turns radiance into what a screen can show. docs/looking.md describes the views.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/image/ocio_view.h"
#include "dspm/image/png.h"
#include "dspm/output/view_curve.h"

namespace dspm {

/// What the user asks for.
struct ViewSettings {
  std::string view;                    // see view_names(); "ocio" and "ocio:DISPLAY/VIEW", too; empty: the usual one
  double stops = 0;                    // of exposure
  int png_bits = 8;                    // or 16
  bool display_p3 = false;             // PNGs, else sRGB
  std::optional<Rgb> background = {};  // stands behind everything: linear light of an sRGB screen; none: nothing does
};

/// "white", "black" or "#rrggbb". Throws std::runtime_error.
Rgb parse_background(const std::string& text);

/// Where radiance has an alpha, its colours are multiplied by it, as in EXR files.
class View {
 public:
  explicit View(ViewCurve curve = ViewCurve::standard, float gain = 1, PngFormat format = {})
      : curve_(curve), gain_(gain), format_(format) {}
  /// Throws std::runtime_error if there is no such view.
  explicit View(const ViewSettings& settings);

  /// Linear light of a screen, in 0..1: ready to be shrunk and encoded. NaN and negative values become black. Over the
  /// background; without one, what is transparent adds its light to black.
  Image shown(Image radiance) const;
  /// For files that hold transparency: with alpha, and colours not multiplied by it; shown() if there is a background.
  Image cut_out(Image radiance) const;
  /// What cut_out() gives, over the background or black.
  Image flattened(Image cut_out) const;
  /// Of the PNGs that hold what is shown.
  const PngFormat& png() const { return format_; }
  /// Returns the same view in the space of videos, which is sRGB.
  View for_video() const;

 private:
  void apply(std::vector<Rgb>& radiance) const;
  Image with_alpha(Image radiance) const;

  ViewCurve curve_;
  float gain_;
  PngFormat format_;
  std::optional<Rgb> background_ = {};
  std::shared_ptr<const OcioView> ocio_;  // takes the place of the curve
};

std::vector<std::string> view_names();

}  // namespace dspm
