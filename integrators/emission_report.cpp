#include "dspm/integrators/emission_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

constexpr std::size_t kLightsListed = 8, kMostReports = 8, kMostText = 4200;

/// Returns "0.34%", "12%", "100%" and the like.
std::string percent(double share) {
  return fmt::format("{:.{}f}%", 100 * share, share < 0.01 ? 2 : share < 0.1 ? 1 : 0);
}

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

std::string found_of(const EmissionReport::OfLight& light) {
  return light.started > 0 ? percent(ratio(light.found, light.started)) : "none of them a pilot path";
}

/// Saves or loads the elements one by one, as they hold texts.
template <class T, class Fn>
void persist(std::vector<T>& all, std::size_t most, StateStream& state, Fn&& persist_one) {
  std::uint64_t count = all.size();
  state.value(count);
  if (count > most) throw std::runtime_error("its record of what was learned is damaged");
  all.resize(static_cast<std::size_t>(count));
  for (T& one : all) persist_one(one);
}

std::string by_power(const EmissionReport& report) {
  const bool favours =
      std::any_of(report.lights.begin(), report.lights.end(),
                  [](const EmissionReport::OfLight& light) { return std::abs(light.share - light.by_power) > 1e-4; });
  return fmt::format("{}: start by the lights' power{}", report.photons, favours ? " times \"photons\"" : "");
}

std::string why_no_guide(const EmissionReport& report) {
  if (report.start == EmissionReport::Start::asked_by_power) return "as \"string emission\" \"power\" says";
  if (!(report.gain > 0)) return "as there is nothing to learn from";
  return fmt::format(
      "as a guide does not pay: the same variance would take {:.2g} of the time, and 0.8 is the most that "
      "is worth it",
      1 / report.gain);
}

/// Says what became of the paths that count as found.
const char* found_in_words(const EmissionReport& report) {
  return report.photons == kLightPaths ? "bring what the camera sees other than direct light"
                                       : "are found by hit points";
}

constexpr const char* kBringCaustics = "bring caustics, and camera paths find all other light";

/// Says who brings which light.
std::string shares_of(const EmissionReport& report) {
  switch (report.bring) {
    case PhotonsBring::all: break;
    case PhotonsBring::caustics:
      return fmt::format("{}: {} paths an iteration {}", report.photons, report.traced, kBringCaustics);
    case PhotonsBring::nothing:
      return fmt::format("{}: none are traced, as camera paths find all light", report.photons);
  }
  return fmt::format("{}: {} paths an iteration bring all light", report.photons, report.traced);
}

std::string how_it_starts(const EmissionReport& report) {
  const std::string found = percent(report.share_found());
  if (report.start != EmissionReport::Start::guided)
    return fmt::format("{}, {}. {} of {} pilot paths {}.", by_power(report), why_no_guide(report), found, report.paths,
                       found_in_words(report));
  constexpr std::uint64_t kEnough = 100;  // for the variance
  const std::string pays = report.found_without >= kEnough
                               ? fmt::format(" The same variance takes {:.2g} of the time.", 1 / report.gain)
                               : "";
  return fmt::format(
      "{}: start where a guide says, learned in {} rounds of {} pilot paths: {} of a round's {}, {} without it.{}",
      report.photons, report.rounds, report.paths, found, found_in_words(report),
      percent(ratio(report.found_without, report.paths)), pays);
}

}  // namespace

void EmissionReport::add_lights(const Scene& scene, const std::vector<double>& shares,
                                const std::vector<std::uint64_t>& started_of,
                                const std::vector<std::uint64_t>& found_of) {
  const std::size_t count = scene.lights.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return shares[a] > shares[b]; });
  const std::size_t listed = count <= kLightsListed + 1 ? count : kLightsListed;
  for (std::size_t place = 0; place < count; ++place) {
    const std::size_t i = order[place];
    if (place <= listed) lights.emplace_back().name = place < listed ? scene.light_names[i] : "";
    OfLight& light = lights.back();
    if (place >= listed) light.name = fmt::format("{} others", count - listed);
    light.by_power += static_cast<double>(scene.lights[i].probability), light.share += shares[i];
    light.started += started_of[i], light.found += found_of[i];
  }
}

void EmissionReport::persist(StateStream& state) {
  state.text(photons, kMostText);
  state.value(start);
  state.value(bring);
  state.value(traced);
  if (start > Start::needs_none || bring > PhotonsBring::nothing)
    throw std::runtime_error("its record of what was learned is damaged");
  for (std::uint64_t* count : {&rounds, &paths, &found_without, &found, &cells}) state.value(*count);
  state.value(gain);
  dspm::persist(lights, kLightsListed + 1, state, [&](OfLight& light) {
    state.text(light.name, kMostText);
    for (double* share : {&light.by_power, &light.share}) state.value(*share);
    for (std::uint64_t* count : {&light.started, &light.found}) state.value(*count);
  });
}

void EmissionReports::put(const EmissionReport& report) {
  const auto same = std::find_if(reports_.begin(), reports_.end(),
                                 [&](const EmissionReport& each) { return each.photons == report.photons; });
  if (same == reports_.end())
    reports_.push_back(report);
  else
    *same = report;
}

void EmissionReports::persist(StateStream& state) {
  dspm::persist(reports_, kMostReports, state, [&](EmissionReport& report) { report.persist(state); });
}

std::string summary_of(const EmissionReport& report) {
  if (report.bring == PhotonsBring::nothing) return shares_of(report);
  std::string text =
      fmt::format("{}: {} of the paths {}", report.photons, percent(report.share_found()), found_in_words(report));
  if (report.start == EmissionReport::Start::guided)
    text += fmt::format(", {} without a guide", percent(ratio(report.found_without, report.paths)));
  if (report.bring == PhotonsBring::caustics)
    text += fmt::format("; {} an iteration {}", report.traced, kBringCaustics);
  else if (report.traced > 0)
    text += fmt::format("; {} are traced an iteration", report.traced);
  if (report.lights.size() < 2) return text;
  text += "; by light:";
  for (const EmissionReport::OfLight& light : report.lights)
    if (light.started > 0)
      text += fmt::format("{} {} {}", text.back() == ':' ? "" : ",", light.name,
                          percent(ratio(light.found, light.started)));
  return text;
}

std::vector<std::string> in_words(const EmissionReport& report) {
  const std::string better = ", with less noise in the same time.";
  if (report.bring == PhotonsBring::nothing) return {shares_of(report) + better};
  std::vector<std::string> lines{how_it_starts(report)};
  if (report.traced > 0) lines.push_back(shares_of(report) + better);
  for (const EmissionReport::OfLight& light : report.lights)
    lines.push_back(fmt::format("{} of {}: {} of the paths, {} by power; found: {}.", report.photons, light.name,
                                percent(light.share), percent(light.by_power), found_of(light)));
  return lines;
}

}  // namespace dspm
