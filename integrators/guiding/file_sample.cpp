#include "dspm/integrators/guiding/file_sample.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "dspm/base/params/errors.h"

namespace dspm {
namespace {

constexpr std::size_t kMostLearned = 16, kMostText = 4096;
constexpr std::int32_t kMostLights = 1 << 28;

bool is_learned(const LearnedEmission& known) { return known.report.start != EmissionReport::Start::asked_by_power; }

void persist(LearnedEmission& known, StateStream& state) {
  state.value(known.lights);
  if (known.lights < 0 || known.lights > kMostLights) throw std::runtime_error("its number of lights is not possible");
  known.guides.persist(state, known.lights);
  known.direct.persist(state);
  state.value(known.bring);
  state.value(known.traced);
  if (known.bring > PhotonsBring::nothing || known.traced < 0)
    throw std::runtime_error("its record of how light is found is damaged");
  known.report.persist(state);
}

}  // namespace

bool FileSample::has_learned() const {
  for (const auto& [settings, known] : known_)
    if (is_learned(*known)) return true;
  return false;
}

std::shared_ptr<const LearnedEmission> FileSample::earlier(const std::string& settings, const Scene& scene) const {
  const auto found = known_.find(settings);
  if (found == known_.end()) return std::make_shared<const LearnedEmission>();
  const LearnedEmission& known = *found->second;
  const bool fits = static_cast<std::size_t>(known.lights) == scene.lights.size() &&
                    (known.guides.are_off() || known.guides.of_choice.size() == scene.light_choices.size());
  return fits ? found->second : std::make_shared<const LearnedEmission>();
}

void FileSample::persist(StateStream& state) {
  std::vector<std::pair<std::string, LearnedEmission>> all;
  for (const auto& [settings, known] : known_)
    if (is_learned(*known)) all.emplace_back(settings, *known);
  std::uint64_t count = all.size();
  state.value(count);
  if (count > kMostLearned) throw std::runtime_error("it holds more guides than are possible");
  all.resize(static_cast<std::size_t>(count));
  for (auto& [settings, known] : all) {
    state.text(settings, kMostText);
    dspm::persist(known, state);
  }
  for (auto& [settings, known] : all) known_[settings] = std::make_shared<const LearnedEmission>(std::move(known));
}

void FileSample::expect_known(const std::string& settings, std::size_t lights) {
  if (!given_) return;
  const auto found = known_.find(settings);
  if (found == known_.end())
    throw UsageError(
        "--guide: it was learned with other settings of the integrator: its type, maxdepth, gatheralpha, direct and "
        "radii must be the same");
  if (static_cast<std::size_t>(found->second->lights) != lights)
    throw UsageError("--guide: it was learned for another number of lights");
  is_used_ = true;
}

}  // namespace dspm
