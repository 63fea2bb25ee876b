#include "dspm/output/not_finite.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/readable.h"
#include "dspm/image/image.h"
#include "dspm/session/modules/all_plugins.h"
#include "dspm/textures/watched_texture.h"

namespace dspm {
namespace {

std::string pixel_in_words(int pixel, const PixelRect& crop) {
  return fmt::format("x = {}, y = {}", crop.x0 + pixel % crop.width(), crop.y0 + pixel / crop.width());
}

std::string kind_of(const SceneElement& element, const Job& job) {
  switch (element.kind) {
    case SceneElement::Kind::camera: return "camera";
    case SceneElement::Kind::shape: return "shape";
    case SceneElement::Kind::material: return "material";
    case SceneElement::Kind::medium: return "medium";
    case SceneElement::Kind::light: break;
  }
  const bool directive = element.index < static_cast<int>(job.description->lights.size());
  return directive ? "light" : "area light";
}

}  // namespace

void report_rejections(const Rejections& rejections, const World& world, const FrameList& interval, const Job& job,
                       Messages& messages) {
  Diagnostics diagnostics;
  for (const TextureFault& fault : take_texture_faults())
    messages.warn(fmt::format("{}{} gave values that are not finite, or negative colours; 0 stands in for them",
                              fault.place, in_words("texture", fault.type)));
  for (const Rejections::Entry& entry : rejections.entries()) {
    const PluginUse& use = world.use_of(entry.element, interval, entry.frame);
    const std::string place = entry.pixel == Rejections::kNoPixel
                                  ? "to a photon"
                                  : fmt::format("at pixel {}", pixel_in_words(entry.pixel, job.settings.crop));
    diagnostics.warning(
        use.where,
        fmt::format("{} gave values that are negative or not finite, first {} of frame {}; they are left out",
                    in_words(kind_of(entry.element, job), use.type), place,
                    interval[static_cast<std::size_t>(entry.frame)].index() + 1));
  }
  messages.show(diagnostics);
}

void black_out_invalid(Image& image, const OutputInfo& output, FileFrame frame, const Job& job, Messages& messages) {
  // By wavelength, colours outside Rec. 709 are negative until they are developed.
  const bool is_light = !job.settings.spectral && (output.is_radiance || output.name == kRadiance);
  const auto invalid = [&](const Rgb& c) { return !is_finite(c) || (is_light && (c.r < 0 || c.g < 0 || c.b < 0)); };
  const auto first = std::find_if(image.pixels.begin(), image.pixels.end(), invalid);
  if (first == image.pixels.end()) return;
  const auto at = static_cast<int>(first - image.pixels.begin());
  const auto count = std::count_if(first, image.pixels.end(), invalid);
  std::replace_if(first, image.pixels.end(), invalid, Rgb(0));
  messages.warn(
      fmt::format("{}: {} of frame {} has {} that cannot be shown ({}NaN or infinite), the first at {}; written "
                  "as black",
                  in_words("integrator", job.integrator), output.name, frame.index() + 1,
                  counted(static_cast<std::size_t>(count), "pixel"), is_light ? "negative, " : "",
                  pixel_in_words(at, job.settings.crop)));
}

}  // namespace dspm
