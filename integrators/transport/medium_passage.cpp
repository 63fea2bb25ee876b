#include "dspm/integrators/transport/medium_passage.h"

#include <algorithm>

#include "dspm/media/beers_law.h"

namespace dspm {

float SegmentNumbers::next() {
  constexpr int kFirst = 1 << 20;  // apart from those of walks and flights
  return random.number(bounce, kFirst + used++);
}

Spectrum MediumSection::left_at(float t) const {
  if (steps.empty()) return left * left_after(sigma_t, t - begin);
  const auto after =
      std::upper_bound(steps.begin(), steps.end(), t, [](float at, const MediumStep& step) { return at < step.t; });
  return after == steps.begin() ? left : std::prev(after)->left;
}

void DrawnCollision::offer(float t, const Spectrum& scattered, float g) {
  const float offered = max_component(scattered);
  if (!(offered > 0)) return;
  sum_ += offered;
  const float chance = offered / sum_;
  if (u_ < chance)
    u_ /= chance, t_ = t, scattered_ = scattered, g_ = g;
  else
    u_ = (u_ - chance) / (1 - chance);
}

MediumPassage::MediumPassage(const Medium& medium, const Majorants& majorants, const Palette& palette, const Ray& ray,
                             SegmentNumbers& numbers, std::vector<MediumStep>& steps)
    : medium_(medium),
      palette_(palette),
      ray_(ray),
      numbers_(numbers),
      steps_(steps),
      collisions_(majorants, ray, TentativeCollisions::kLargest, palette) {
  if (const auto same = medium.everywhere()) everywhere_ = medium.carried(*same, palette);
}

MediumSection MediumPassage::advance(float end, DrawnCollision* drawn) {
  MediumSection section{t_, end, left_, {}, {}, {}, &medium_};
  const std::size_t first = steps_.size();
  if (everywhere_) {
    section.sigma_t = everywhere_->sigma_t();
    section.glow = pass_evenly(*everywhere_, end - t_);
  } else {
    section.glow = pass_by_steps(end, drawn);
    if (drawn != nullptr) section.drawn = *drawn;
    section.steps = std::span(steps_).subspan(first);
  }
  t_ = end;
  return section;
}

/// Emission e that is left after it has passed the rest of a way of length s: e (1 - exp(-sigma_t s)) / sigma_t.
Spectrum MediumPassage::pass_evenly(const CarriedMedium& medium, float length) {
  const Spectrum sigma_t = medium.sigma_t(), after = left_after(sigma_t, length);
  Spectrum glow;
  for (int c = 0; c < 3; ++c)
    if (medium.emitted[c] > 0)
      glow[c] = left_[c] * medium.emitted[c] * (sigma_t[c] > 0 ? (1 - after[c]) / sigma_t[c] : length);
  left_ *= after;
  return glow;
}

/// Collisions are drawn by the largest of the colours' majorants: what each of them leaves is a factor. What is faint plays
/// roulette.
Spectrum MediumPassage::pass_by_steps(float end, DrawnCollision* drawn) {
  constexpr float kFaint = 0.05f, kSurvival = 0.25f;
  const auto number = [&] { return numbers_.next(); };
  Spectrum glow;
  while (!is_black(left_) && collisions_.advance(end, number)) {
    const CarriedMedium here = medium_.carried(medium_.at(ray_.at(collisions_.distance())), palette_);
    const Spectrum sigma_t = here.sigma_t();
    const float largest = max_component(collisions_.majorant());
    glow += left_ * here.emitted / largest;
    if (drawn != nullptr) drawn->offer(collisions_.distance(), left_ * here.sigma_s / largest, here.g);
    for (int c = 0; c < 3; ++c) left_[c] *= std::max(0.f, 1 - sigma_t[c] / largest);
    if (max_component(left_) < kFaint) left_ = number() < kSurvival ? left_ / kSurvival : Spectrum();
    steps_.push_back({collisions_.distance(), left_});
  }
  return glow;
}

}  // namespace dspm
