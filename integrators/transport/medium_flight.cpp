#include "dspm/integrators/transport/medium_flight.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"

namespace dspm {
namespace {

constexpr int kColour = 1 << 19, kFirstFlight = kColour + 1;  // apart from the numbers of walks

Spectrum exp_minus(const Spectrum& depth) {
  return map(depth, [](float d) { return rounded::exp(-d); });
}

template <class T, class Predicate>
void erase_if(FrameArray<T>& array, Predicate&& predicate) {
  array.shrink(static_cast<std::size_t>(std::remove_if(array.begin(), array.end(), predicate) - array.begin()));
}

}  // namespace

bool Flying::weigh(const Spectrum& density) {
  const Spectrum shares = share * density;
  const float all = mean(shares);
  if (!(all > 0)) return false;
  share = shares / all, weight *= density / all;
  return true;
}

MediumFlight::MediumFlight(const Scene& scene, const PathState& path, FrameSet frames, const Majorants& majorants)
    : path_(path),
      colour_(std::min(2, static_cast<int>(3 * path.random.number(0, kColour)))),
      numbers_(path.flights.numbers),
      palette_(*scene.palette),
      collisions_(majorants, path.ray, colour_, palette_) {
  scene.media[static_cast<std::size_t>(path.inside.medium)].states.for_each(
      frames, [&](FrameSet common, const Medium& medium) {
        flying_.add({common, &medium, Spectrum(1), path.flights.share});
      });
}

bool MediumFlight::meet(float distance) {
  colliding_.shrink(0), glowing_.shrink(0);
  const auto number = [&] { return path_.random.number(path_.bounces, kFirstFlight + numbers_++); };
  const bool met = collisions_.advance(distance, number);
  const Spectrum left = exp_minus(collisions_.depth());
  if (!met) {
    erase_if(flying_, [&](Flying& each) { return !each.weigh(left); });
    return false;
  }
  const Vec3 p = path_.ray.at(collisions_.distance());
  const Spectrum& majorant = collisions_.majorant();
  const float u = number();
  for (Flying& each : flying_) {
    const CarriedMedium here = each.medium->carried(each.medium->at(p), palette_);
    if (max_component(here.emitted) > 0)
      glowing_.add({each.frames, each.weight * left * here.emitted / mean(each.share * left * majorant)});
    const Spectrum sigma_t = here.sigma_t();
    const bool collides = u * majorant[colour_] < sigma_t[colour_];
    Spectrum density;
    for (int c = 0; c < 3; ++c)
      density[c] = left[c] * (collides ? sigma_t[c] : std::max(0.f, majorant[c] - sigma_t[c]));
    if (!each.weigh(density)) {
      each.frames = {};
    } else if (collides) {
      colliding_.add({each, here.albedo(), here.g});
      each.frames = {};
    }
  }
  erase_if(flying_, [](const Flying& each) { return each.frames.empty(); });
  return true;
}

void MediumFlight::land(FrameSet frames) {
  for (Flying& each : flying_) each.frames = each.frames - frames;
  erase_if(flying_, [](const Flying& each) { return each.frames.empty(); });
}

}  // namespace dspm
