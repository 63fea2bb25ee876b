// Reports where photon paths start, and how many of them hit points find: what pilot paths learned, for --stats and
// --explain.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dspm/base/system/state_stream.h"

namespace dspm {

class Scene;

/// The name, in reports, of paths that count only if they bring more than direct light.
inline constexpr const char* kLightPaths = "light paths";

/// The light that an integrator's photons bring; camera paths find the rest.
enum class PhotonsBring : std::uint8_t { all, caustics, nothing };

/// Reports on one kind of an integrator's photons. What was found is a sample of the pilot paths, by pilot pixels of
/// the whole image, in a few frames of the file.
struct EmissionReport {
  enum class Start : std::uint8_t { asked_by_power, guided, guide_would_not_pay, needs_none };
  /// One light, or all lights that are not listed.
  struct OfLight {
    std::string name;
    double by_power = 0, share = 0;        // of the paths: without "photons" and guide; as they start in this run
    std::uint64_t started = 0, found = 0;  // pilot paths
  };

  std::string photons;  // which of the integrator's: "photons", "caustic photons"
  Start start = Start::asked_by_power;
  std::uint64_t rounds = 0, paths = 0;         // of pilot paths; in a round
  std::uint64_t found_without = 0, found = 0;  // of a round's paths: without a guide; as they start in this run
  std::uint64_t cells = 0;                     // of the guide
  PhotonsBring bring = PhotonsBring::all;
  std::int64_t traced = 0;                     // paths in an iteration; 0: as many as were asked for
  double gain = 0;                             // the time to the same variance without the guide, over that with it
  std::vector<OfLight> lights;                 // where most paths start, then the others as one

  double share_found() const { return paths > 0 ? static_cast<double>(found) / static_cast<double>(paths) : 0; }

  /// Adds the lights with their shares of the run's paths, and with their pilot paths, `started` and `found`.
  void add_lights(const Scene& scene, const std::vector<double>& shares, const std::vector<std::uint64_t>& started,
                  const std::vector<std::uint64_t>& found);
  void persist(StateStream& state);
};

/// The reports of an integrator, one for each kind of photons.
class EmissionReports {
 public:
  /// Replaces the report of the same kind of photons.
  void put(const EmissionReport& report);
  void persist(StateStream& state);
  auto begin() const { return reports_.begin(); }
  auto end() const { return reports_.end(); }

 private:
  std::vector<EmissionReport> reports_;
};

/// Returns the line of the log that says how many paths are found, by light.
std::string summary_of(const EmissionReport& report);
/// Returns the sentences of --explain: what was learned, or why nothing was, then one for each light.
std::vector<std::string> in_words(const EmissionReport& report);

}  // namespace dspm
