#include "dspm/session/run_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "dspm/base/math/median.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/readable.h"
#include "dspm/integrators/beside/error_estimate.h"
#include "dspm/integrators/methods/cut_light.h"

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

/// The part of the picture where the maximum depth cuts off light that camera paths would find.
struct CutPart {
  double picture = 0;  // share of the pixels
  double lost = 0;     // of their light
  int x = 0, y = 0;    // in the middle of where most is lost, in pixels of the full image
};

/// Returns the share of a region's light that is cut off, by the half of the sample in which it is smaller. `faint` is
/// luminance that is added to the region's.
double share_cut(const CutLight& region, float faint) {
  const auto of_half = [&](std::size_t half) {
    const float all = region.arrived[half] + region.cut[half] + faint;
    return all > 0 ? static_cast<double>(region.cut[half] / all) : 0;
  };
  return std::min(of_half(0), of_half(1));
}

double sum(const std::array<float, 2>& halves) { return static_cast<double>(halves[0] + halves[1]); }

/// Returns the regions that lack more than a share of `least`, in the frame that the cut changes most. Dark corners,
/// which are lit after many scatterings, lack a larger share of their light than anybody sees: so every region counts
/// as brighter by half of the median.
CutPart part_cut(const std::vector<CutLight>& regions, const PixelRect& crop, double least) {
  constexpr float kFaint = 0.5f;
  const int count = region_count(crop);
  const std::size_t frames = count > 0 ? regions.size() / static_cast<std::size_t>(count) : 0;
  CutPart worst;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const auto sums_of = [&](int r) { return regions[static_cast<std::size_t>(r) * frames + frame]; };
    std::vector<float> sums;
    for (int r = 0; r < count; ++r) sums.push_back(static_cast<float>(sum(sums_of(r).arrived) + sum(sums_of(r).cut)));
    const float faint = kFaint * median(sums) / 2;
    CutPart part;
    double cut = 0, all = 0, most = 0;
    for (int r = 0; r < count; ++r) {
      const double share = share_cut(sums_of(r), faint);
      if (share <= least) continue;
      const PixelRect pixels = region(crop, r);
      part.picture += static_cast<double>(pixels.count()) / crop.count();
      cut += sum(sums_of(r).cut), all += sum(sums_of(r).cut) + sum(sums_of(r).arrived);
      if (share <= most) continue;
      most = share, part.x = (pixels.x0 + pixels.x1) / 2, part.y = (pixels.y0 + pixels.y1) / 2;
    }
    part.lost = all > 0 ? cut / all : 0;
    if (part.picture * part.lost > worst.picture * worst.lost) worst = part;
  }
  return worst;
}

/// Returns the part if much of the picture lacks some light, or a small part of it lacks much; otherwise nullopt.
std::optional<CutPart> visible_cut(const std::vector<CutLight>& regions, const PixelRect& crop) {
  struct Rule {
    double lost, picture;
  };
  for (const Rule& rule : {Rule{0.05, 0.08}, Rule{0.12, 0.0075}})  // the last: two regions of 256
    if (const CutPart part = part_cut(regions, crop, rule.lost); part.picture >= rule.picture) return part;
  return std::nullopt;
}

std::uint64_t lone_paths(const Statistics& statistics) {
  for (const Counters::Entry& counter : statistics.counters)
    if (counter.name == kLonePaths) return counter.value;
  return 0;
}

bool says(const ParamList& params, const char* name, const char* value) {
  const Param* param = params.find(name);
  const auto* texts = param != nullptr ? std::get_if<std::vector<std::string>>(&param->values) : nullptr;
  return texts != nullptr && !texts->empty() && texts->front() == value;
}

/// Returns the ways to more photons that the scene does not use yet.
std::string hint_for_photons(const ParamList& params) {
  std::string hint = "give the integrator more \"integer photons\"";
  if (says(params, "emission", "power")) hint += ", \"string emission\" \"guided\"";
  if (says(params, "direct", "photons")) hint += ", \"string direct\" \"both\"";
  return hint + ", or more iterations";
}

/// Returns a hint for lone photons, against which more iterations do not help soon: they bring as many new specks.
std::string hint_for_lone_photons(const ParamList& params) {
  std::string hint = "give the integrator several times as many \"integer photons\"";
  if (says(params, "emission", "power")) hint += ", or \"string emission\" \"guided\"";
  if (!says(params, "direct", "sampled")) hint += ", or \"string direct\" \"sampled\"";
  if (!says(params, "indirect", "paths")) hint += ", or \"string indirect\" \"paths\"";
  return hint;
}

}  // namespace

void RunWarnings::warn_once(const std::string& what, const std::string& message, const std::string& hint) {
  if (warned_.insert(what).second) messages_.warn(message, hint);
}

void RunWarnings::look(const Statistics& statistics, int all) {
  if (!statistics.why_off_gpu.empty())
    warn_once("gpu", fmt::format("{}; the rest of the run takes the CPU", statistics.why_off_gpu),
              "images are the same either way");
  if (statistics.iterations < kFirstLook) return;
  const std::string after = counted(static_cast<std::size_t>(statistics.iterations), "iteration");
  if (const auto cut = visible_cut(statistics.cut_light, job_.settings.crop))
    warn_once(
        "depth",
        fmt::format("the maximum depth cuts off about {:.0f}% of the light in {:.{}f}% of the picture, most around "
                    "pixel {}, {}: it is too dark there",
                    100 * cut->lost, 100 * cut->picture, cut->picture < 0.1 ? 1 : 0, cut->x, cut->y),
        "raise the integrator's \"integer maxdepth\", or give --maxdepth");
  else if (const double share = share_too_deep(statistics); share > kMuchFlux)
    warn_once(
        "depth",
        fmt::format("the maximum depth cuts off {:.0f}% of the photons' flux: that light is missing in the images",
                    100 * share),
        "raise the integrator's \"integer maxdepth\", or give --maxdepth");
  if (all < kMoreThanAPreview) return;
  if (statistics.iterations == all) look_at_lone_paths(statistics);
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

void RunWarnings::look_at_lone_paths(const Statistics& statistics) {
  const std::uint64_t parts = lone_paths(statistics);
  if (parts == 0) return;
  warn_once(
      "lone paths",
      fmt::format("in {} of the picture, single paths bring more light to a pixel than all others: these are bright "
                  "specks, of which the estimated error, that of half of the pixels, knows nothing",
                  counted(static_cast<std::size_t>(parts), "part")),
      statistics.energy.empty() ? "such light is found by photons: try \"dsppm\" or \"vcm\""
                                : hint_for_lone_photons(job_.params));
}

void RunWarnings::look_at_errors(const Statistics& statistics, const std::vector<FileFrame>& frames) {
  look_at_lone_paths(statistics);
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
