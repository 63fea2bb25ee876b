#include "dspm/image/ocio_view.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/image/encoding.h"

#ifdef DSPM_OCIO
#include <OpenColorIO/OpenColorIO.h>

#include "dspm/base/system/file_access.h"
#endif

namespace dspm {

#ifdef DSPM_OCIO

namespace {

/// The names of linear Rec. 709 in a configuration that has no role aces_interchange.
constexpr const char* kRec709Names[] = {
    "lin_rec709",     "Linear Rec.709 (sRGB)", "lin_srgb", "Utility - Linear - sRGB",
    "Linear Rec.709", "Linear BT.709",         "Linear"};

ColourMatrix aces_from_rec709() {
  const Chromaticities &aces = chromaticities(ColourSpace::aces2065_1), &rec709 = chromaticities(ColourSpace::srgb);
  return rgb_from_xyz(aces) * (adaptation(rec709.white, aces.white) * xyz_from_rgb(rec709));
}

OCIO_NAMESPACE::ConstConfigRcPtr configuration() {
  const char* file = std::getenv("OCIO");
  if (file == nullptr || *file == '\0')
    throw std::runtime_error("the environment variable OCIO must name a configuration (config.ocio)");
  expect_allowed(file);
  return OCIO_NAMESPACE::Config::CreateFromFile(file);
}

/// Goes by way of the space that the configuration works in: a view of data shows its numbers.
OCIO_NAMESPACE::ConstTransformRcPtr steps(const OCIO_NAMESPACE::Config& config, const std::string& from,
                                          const std::string& display, const std::string& view) {
  namespace ocio = OCIO_NAMESPACE;
  const std::string working = config.hasRole(ocio::ROLE_SCENE_LINEAR) ? ocio::ROLE_SCENE_LINEAR : from;
  const std::string on = display.empty() ? config.getDefaultDisplay() : display;
  const ocio::ColorSpaceTransformRcPtr enter = ocio::ColorSpaceTransform::Create();
  enter->setSrc(from.c_str());
  enter->setDst(working.c_str());
  const ocio::DisplayViewTransformRcPtr show = ocio::DisplayViewTransform::Create();
  show->setSrc(working.c_str());
  show->setDisplay(on.c_str());
  show->setView(view.empty() ? config.getDefaultView(on.c_str()) : view.c_str());
  const ocio::GroupTransformRcPtr both = ocio::GroupTransform::Create();
  both->appendTransform(enter);
  both->appendTransform(show);
  return both;
}

}  // namespace

struct OcioView::Processor {
  OCIO_NAMESPACE::ConstCPUProcessorRcPtr cpu;
  bool takes_aces = false;
};

OcioView::OcioView(const std::string& display, const std::string& view) : processor_(std::make_unique<Processor>()) {
  namespace ocio = OCIO_NAMESPACE;
  try {
    const ocio::ConstConfigRcPtr config = configuration();
    std::string from = ocio::ROLE_INTERCHANGE_SCENE;
    processor_->takes_aces = config->hasRole(from.c_str());
    if (!processor_->takes_aces) {
      from = ocio::ROLE_SCENE_LINEAR;
      for (const char* name : kRec709Names)
        if (config->getColorSpace(name) != nullptr && from == ocio::ROLE_SCENE_LINEAR) from = name;
    }
    processor_->cpu = config->getProcessor(steps(*config, from, display, view))->getDefaultCPUProcessor();
  } catch (const ocio::Exception& error) {
    throw std::runtime_error(std::string("OpenColorIO: ") + error.what());
  }
}

void OcioView::apply(Image& image) const {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  if (processor_->takes_aces) {
    const ColourMatrix matrix = aces_from_rec709();
    for (Rgb& pixel : image.pixels) pixel = matrix * pixel;
  }
  OCIO_NAMESPACE::PackedImageDesc pixels(image.pixels.data(), image.width, image.height, 3);
  processor_->cpu->apply(pixels);
  for (Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) pixel[c] = pixel[c] > 0 ? srgb_to_linear(std::min(pixel[c], 1.f)) : 0.f;
}

bool knows_ocio() { return true; }

#else

bool knows_ocio() { return false; }

struct OcioView::Processor {};

OcioView::OcioView(const std::string&, const std::string&) {
  throw std::runtime_error(
      "this dspm was built without OpenColorIO: install libopencolorio-dev and build with -DDSPM_OCIO=ON");
}

void OcioView::apply(Image&) const {}

#endif

OcioView::~OcioView() = default;

}  // namespace dspm
