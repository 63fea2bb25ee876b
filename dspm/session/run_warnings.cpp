#include "dspm/session/run_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dspm/math/frames.h"
#include "dspm/params/params.h"
#include "dspm/system/readable.h"

namespace dspm {
namespace {

constexpr double kFewPhotons = 30;  // their sum is off by a fifth
constexpr double kWideRadius = 20;  // in pixels
constexpr double kMuchFlux = 0.05;  // of what is emitted
// The power of the iterations by which a radius may shrink: 0.15 at alpha 0.7.
constexpr double kFastestShrinking = 0.25;

double share_too_deep(const Statistics& statistics) {
  EnergyBalance sum;
  for (const EnergyBalance& energy : statistics.energy) sum += energy;
  return sum.emitted > 0 ? sum.too_deep / sum.emitted : 0;
}

/// Of the ways to more photons, those that the scene does not go yet.
std::string hint_for_photons(const ParamList& params) {
  const auto says = [&](const char* name, const char* value) {
    const Param* param = params.find(name);
    const auto* texts = param != nullptr ? std::get_if<std::vector<std::string>>(&param->values) : nullptr;
    return texts != nullptr && !texts->empty() && texts->front() == value;
  };
  std::string hint = "give the integrator more \"integer photons\"";
  if (says("emission", "power")) hint += ", \"string emission\" \"guided\"";
  if (says("direct", "photons")) hint += ", \"string direct\" \"both\"";
  return hint + ", or more iterations";
}

}  // namespace

void RunWarnings::warn_once(const std::string& what, const std::string& message, const std::string& hint) {
  if (warned_.insert(what).second) messages_.warn(message, hint);
}

void RunWarnings::look(const Statistics& statistics, int all) {
  if (statistics.iterations < kFirstLook) return;
  const std::string after = counted(static_cast<std::size_t>(statistics.iterations), "iteration");
  if (const double share = share_too_deep(statistics); share > kMuchFlux)
    warn_once(
        "depth",
        fmt::format("the maximum depth cuts off {:.0f}% of the photons' flux: that light is missing in the images",
                    100 * share),
        "raise the integrator's \"integer maxdepth\"");
  if (all < kMoreThanAPreview) return;
  const double still = std::max(1.0, static_cast<double>(all) / statistics.iterations);
  if (const double photons = statistics.typical.photons; photons > 0 && photons * still < kFewPhotons)
    warn_once(
        "photons",
        fmt::format("{} have found {:.2g} photons at the typical point that the camera sees: what only they light is "
                    "grainy until there are {:.0f} or more",
                    after, photons, kFewPhotons),
        hint_for_photons(job_.params));
  if (const double radius = statistics.typical.radius_in_pixels;
      radius * std::pow(still, -kFastestShrinking) > kWideRadius)
    warn_once(
        "radius",
        fmt::format("after {} photons are still gathered within {:.0f} pixels: what is finer than that is blurred",
                    after, radius),
        "leave out the integrator's \"float radius\", then it begins at four pixels, or give a smaller one");
}

void RunWarnings::look_at_errors(const Statistics& statistics, const std::vector<FileFrame>& frames) {
  for (std::size_t j = 0; j < statistics.errors.size(); ++j) {
    if (statistics.errors[j] > 0) continue;
    const std::string& variation = job_.variation(frames[j]);
    warn_once(
        "error",
        fmt::format("{} shows nothing of which an error could be estimated: it is black, or all of it is constant",
                    variation.empty() ? fmt::format("frame {}", job_.moment(frames[j]).number())
                                      : job_.description->frames.label(frames[j])),
        "--until-error does not wait for it");
  }
}

}  // namespace dspm
