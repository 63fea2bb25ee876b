// A view of OpenColorIO's configuration. ocio_view.cpp is the only place that knows the library.
#pragma once

#include <memory>
#include <string>

#include "dspm/image/image.h"

namespace dspm {

/// Returns whether dspm was built with the library.
bool knows_ocio();

class OcioView {
 public:
  /// Makes a view of the configuration that the environment variable OCIO names. Empty names mean the configuration's
  /// own defaults. Throws std::runtime_error if dspm was built without the library, or if there is no such
  /// configuration or view.
  OcioView(const std::string& display, const std::string& view);
  ~OcioView();

  /// Takes linear Rec. 709 to linear light of an sRGB screen: encoded as sRGB, the pixels are the numbers that the view
  /// gives. Outside 0..1 they are clamped.
  void apply(Image& image) const;

 private:
  struct Processor;
  std::unique_ptr<Processor> processor_;
};

}  // namespace dspm
