#include "dspm/integrators/guiding/learn_indirect.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "dspm/integrators/guiding/pilot_noise.h"
#include "dspm/integrators/photons/direct_balance.h"
#include "dspm/integrators/photons/shares_of_light.h"

namespace dspm {
namespace {

constexpr std::int64_t kLeastPilots = 1 << 11, kMostPilots = 1 << 13;  // of each kind: a tenth of an iteration
// Over the work of a camera path's ray: that of a photon's segment, with its place in the map, of a gather, and of a photon
// that it finds. Medians of eight scenes, by processor time.
constexpr double kWorkOfSegment = 1, kWorkOfGather = 0.25, kWorkOfFound = 0.01;
constexpr double kPixelsOfBlock = 64;          // see Noise
constexpr std::int64_t kFewestPhotons = 1000;  // that are worth a map

/// The variance of an iteration, relative to brightness. What camera paths find differs from pixel to pixel. Photons
/// serve all pixels within the radius, so their noise stays in blocks of pixels, which eyes, previews and denoisers see.
/// Both scales count alike.
struct Noise {
  double of_pixels = 0, of_photons = 0;

  double merit(double gathering_pixels) const {
    const double shared = gathering_pixels / (gathering_pixels + kPixelsOfBlock);
    return std::sqrt((of_pixels + of_photons) * (of_pixels / kPixelsOfBlock + of_photons * shared));
  }
};

/// An iteration of which `most` photon paths are the most that may be traced.
struct Ways {
  double pixels;  // of the whole image
  std::int64_t most;

  LightWay without_photons(double noise, const PilotSight& sight) const {
    const double merit = Noise{noise}.merit(0) * pixels * sight.rays;
    return {PhotonsBring::nothing, 0, std::isfinite(merit) ? merit : kInfinity};
  }

  LightWay with_photons(PhotonsBring bring, double noise, const PilotSight& sight, const PilotGathers& gathers,
                        std::int64_t photons) const {
    const auto count = static_cast<double>(photons);
    const double gathering = kPi * std::pow(NoisePilot::kLaterRadius * sight.radius_in_pixels, 2);
    const double work = pixels * (sight.rays + kWorkOfGather * sight.hit_points) +
                        count * (kWorkOfSegment * gathers.segments + kWorkOfFound * gathers.found);
    return {bring, photons, Noise{noise, gathers.variance / count}.merit(gathering) * work};
  }

  /// Returns the best of all, half, a quarter of the photons, and so on. If no pilot path is found, nothing is known of
  /// the photons' noise: they may then take as much time as camera paths.
  LightWay with_photons(PhotonsBring bring, double noise, const PilotSight& sight, const PilotGathers& gathers) const {
    LightWay best = with_photons(bring, noise, sight, gathers, most);
    for (std::int64_t photons = most / 2; photons >= kFewestPhotons; photons /= 2) {
      const bool is_known = gathers.variance > 0;
      if (!is_known && static_cast<double>(best.photons) * kWorkOfSegment * gathers.segments <= pixels * sight.rays)
        break;
      const LightWay way = with_photons(bring, noise, sight, gathers, photons);
      if (!is_known || way.merit < best.merit) best = way;
    }
    return best;
  }
};

}  // namespace

class LightWays::Pilot {
 public:
  Pilot(const Scene& scene, const RenderSettings& render, const PhotonSettings& photon,
        const HitPointSettings& hit_point, std::int64_t photons, PossibleCaustics caustics,
        const EmissionGuides& of_caustics)
      : scene_(scene),
        pilot_(scene, render, photon, hit_point, std::clamp(photons / 10, kLeastPilots, kMostPilots)),
        ways_{static_cast<double>(render.width) * render.height, photons} {
    const HitPointSettings goes_on = going_on(pilot_.hit_point());
    const PhotonSettings caustic = caustics_alone(pilot_.photon());
    const DirectBalance rays(scene, {.scatters = true});
    const bool any = caustics != PossibleCaustics::none;
    if (any)
      pilot_.weigh(goes_on, &rays, &caustic, of_caustics);
    else
      pilot_.weigh(finding_all(pilot_.hit_point()), nullptr, nullptr, {});
    const PilotSight all = pilot_.see(finding_all(pilot_.hit_point()), nullptr);
    const double alone = pilot_.noise_of(all);
    if (!any) {
      best_ = ways_.without_photons(alone, all);
      return;
    }
    const PilotSight going = pilot_.see(goes_on, &rays);
    const PilotGathers gathers = pilot_.gathers(going, caustic, of_caustics);
    best_ = ways_.with_photons(PhotonsBring::caustics, pilot_.noise_of(going), going, gathers);
    if (caustics == PossibleCaustics::only_by_photons) return;
    const LightWay without = ways_.without_photons(std::max(alone, pilot_.noise_of(going) + gathers.seen), all);
    if (without.merit <= best_.merit) best_ = without;
  }

  const LightWay& by_camera_paths() const { return best_; }

  LightWay by_photons(const EmissionGuides& guides, const LearnedDirect& direct, bool at_best) const {
    HitPointSettings hit_point = pilot_.hit_point();
    PhotonSettings photon = pilot_.photon();
    std::optional<DirectBalance> balance;
    if ((photon.kinds & kDirectPhotons) == 0) {
      balance.emplace(scene_, DirectWays{});
    } else if (direct.by_rays) {
      balance.emplace(scene_,
                      DirectWays{ways_.most, &guides, static_cast<float>(NoisePilot::kLaterRadius) * direct.radius,
                                 direct.photons_a_ray});
      photon.direct = &*balance;
    } else {
      hit_point.sample_direct = photon.rays_tell = false;
    }
    const PilotSight sight = pilot_.see(hit_point, balance ? &*balance : nullptr);
    PilotGathers gathers = pilot_.gathers(sight, photon, guides);
    if (at_best) gathers.variance *= gathers.found_share;
    return ways_.with_photons(PhotonsBring::all, pilot_.noise_of(sight), sight, gathers);
  }

 private:
  const Scene& scene_;
  NoisePilot pilot_;
  Ways ways_;
  LightWay best_;  // by camera paths
};

LightWays::LightWays(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                     const HitPointSettings& hit_point, std::int64_t photons, PossibleCaustics caustics,
                     const EmissionGuides& of_caustics)
    : pilot_(std::make_unique<Pilot>(sample, render, photon, hit_point, photons, caustics, of_caustics)) {}
LightWays::~LightWays() = default;

LightWay LightWays::by_camera_paths() const { return pilot_->by_camera_paths(); }
LightWay LightWays::by_photons(const EmissionGuides& guides, const LearnedDirect& direct) const {
  return pilot_->by_photons(guides, direct, false);
}
LightWay LightWays::by_photons_at_best(const LearnedDirect& direct) const {
  return pilot_->by_photons({}, direct, true);
}

}  // namespace dspm
