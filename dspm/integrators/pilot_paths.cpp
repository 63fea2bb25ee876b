#include "dspm/integrators/pilot_paths.h"

#include <numeric>

#include "dspm/math/rng.h"

namespace dspm {

void PilotPaths::count(const PilotRound& round, const Scene& scene, const PhotonSettings& photon) {
  started.assign(scene.lights.size(), 0), found.assign(scene.lights.size(), 0);
  for (std::size_t choice = 0; choice < scene.light_choices.size(); ++choice) {
    if (scene.light_choices[choice].frames.empty()) continue;
    for (std::uint64_t path = 0; path < round.paths; ++path) {
      const EmissionStart start =
          start_of(&round.guides, scene, choice, PathRandom(photon.seed, photon.stream, path, round.number));
      if (start.density > 0) ++started[static_cast<std::size_t>(start.light)];
    }
  }
  for (const FoundPath& path : round.found) ++found[static_cast<std::size_t>(path.start.light)];
}

EmissionReport report_of(const PilotPaths& pilot, const Scene& scene, const PhotonSettings& photon,
                         const EmissionGuides& guides, bool guided) {
  using Start = EmissionReport::Start;
  EmissionReport report;
  report.photons = photon.stream == Stream::caustic_photon ? "caustic photons" : "photons";
  report.start = !guided ? Start::asked_by_power : guides.are_off() ? Start::guide_would_not_pay : Start::guided;
  report.rounds = pilot.rounds, report.paths = pilot.of_a_round, report.cells = guides.cell_count();
  report.found_without = pilot.found_first, report.gain = pilot.gain;
  report.found = std::accumulate(pilot.found.begin(), pilot.found.end(), std::uint64_t{0});
  report.add_lights(scene, guides, pilot.started, pilot.found);
  return report;
}

}  // namespace dspm
