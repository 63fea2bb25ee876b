#include "dspm/integrators/guiding/pilot_paths.h"

#include <algorithm>
#include <numeric>

#include "dspm/base/math/rng.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

constexpr std::int64_t kGrain = 1 << 8;

}  // namespace

double PilotRound::share_of_one() const {
  double most = 0, sum = 0;
  for (const FoundPath& path : found) most = std::max(most, path.squares), sum += path.squares;
  return sum > 0 ? most / sum : 0;
}

void PilotPaths::count(const PilotRound& round, const Scene& scene, const PhotonSettings& photon) {
  started.assign(scene.lights.size(), 0), found.assign(scene.lights.size(), 0);
  for (std::size_t choice = 0; choice < scene.light_choices.size(); ++choice) {
    if (scene.light_choices[choice].frames.empty()) continue;
    std::vector<int> light(round.paths);
    parallel_for(static_cast<std::int64_t>(round.paths), kGrain, [&](std::int64_t i) {
      const auto path = static_cast<std::uint64_t>(i);
      const EmissionStart start =
          start_of(&round.guides, scene, choice, numbers_of(photon, path, round.number));
      light[path] = start.density > 0 ? start.light : -1;
    });
    for (const int of : light)
      if (of >= 0) ++started[static_cast<std::size_t>(of)];
  }
  for (const FoundPath& path : round.found) ++found[static_cast<std::size_t>(path.start.light)];
}

EmissionReport report_of(const PilotPaths& pilot, const Scene& scene, const PhotonSettings& photon,
                         const EmissionGuides& guides, bool guided) {
  using Start = EmissionReport::Start;
  EmissionReport report;
  report.photons = photon.are_light_paths                    ? kLightPaths
                   : photon.stream == Stream::caustic_photon ? "caustic photons"
                                                             : "photons";
  report.start = !guided ? Start::asked_by_power : guides.are_off() ? Start::guide_would_not_pay : Start::guided;
  report.rounds = pilot.rounds, report.paths = pilot.of_a_round, report.cells = guides.cell_count();
  report.found_without = pilot.found_first, report.gain = pilot.gain;
  report.found = std::accumulate(pilot.found.begin(), pilot.found.end(), std::uint64_t{0});
  report.add_lights(scene, light_shares(guides, scene), pilot.started, pilot.found);
  return report;
}

}  // namespace dspm
