// Photon paths that are traced to learn where the others should start, in rounds.
#pragma once

#include <cstdint>
#include <vector>

#include "dspm/base/grid/buffer.h"
#include "dspm/integrators/emission_report.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// A pilot path that was found. `squares` is the sum of the squares of what it adds to pixels and frames.
struct FoundPath {
  std::size_t choice;  // of its frames
  EmissionStart start;
  double squares;
  std::uint32_t place = 0;  // among those of its round, choice and light
  double mixture = 0;       // the sum of the densities of its start in all rounds so far
};

struct PilotRound {
  EmissionGuides guides;  // the guides with which its paths were drawn
  Buffer<FoundPath> found;
  std::vector<std::uint32_t> found_of;  // how many, by choice and light
  std::uint64_t number = 0, paths = 0;  // paths: of each choice
  std::uint64_t choices = 1, work = 0;  // work: rays and photons
  std::size_t alike = 1;                // of the first of rounds that have the same guides: how many these are

  std::uint64_t all_paths() const { return paths * choices; }

  double found_share() const { return static_cast<double>(found.size()) / static_cast<double>(all_paths()); }
  /// Returns the share of the variance of what the paths bring that is due to the path with most of it. If it is large,
  /// the variance is not known.
  double share_of_one() const;
  double cost() const { return static_cast<double>(work) / static_cast<double>(all_paths()); }
};

/// The figures of learning, and the paths of a round of which a hit point finds a photon.
struct PilotPaths {
  std::uint64_t rounds = 0, of_a_round = 0, found_first = 0;  // the first round does without a guide
  std::vector<std::uint64_t> started, found;                  // by light, in a round that starts paths as the run does
  double gain = 0;                                            // see EmissionReport
  std::size_t bytes = 0;                                      // at most

  /// Counts this round as one that starts paths as the run does.
  void count(const PilotRound& round, const Scene& scene, const PhotonSettings& photon);
};

/// Returns the report of a run with these guides. `guided` says whether it was to have one, if it pays.
EmissionReport report_of(const PilotPaths& pilot, const Scene& scene, const PhotonSettings& photon,
                         const EmissionGuides& guides, bool guided);

}  // namespace dspm
