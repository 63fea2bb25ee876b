// Pearson's chi-square test of directions: do samples follow the density that is claimed for them? The sphere is cut
// into cells, finest at the ends of an axis of interest; expected counts are integrals of the density, observed ones
// are samples. Absorbed samples form one more cell, expected with the probability that the density lacks to 1. The
// caller fixes the seed, so that a pass stays a pass.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/vec.h"

namespace dspm::test {

/// The chance that a chi-square variable of `dof` degrees of freedom exceeds x: the regularised upper incomplete gamma
/// function Q(dof / 2, x / 2), by series or continued fraction. [Abramowitz and Stegun 6.5.29, 6.5.31]
inline double chi2_tail(double x, int dof) {
  const double a = 0.5 * dof, t = 0.5 * x;
  if (t <= 0) return 1;
  const double scale = std::exp(-t + a * std::log(t) - std::lgamma(a));
  if (t < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > 1e-16 * sum; ++n) sum += term *= t / (a + n);
    return 1 - sum * scale;
  }
  double b = t + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int n = 1; n < 10000; ++n) {  // Lentz
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return scale * h;
}

struct Chi2Settings {
  Vec3 axis{0, 0, 1};           // a pole: cells are finest around it and opposite to it
  int rows = 16, columns = 32;  // of equal angle
  int samples = 100'000;
  double level = 0.01;  // chance that a correct sampler fails any of the `tests` tests
  int tests = 1;
};

struct Chi2Result {
  double statistic = 0, p_value = 1;
  int dof = 0;
  double integral = 0;  // of the density
  bool passed = true;
  std::string worst;  // the cells that contribute most, for failure messages
};

class SphereChi2 {
 public:
  explicit SphereChi2(const Chi2Settings& settings)
      : settings_(settings),
        basis_(Basis::around(settings.axis)),
        observed_(static_cast<std::size_t>(settings.rows * settings.columns)) {}

  /// Runs the test with sample() -> std::optional<Vec3> and pdf(Vec3) -> density by solid angle.
  template <class Sample, class Pdf>
  Chi2Result run(const Sample& sample, const Pdf& pdf) {
    for (int n = 0; n < settings_.samples; ++n) count(sample());
    const Chi2Result result = compared(pdf, kLeastDepth);
    return result.passed && result.integral < 1.001 ? result : compared(pdf, kLeastDepthInDoubt);
  }

 private:
  struct Cell {
    double expected;
    int observed;
    int row, column;  // row -1: absorbed, -2: pooled
    double excess() const { return (observed - expected) * (observed - expected) / expected; }
  };

  void count(const std::optional<Vec3>& direction) {
    if (!direction) return void(++absorbed_);
    const Vec3 w = basis_.to_local(*direction);
    const double v = std::acos(std::clamp(static_cast<double>(w.z), -1., 1.)) / kPiD;
    const double phi = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * kPiD) + 0.5;
    const int row = std::min(static_cast<int>(v * settings_.rows), settings_.rows - 1);
    const int column = std::min(static_cast<int>(phi * settings_.columns), settings_.columns - 1);
    ++observed_[static_cast<std::size_t>(row * settings_.columns + column)];
  }

  // A horizon may cut a sharp lobe between the points of a coarse quadrature, so what samples contradict, in a cell or
  // in all, is integrated anew, more finely; and so is what exceeds 1.
  static constexpr int kLeastDepth = 0, kLeastDepthInDoubt = 5;
  bool is_unlikely(int observed, double share) const {
    const double expected = settings_.samples * share;
    return std::abs(observed - expected) > 3 * std::sqrt(expected + 1);
  }

  template <class Pdf>
  Chi2Result compared(const Pdf& pdf, int least_depth) const {
    std::vector<Cell> cells;
    Chi2Result result;
    for (int row = 0; row < settings_.rows; ++row)
      for (int column = 0; column < settings_.columns; ++column) {
        const int observed = observed_[static_cast<std::size_t>(row * settings_.columns + column)];
        double share = cell_integral(pdf, row, column, least_depth);
        if (is_unlikely(observed, share)) share = cell_integral(pdf, row, column, kLeastDepthInDoubt);
        result.integral += share;
        cells.push_back({settings_.samples * share, observed, row, column});
      }
    cells.push_back({settings_.samples * std::max(0., 1 - result.integral), absorbed_, -1, 0});
    judge(std::move(cells), result);
    return result;
  }

  template <class Pdf>
  double cell_integral(const Pdf& pdf, int row, int column, int least_depth) const {
    const double v = static_cast<double>(row) / settings_.rows, phi = static_cast<double>(column) / settings_.columns;
    const double dv = 1. / settings_.rows, dphi = 1. / settings_.columns;
    return refined(pdf, v, phi, dv, dphi, midpoints(pdf, v, phi, dv, dphi), 0, least_depth);
  }
  /// Halves a patch until doing so changes the expected count by less than a twentieth.
  template <class Pdf>
  double refined(const Pdf& pdf, double v, double phi, double dv, double dphi, double coarse, int depth,
                 int least_depth) const {
    double quarters[4], sum = 0;
    for (int i = 0; i < 4; ++i)
      sum += quarters[i] = midpoints(pdf, v + (i % 2) * dv / 2, phi + (i / 2) * dphi / 2, dv / 2, dphi / 2);
    if (depth >= 6 || (std::abs(sum - coarse) * settings_.samples < 0.05 && depth >= least_depth)) return sum;
    sum = 0;
    for (int i = 0; i < 4; ++i)
      sum += refined(pdf, v + (i % 2) * dv / 2, phi + (i / 2) * dphi / 2, dv / 2, dphi / 2, quarters[i], depth + 1,
                     least_depth);
    return sum;
  }
  template <class Pdf>
  double midpoints(const Pdf& pdf, double v0, double phi0, double dv, double dphi) const {
    constexpr int kSteps = 3;
    double x[kSteps], y[kSteps], sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double angle = 2 * kPiD * (phi0 + dphi * (i + 0.5) / kSteps - 0.5);
      x[i] = std::cos(angle), y[i] = std::sin(angle);
    }
    for (int row = 0; row < kSteps; ++row) {
      const double angle = kPiD * (v0 + dv * (row + 0.5) / kSteps), sin = std::sin(angle), cos = std::cos(angle);
      for (int i = 0; i < kSteps; ++i) {
        const Vec3 w{static_cast<float>(sin * x[i]), static_cast<float>(sin * y[i]), static_cast<float>(cos)};
        sum += static_cast<double>(pdf(basis_.to_world(w))) * sin;
      }
    }
    return sum * dv * dphi * 2 * kPiD * kPiD / (kSteps * kSteps);
  }

  /// Pools cells with fewer than five expected samples, in ascending order of that number.
  void judge(std::vector<Cell> cells, Chi2Result& result) const {
    std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.expected < b.expected; });
    std::vector<Cell> pooled;
    Cell pool{0, 0, -2, 0};
    for (const Cell& cell : cells) {
      pool.expected += cell.expected, pool.observed += cell.observed;
      if (pool.expected < 5) continue;
      pooled.push_back(cell.expected >= 5 ? Cell{pool.expected, pool.observed, cell.row, cell.column} : pool);
      pool = {0, 0, -2, 0};
    }
    for (const Cell& cell : pooled) result.statistic += cell.excess();
    result.dof = static_cast<int>(pooled.size()) - 1;
    result.p_value = result.dof > 0 ? chi2_tail(result.statistic, result.dof) : 1;
    // Sidak: all tests together fail a correct sampler with a chance of `level`.
    result.passed = result.p_value >= 1 - std::pow(1 - settings_.level, 1. / settings_.tests);
    std::stable_sort(pooled.begin(), pooled.end(),
                     [](const Cell& a, const Cell& b) { return a.excess() > b.excess(); });
    for (std::size_t i = 0; i < std::min<std::size_t>(pooled.size(), 8); ++i)
      result.worst += "  cell " + std::to_string(pooled[i].row) + "," + std::to_string(pooled[i].column) +
                      ": expected " + std::to_string(pooled[i].expected) + ", observed " +
                      std::to_string(pooled[i].observed) + "\n";
  }

  static constexpr double kPiD = 3.14159265358979323846;
  Chi2Settings settings_;
  Basis basis_;
  std::vector<int> observed_;
  int absorbed_ = 0;
};

}  // namespace dspm::test
