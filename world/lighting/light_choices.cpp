#include "dspm/world/lighting/light_choices.h"

#include <algorithm>
#include <map>
#include <utility>

#include "dspm/base/math/frames.h"

namespace dspm {
namespace {

// A frame parts from the others rather than have a smaller part of its photons than this. All photons are then traced
// once more.
constexpr double kLeastWorth = 0.6;
constexpr int kRounds = 3;

/// Frames whose lights are the same.
struct Kind {
  std::vector<double> weights;  // by light: power times the scene's factor
  double frames = 0;
  std::size_t choice = 0;
};

std::vector<float> mean_of(const std::vector<Kind>& kinds, std::size_t choice, std::size_t lights) {
  std::vector<double> sums(lights);
  for (const Kind& kind : kinds)
    if (kind.choice == choice)
      for (std::size_t i = 0; i < lights; ++i) sums[i] += kind.frames * kind.weights[i];
  double total = 0;
  for (const double sum : sums) total += sum;
  std::vector<float> probabilities;
  for (const double sum : sums) probabilities.push_back(total > 0 ? static_cast<float>(sum / total) : 0);
  return probabilities;
}

class Choices {
 public:
  Choices(std::vector<Kind>& kinds, std::size_t lights) : kinds_(kinds), lights_(lights) { find_means(1); }

  /// Parts the kinds until each is worth enough: the one that fares worst gets a choice of its own, and others join it.
  void part() {
    while (means_.size() < LightChoices::kMostChoices) {
      const auto worst = std::min_element(kinds_.begin(), kinds_.end(),
                                          [&](const Kind& a, const Kind& b) { return worth(a) < worth(b); });
      if (worst == kinds_.end() || worth(*worst) >= kLeastWorth) return;
      worst->choice = means_.size();
      find_means(means_.size() + 1);
      for (int round = 0; round < kRounds; ++round) settle();
    }
  }

  const std::vector<std::vector<float>>& means() const { return means_; }

 private:
  double worth(const Kind& kind) const { return worth_of_choice(kind.weights, means_[kind.choice]); }

  void settle() {
    for (Kind& kind : kinds_)
      for (std::size_t choice = 0; choice < means_.size(); ++choice)
        if (worth_of_choice(kind.weights, means_[choice]) > worth(kind)) kind.choice = choice;
    find_means(means_.size());
  }

  void find_means(std::size_t count) {
    means_.resize(count);
    for (std::size_t choice = 0; choice < count; ++choice) means_[choice] = mean_of(kinds_, choice, lights_);
  }

  std::vector<Kind>& kinds_;
  std::size_t lights_;
  std::vector<std::vector<float>> means_;  // probabilities by choice and light
};

int best_for(const std::vector<double>& weights, const LightChoices& choices) {
  const auto& all = choices.probabilities;
  const auto best = std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    return worth_of_choice(weights, a) < worth_of_choice(weights, b);
  });
  return static_cast<int>(best - all.begin());
}

}  // namespace

// n paths, of which a fraction p_i starts at light i of power P_i, give the flux of light i as n p_i photons of P_i /
// (n p_i) each: a variance in proportion to P_i^2 / p_i, and to the sum of that for all lights. By power, p_i is P_i /
// P, P the sum of all P_i, which makes the sum P^2, the minimum.
double worth_of_choice(const std::vector<double>& powers, const std::vector<float>& probabilities) {
  double flux = 0, variance = 0;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    if (!(powers[i] > 0)) continue;
    flux += powers[i];
    if (!(probabilities[i] > 0)) return 0;
    variance += powers[i] * powers[i] / static_cast<double>(probabilities[i]);
  }
  return variance > 0 ? flux * flux / variance : 1;
}

std::vector<double> weights_in(const std::vector<WorldLight>& lights, FileFrame frame) {
  std::vector<double> weights;
  for (const WorldLight& light : lights)
    weights.push_back(light.power(frame) * static_cast<double>(light.controls.photons));
  return weights;
}

LightChoices make_light_choices(const std::vector<WorldLight>& lights, int base, int frames) {
  std::map<std::vector<double>, std::size_t> numbers;
  std::vector<Kind> kinds;
  std::vector<std::size_t> kind_of;
  for (FileFrame f(0); f.index() < base; ++f) {
    std::vector<double> weights = weights_in(lights, f);
    const auto [place, is_new] = numbers.try_emplace(weights, kinds.size());
    if (is_new) kinds.push_back({std::move(weights)});
    ++kinds[place->second].frames;
    kind_of.push_back(place->second);
  }
  Choices found(kinds, lights.size());
  found.part();

  LightChoices choices;  // in the order of their first frames
  choices.base = static_cast<std::size_t>(base);
  std::vector<int> place(found.means().size(), -1);
  for (const std::size_t kind : kind_of) {
    int& of = place[kinds[kind].choice];
    if (of < 0) {
      of = static_cast<int>(choices.probabilities.size());
      choices.probabilities.push_back(found.means()[kinds[kind].choice]);
    }
    choices.of_frame.push_back(of);
  }
  for (FileFrame f(base); f.index() < frames; ++f) choices.of_frame.push_back(best_for(weights_in(lights, f), choices));
  return choices;
}

LightChoices make_light_choices(const std::vector<WorldLight>& lights, const LightChoices& others) {
  std::vector<Kind> kinds;
  for (FileFrame f(0); f.slot() < others.base; ++f)
    kinds.push_back({weights_in(lights, f), 1, static_cast<std::size_t>(others.of_frame[f.slot()])});
  LightChoices choices = others;
  for (std::size_t c = 0; c < choices.probabilities.size(); ++c)
    choices.probabilities[c] = mean_of(kinds, c, lights.size());
  return choices;
}

std::vector<LightChoice> LightChoices::in(const std::vector<FileFrame>& frames) const {
  std::vector<LightChoice> choices;
  for (std::size_t c = 0; c < probabilities.size(); ++c) {
    LightChoice& choice = choices.emplace_back(probabilities[c]);
    const auto is_own = [&](int of) { return of == static_cast<int>(c); };
    const auto end = of_frame.begin() + static_cast<std::ptrdiff_t>(base);
    choice.share = static_cast<float>(std::count_if(of_frame.begin(), end, is_own)) / static_cast<float>(base);
    for (std::size_t j = 0; j < frames.size(); ++j)
      if (is_own(of_frame[frames[j].slot()])) choice.frames |= FrameSet::single(static_cast<Frame>(j));
  }
  return choices;
}

std::vector<LightSamples> make_light_samples(const std::vector<WorldLight>& lights, const LightChoices& choices) {
  std::vector<LightSamples> samples;
  for (int c = 0; c < static_cast<int>(choices.probabilities.size()); ++c) {
    std::vector<LightSamples::OfLight> all;
    for (const WorldLight& light : lights) all.push_back({0, light.bounds});
    for (FileFrame f(0); f.slot() < choices.base; ++f)
      for (std::size_t i = 0; i < lights.size() && choices.of_frame[f.slot()] == c; ++i)
        if (lights[i].glow_of == kNoMedium) all[i].power += lights[i].power(f);
    samples.emplace_back(all);
  }
  return samples;
}

// A choice without a frame takes the place of one of those with most.
std::vector<FileFrame> LightChoices::sample(std::size_t wanted) const {
  const std::size_t all = base, count = std::min(all, std::max(wanted, probabilities.size()));
  std::vector<int> frames, samples(probabilities.size());
  for (std::size_t i = 0; i < count; ++i) {
    frames.push_back(static_cast<int>(count == 1 ? 0 : i * (all - 1) / (count - 1)));
    ++samples[static_cast<std::size_t>(of_frame[static_cast<std::size_t>(frames.back())])];
  }
  for (std::size_t c = 0; c < samples.size(); ++c) {
    if (samples[c] > 0) continue;
    const auto most = std::max_element(samples.begin(), samples.end());
    const auto given_up = std::find_if(frames.rbegin(), frames.rend(), [&](int frame) {
      return of_frame[static_cast<std::size_t>(frame)] == static_cast<int>(most - samples.begin());
    });
    *given_up = static_cast<int>(std::find(of_frame.begin(), of_frame.end(), static_cast<int>(c)) - of_frame.begin());
    --*most, ++samples[c];
  }
  std::sort(frames.begin(), frames.end());
  std::vector<FileFrame> sample;
  for (const int frame : frames) sample.emplace_back(frame);
  return sample;
}

std::vector<float> LightChoices::shares(const WorldLight& light) const {
  std::vector<float> shares(probabilities.size());
  float frames = 0;
  for (FileFrame f(0); f.slot() < base; ++f)
    if (light.power(f) > 0) ++shares[static_cast<std::size_t>(of_frame[f.slot()])], ++frames;
  if (frames > 0)
    for (float& share : shares) share /= frames;
  return shares;
}

}  // namespace dspm
