#include "dspm/base/colour/colour_space.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dspm {
namespace {

constexpr Chromaticity kD65{0.3127, 0.3290};

struct Known {
  std::string_view word;
  Chromaticities chromaticities;
};
/// The spaces, in the order of ColourSpace. [ITU-R BT.709 and BT.2020; SMPTE ST 2065-1; SMPTE RP 431-2, with D65 as in
/// Display P3]
const std::array<Known, 4> kSpaces{{{"srgb", {{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, kD65}},
                                    {"rec2020", {{0.708, 0.292}, {0.17, 0.797}, {0.131, 0.046}, kD65}},
                                    {"aces2065-1", {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}}},
                                    {"dci-p3", {{0.68, 0.32}, {0.265, 0.69}, {0.15, 0.06}, kD65}}}};

using Column = std::array<double, 3>;

Column xyz(const Chromaticity& c) { return {c.x / c.y, 1, (1 - c.x - c.y) / c.y}; }

Column applied(const ColourMatrix& m, const Column& c) {
  Column r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i] += m[i][j] * c[j];
  return r;
}

ColourMatrix inverse(const ColourMatrix& m) {
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  ColourMatrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[j][i] = cofactor(i, j) / determinant;
  return r;
}

ColourMatrix diagonal(const Column& d) { return {{{d[0], 0, 0}, {0, d[1], 0}, {0, 0, d[2]}}}; }

struct ToRec709 {
  ColourMatrix light, albedo;
};

ToRec709 to_rec709_of(ColourSpace space) {
  const Chromaticities &from = chromaticities(space), &to = chromaticities(ColourSpace::srgb);
  const ColourMatrix in = xyz_from_rgb(from), out = rgb_from_xyz(to);
  return {out * in, out * adaptation(from.white, to.white) * in};
}

}  // namespace

std::optional<ColourSpace> colour_space(std::string_view word) {
  const auto found = std::find_if(kSpaces.begin(), kSpaces.end(), [&](const Known& k) { return k.word == word; });
  if (found == kSpaces.end()) return std::nullopt;
  return static_cast<ColourSpace>(found - kSpaces.begin());
}

std::string_view word_of(ColourSpace space) { return kSpaces[static_cast<std::size_t>(space)].word; }

std::vector<std::string> colour_space_words() {
  std::vector<std::string> words;
  for (const Known& known : kSpaces) words.emplace_back(known.word);
  return words;
}

const Chromaticities& chromaticities(ColourSpace space) {
  return kSpaces[static_cast<std::size_t>(space)].chromaticities;
}

ColourMatrix operator*(const ColourMatrix& a, const ColourMatrix& b) {
  ColourMatrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
  return r;
}

Rgb operator*(const ColourMatrix& m, const Rgb& c) {
  const Column r = applied(m, {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)});
  return {static_cast<float>(r[0]), static_cast<float>(r[1]), static_cast<float>(r[2])};
}

// The primaries, times what makes their sum white.
ColourMatrix xyz_from_rgb(const Chromaticities& space) {
  const Column red = xyz(space.red), green = xyz(space.green), blue = xyz(space.blue);
  ColourMatrix m{};
  for (std::size_t i = 0; i < 3; ++i) m[i] = {red[i], green[i], blue[i]};
  return m * diagonal(applied(inverse(m), xyz(space.white)));
}

ColourMatrix rgb_from_xyz(const Chromaticities& space) { return inverse(xyz_from_rgb(space)); }

ColourMatrix adaptation(const Chromaticity& from, const Chromaticity& to) {
  constexpr ColourMatrix kBradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Column a = applied(kBradford, xyz(from)), b = applied(kBradford, xyz(to));
  return inverse(kBradford) * diagonal({b[0] / a[0], b[1] / a[1], b[2] / a[2]}) * kBradford;
}

Chromaticity white_of(double kelvin) {
  const double t = kelvin * 1.4388 / 1.438;
  if (t < 4000) {
    const Column c = to_xyz(blackbody(static_cast<float>(t)));
    const double sum = c[0] + c[1] + c[2];
    return {c[0] / sum, c[1] / sum};
  }
  const double x = t <= 7000 ? 0.244063 + 99.11 / t + 2.9678e6 / (t * t) - 4.6070e9 / (t * t * t)
                             : 0.237040 + 247.48 / t + 1.9018e6 / (t * t) - 2.0064e9 / (t * t * t);
  return {x, -3 * x * x + 2.87 * x - 0.275};
}

Rgb beyond_rec709(const Rgb& c, ColourSpace space, SpectrumRole role) {
  static const std::array<ToRec709, 4> kMatrices{to_rec709_of(ColourSpace::srgb), to_rec709_of(ColourSpace::rec2020),
                                                 to_rec709_of(ColourSpace::aces2065_1),
                                                 to_rec709_of(ColourSpace::dci_p3)};
  if (space == ColourSpace::srgb) return c;
  const ToRec709& matrices = kMatrices[static_cast<std::size_t>(space)];
  return (role == SpectrumRole::illuminant ? matrices.light : matrices.albedo) * c;
}

Rgb to_rec709(const Rgb& c, ColourSpace space, SpectrumRole role) {
  if (space == ColourSpace::srgb) return c;
  const Rgb converted = beyond_rec709(c, space, role);
  const float high = role == SpectrumRole::albedo ? 1 : std::numeric_limits<float>::max();
  return {std::clamp(converted.r, 0.f, high), std::clamp(converted.g, 0.f, high), std::clamp(converted.b, 0.f, high)};
}

}  // namespace dspm
