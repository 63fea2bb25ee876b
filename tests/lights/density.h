// Do sampled directions follow the density that is claimed for them? In each cell of the sphere, the share of the
// samples is compared with an estimate of the density's integral by uniform directions. So it does not matter where the
// density jumps, as that of a light does at its silhouette.
#pragma once

#include <vector>

#include "dspm/base/math/sampling.h"
#include "dspm/testing/chi2.h"
#include "tests/lights/random.h"

namespace dspm::test {

class DensityComparison {
 public:
  /// add_samples(draw) calls draw(random) `count` times: it may call sample(w) for the direction it drew.
  template <class Draw>
  void add_samples(int count, const Draw& draw) {
    Sequence random(71);
    samples_ += count;
    for (int i = 0; i < count; ++i) draw(random);
  }
  void sample(const Vec3& w) { cells_[cell(w)].count += 1; }

  /// density(w) is the claim.
  template <class Density>
  void add_claims(int count, const Density& density) {
    Sequence random(72);
    claims_ += count;
    for (int i = 0; i < count; ++i) {
      const Vec3 w = uniform_sphere(random.pair());
      const double share = static_cast<double>(density(w)) * 4 * M_PI;
      Cell& c = cells_[cell(w)];
      c.sum += share, c.sum2 += share * share, c.hits += share > 0 ? 1 : 0;
    }
  }

  /// The chance that right code differs more; cells in which little happens are pooled.
  double p_value() const {
    double statistic = 0;
    int dof = 0;
    Cell rest;
    for (const Cell& c : cells_) {
      if (c.count < 30 || c.hits < 30) {
        rest.count += c.count, rest.hits += c.hits, rest.sum += c.sum, rest.sum2 += c.sum2;
      } else {
        statistic += excess(c);
        ++dof;
      }
    }
    if (rest.count >= 30 || rest.hits >= 30) statistic += excess(rest), ++dof;
    return chi2_tail(statistic, dof);
  }
  /// By how many standard deviations the whole differs.
  double deviation() const {
    Cell whole;
    for (const Cell& c : cells_) whole.count += c.count, whole.hits += c.hits, whole.sum += c.sum, whole.sum2 += c.sum2;
    return std::sqrt(excess(whole));
  }

 private:
  struct Cell {
    double count = 0, hits = 0, sum = 0, sum2 = 0;
  };

  static constexpr int kRows = 16, kColumns = 32;  // of equal area

  static std::size_t cell(const Vec3& w) {
    const int row = std::clamp(static_cast<int>(0.5f * (1 - w.z) * kRows), 0, kRows - 1);
    const float turn = std::atan2(w.y, w.x) / (2 * kPi) + 0.5f;
    return static_cast<std::size_t>(row * kColumns + std::clamp(static_cast<int>(turn * kColumns), 0, kColumns - 1));
  }
  double excess(const Cell& c) const {
    if (c.count == 0 && c.hits == 0) return 0;
    const double a = c.count / samples_, b = c.sum / claims_;
    const double variance = a * (1 - a) / samples_ + (c.sum2 / claims_ - b * b) / claims_;
    return (a - b) * (a - b) / variance;
  }

  std::vector<Cell> cells_ = std::vector<Cell>(kRows * kColumns);
  double samples_ = 0, claims_ = 0;
};

}  // namespace dspm::test
