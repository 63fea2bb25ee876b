#include "dspm/materials/thin_film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dspm/materials/fresnel.h"

namespace dspm {
namespace {

constexpr int kReflections = 3;  // r12 is at most a third for an index of 2, so the fourth counts 1% at most

float smooth_step(float x) {
  x = std::clamp(x, 0.f, 1.f);
  return x * x * (3 - 2 * x);
}

}  // namespace

ThinFilm::ThinFilm(float eta, float nm, const Palette& palette)
    : eta_(1 + (eta - 1) * smooth_step(nm / 30)), nm_(nm), palette_(&palette) {}

float ThinFilm::cos_inside(float cos) const { return std::sqrt(std::max(0.f, 1 - (1 - cos * cos) / (eta_ * eta_))); }

Spectrum ThinFilm::mirrored(const Spectrum& inner, const Spectrum& amplitude, float cos) const {
  const float outer = fresnel_dielectric(cos, eta_);
  const bool in_series = palette_->is_rgb();
  std::array<Spectrum, kReflections> colour;
  for (int m = 0; m < (in_series ? kReflections : 1); ++m)
    colour[static_cast<std::size_t>(m)] =
        palette_->interference(static_cast<float>(m + 1) * 2 * eta_ * nm_ * cos_inside(cos));
  Spectrum result;
  for (int c = 0; c < 3; ++c) {
    const float x2 = outer * inner[c], x = std::copysign(std::sqrt(x2), amplitude[c]);
    if (!(x2 < 1)) {
      result[c] = 1;
      continue;
    }
    if (!in_series) {
      result[c] = std::max(0.f, 1 - (1 - outer) * (1 - inner[c]) / (1 + 2 * x * colour[0][c] + x2));
      continue;
    }
    float sum = 1, power = 1;
    for (const Spectrum& of_m : colour) power *= -x, sum += 2 * power * of_m[c];
    result[c] = std::clamp(1 - (1 - outer) * (1 - inner[c]) / (1 - x2) * sum, 0.f, 1.f);
  }
  return result;
}

Spectrum ThinFilm::over_metal(const Spectrum& straight, float cos) const {
  Spectrum amplitude;
  for (int c = 0; c < 3; ++c) {
    // Of the base in air it is s = (n - 1) / (n + 1), under the film (n - eta) / (n + eta).
    const float s = std::sqrt(std::clamp(straight[c], 0.f, 1.f)), n = 1 + s, film = eta_ * (1 - s);
    amplitude[c] = (n - film) / (n + film);
  }
  return mirrored(fresnel_schlick(amplitude * amplitude, cos_inside(cos)), amplitude, cos);
}

Spectrum ThinFilm::over_dielectric(float eta_base, float cos) const {
  return mirrored(Spectrum(fresnel_dielectric(cos_inside(cos), eta_base / eta_)), Spectrum(eta_base - eta_), cos);
}

// Airy's sum is greatest or least where the faces' reflections are in step or out of step, and a colour of interference
// lies up to 1.6 times as far from the mean. Between air and the film's index lie those of very thin films.
float ThinFilm::most_gain(float eta, float eta_base) {
  constexpr int kAngles = 64, kIndices = 8;
  float most = 0;
  for (int i = 1; i <= kAngles; ++i)
    for (int k = 1; k <= kIndices; ++k) {
      const float cos = static_cast<float>(i) / kAngles, index = 1 + (eta - 1) * static_cast<float>(k) / kIndices;
      const float inside = std::sqrt(1 - (1 - cos * cos) / (index * index));
      const float outer = fresnel_dielectric(cos, index), inner = fresnel_dielectric(inside, eta_base / index);
      const float x = std::sqrt(outer * inner), passed = (1 - outer) * (1 - inner);
      const float high = 1 - passed / ((1 + x) * (1 + x)), low = 1 - passed / ((1 - x) * (1 - x));
      most = std::max(most, (high + low) / 2 + 1.6f * (high - low) / 2 - fresnel_dielectric(cos, eta_base));
    }
  return std::min(1.f, most);
}

}  // namespace dspm
