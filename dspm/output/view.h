// From radiance to what a screen can show. docs/looking.md describes the views.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/image/ocio_view.h"
#include "dspm/image/png.h"

namespace dspm {

enum class ViewCurve {
  standard,  // each component clipped at 1, as pbrt does
  filmic,    // Hable 2010
  agx,       // Sobotka's AgX
  raw        // the numbers themselves, clipped and never encoded
};

/// What the user asks for.
struct ViewSettings {
  std::string view;         // see view_names(); "ocio" and "ocio:DISPLAY/VIEW", too; empty: the usual one
  double stops = 0;         // of exposure
  int png_bits = 8;         // or 16
  bool display_p3 = false;  // PNGs, else sRGB
};

class View {
 public:
  explicit View(ViewCurve curve = ViewCurve::standard, float gain = 1, PngFormat format = {})
      : curve_(curve), gain_(gain), format_(format) {}
  /// Throws std::runtime_error if there is no such view.
  explicit View(const ViewSettings& settings);

  /// Linear light of a screen, in 0..1: ready to be shrunk and encoded. NaN and negative values become black.
  Image shown(Image radiance) const;
  /// Of the PNGs that hold what is shown.
  const PngFormat& png() const { return format_; }
  /// The same in the space of videos, which is sRGB.
  View for_video() const;

 private:
  ViewCurve curve_;
  float gain_;
  PngFormat format_;
  std::shared_ptr<const OcioView> ocio_;  // takes the place of the curve
};

/// By the curve alone, in Rec. 709.
Rgb curved(ViewCurve curve, const Rgb& radiance);

inline constexpr ViewCurve kUsualView = ViewCurve::agx;
std::vector<std::string> view_names();

}  // namespace dspm
