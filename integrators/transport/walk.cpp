#include "dspm/integrators/transport/walk.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/colour/spectrum.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/sampling.h"
#include "dspm/base/math/vec.h"
#include "dspm/media/henyey_greenstein.h"

namespace dspm {
namespace {

// Dimensions of random numbers: apart from those of the vertex, and three for each collision.
constexpr int kHero = 1 << 10, kFlights = kHero + 1, kTurn = 0, kFlight = 1, kSurvival = 2, kNumbers = 3;

constexpr int kMostCollisions = 1 << 16;

int dimension(int collision, int number) { return kFlights + collision * kNumbers + number; }

/// Returns the share of light that a flight of that length leaves.
float left_after(float sigma_t, float distance) { return rounded::exp(-sigma_t * distance); }

}  // namespace

void Walk::start(Ray& ray, const PathRandom& random, int bounce) {
  if (!is_inside()) return;
  share_ = weight_ = Spectrum(1), collisions_ = 0;
  hero_ = std::min(2, static_cast<int>(3 * random.number(bounce, kHero)));
  fly(ray, random, bounce);
}

void Walk::fly(Ray& ray, const PathRandom& random, int bounce) const {
  const float u = random.number(bounce, dimension(collisions_, kFlight)), sigma_t = interior_.sigma_t[hero_];
  ray.t_max = sigma_t > 0 ? -rounded::log(1 - u) / sigma_t : kInfinity;
}

Spectrum Walk::weigh(const Spectrum& density) {
  const Spectrum shares = share_ * density;
  const float all = mean(shares);
  if (!(all > 0)) return {};
  share_ = shares / all;
  return density / all;
}

Spectrum Walk::reach(float distance) {
  Spectrum left;
  for (int c = 0; c < 3; ++c) left[c] = left_after(interior_.sigma_t[c], distance);
  return weigh(left);
}

bool Walk::is_thrown_back(Ray& ray, const SurfacePoint& point, const Vec3& inward, const PathRandom& random,
                          int bounce) {
  if (interior_.thrown_back == 0 || ++collisions_ > kMostCollisions) return false;
  if (!(random.number(bounce, dimension(collisions_, kSurvival)) < interior_.thrown_back)) return false;
  const Vec3 w = cosine_hemisphere(random.pair(bounce, dimension(collisions_, kTurn)));
  ray = point.spawn(Basis::around(inward).to_world(w));
  fly(ray, random, bounce);
  return true;
}

Spectrum Walk::scatter(Ray& ray, const PathRandom& random, int bounce) {
  if (++collisions_ > kMostCollisions || !std::isfinite(ray.t_max)) return {};
  Spectrum density;
  for (int c = 0; c < 3; ++c) density[c] = interior_.sigma_t[c] * left_after(interior_.sigma_t[c], ray.t_max);
  Spectrum factor = weigh(density) * interior_.albedo;
  weight_ *= factor;
  const float survival = std::min(1.f, max_component(weight_));
  if (!(random.number(bounce, dimension(collisions_, kSurvival)) < survival)) return {};
  factor *= 1 / survival, weight_ *= 1 / survival;
  ray.origin = ray.at(ray.t_max);
  ray.direction =
      HenyeyGreenstein(interior_.g).sample(ray.direction, random.pair(bounce, dimension(collisions_, kTurn)));
  fly(ray, random, bounce);
  return factor;
}

}  // namespace dspm
