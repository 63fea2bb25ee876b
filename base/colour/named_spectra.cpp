// pbrt's named spectra: glasses by Sellmeier's equation, daylight and incandescent light by the CIE's formulas, lamps
// and metals from tables; and the black body.
#include <cmath>
#include <string>

#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/colour/spectrum_tables.h"

namespace dspm {
namespace {

template <class Value>
SpectralCurve tabulate(int first_nm, int last_nm, int step, Value&& value) {
  SpectralCurve spectrum;
  for (int nm = first_nm; nm <= last_nm; nm += step) {
    spectrum.nm.push_back(static_cast<float>(nm));
    spectrum.values.push_back(static_cast<float>(value(nm)));
  }
  return spectrum;
}

/// n^2 - 1 = sum of b_i l^2 / (l^2 - c_i), wavelength l in micrometres. Coefficients from Schott's data sheets; of fused
/// silica by Malitson 1965, sapphire (its ordinary ray) by Malitson and Dodge 1972, diamond by Peter 1923, cubic zirconia by
/// Wood and Nassau 1982, and water at 20 degrees by Daimon and Masumura 2007.
struct Glass {
  std::string_view name;
  double b[4], c[4];
};
constexpr Glass kGlasses[] = {
    {"glass-BK7", {1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}},
    {"glass-BAF10", {1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}},
    {"glass-FK51A", {0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}},
    {"glass-LASF9", {2.00029547, 0.298926886, 1.80691843}, {0.0121426017, 0.0538736236, 156.530829}},
    {"glass-F2", {1.34533359, 0.209073176, 0.937357162}, {0.00997743871, 0.0470450767, 111.886764}},
    {"glass-SF5", {1.46141885, 0.247713019, 0.949995832}, {0.0111826126, 0.0508594669, 112.041888}},
    {"glass-SF10", {1.61625977, 0.259229334, 1.07762317}, {0.0127534559, 0.0581983954, 116.60768}},
    {"glass-SF11", {1.73848403, 0.311168974, 1.17490871}, {0.0136068604, 0.0615960463, 121.922711}},
    {"glass-N-SF5", {1.52481889, 0.187085527, 1.42729015}, {0.011254756, 0.0588995392, 129.141675}},
    {"glass-N-SF10", {1.62153902, 0.256287842, 1.64447552}, {0.0122241457, 0.0595736775, 147.468793}},
    {"glass-N-SF11", {1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}},
    {"glass-silica", {0.6961663, 0.4079426, 0.8974794}, {0.00467914826, 0.0135120631, 97.9340025}},
    {"glass-sapphire", {1.4313493, 0.65054713, 5.3414021}, {0.00527992604, 0.0142382647, 325.017834}},
    {"glass-diamond", {0.3306, 4.3356}, {0.030625, 0.011236}},
    {"glass-zirconia", {1.347091, 2.117788, 9.452943}, {0.00391162685, 0.0278018941, 591.490134}},
    {"glass-water",
     {0.5684027565, 0.1726177391, 0.02086189578, 0.1130748688},
     {0.005101829712, 0.01821153936, 0.02620722293, 10.69792721}},
    // pbrt drops "N-S": these are Schott's N-SF5, N-SF10 and N-SF11.
    {"glass-F5", {1.52481889, 0.187085527, 1.42729015}, {0.011254756, 0.0588995392, 129.141675}},
    {"glass-F10", {1.62153902, 0.256287842, 1.64447552}, {0.0122241457, 0.0595736775, 147.468793}},
    {"glass-F11", {1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}},
};

SpectralCurve dispersion(const Glass& glass) {
  return tabulate(360, 830, 5, [&](int nm) {
    const double l2 = 1e-6 * nm * nm;
    double n2 = 1;
    for (int i = 0; i < 4; ++i) n2 += glass.b[i] * l2 / (l2 - glass.c[i]);
    return std::sqrt(n2);
  });
}

/// CIE illuminant A: a black body of 2848 K by the radiation constant of 1931.
SpectralCurve incandescent() {
  return tabulate(360, 830, 5, [](int nm) {
    return 100 * std::pow(560. / nm, 5) * std::expm1(1.435e7 / (2848. * 560)) / std::expm1(1.435e7 / (2848. * nm));
  });
}

struct Daylight {
  std::string_view name;
  double kelvin;
};
// The nominal temperature times 1.4388 / 1.438: the second radiation constant changed after the names were given.
constexpr Daylight kDaylights[] = {{"stdillum-D50", 5000 * 1.4388 / 1.438},
                                   {"stdillum-D65", 6500 * 1.4388 / 1.438},
                                   {"illum-acesD60", 6000 * 1.4388 / 1.438}};

/// CIE 15: the chromaticity of daylight of a colour temperature of 4000 to 7000 K, and the spectrum that has it.
SpectralCurve daylight(double t) {
  const double x = -4.6070e9 / (t * t * t) + 2.9678e6 / (t * t) + 0.09911e3 / t + 0.244063;
  const double y = -3 * x * x + 2.87 * x - 0.275;
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = std::round(1000 * (-1.3515 - 1.7703 * x + 5.9114 * y) / m) / 1000;
  const double m2 = std::round(1000 * (0.03 - 31.4424 * x + 30.0717 * y) / m) / 1000;
  return tabulate(360, 830, 10, [&](int nm) {
    const std::size_t i = static_cast<std::size_t>((nm - 360) / 10);
    return static_cast<double>(kDaylightS0[i]) + m1 * static_cast<double>(kDaylightS1[i]) +
           m2 * static_cast<double>(kDaylightS2[i]);
  });
}

std::string lamp_name(std::size_t index) { return "stdillum-F" + std::to_string(index + 1); }

}  // namespace

std::optional<SpectralCurve> named_spectrum(std::string_view name) {
  for (const Glass& glass : kGlasses)
    if (glass.name == name) return dispersion(glass);
  for (const NamedTable& table : metal_tables())
    if (table.name == name)
      return SpectralCurve{{table.nm.begin(), table.nm.end()}, {table.values.begin(), table.values.end()}};
  if (name == "stdillum-A") return incandescent();
  for (const Daylight& each : kDaylights)
    if (each.name == name) return daylight(each.kelvin);
  for (std::size_t i = 0; i < kFluorescent.size(); ++i)
    if (lamp_name(i) == name)
      return tabulate(380, 780, 5, [&](int nm) { return kFluorescent[i][static_cast<std::size_t>((nm - 380) / 5)]; });
  return std::nullopt;
}

std::vector<std::string> spectrum_names() {
  std::vector<std::string> names;
  for (const Glass& glass : kGlasses) names.emplace_back(glass.name);
  for (const NamedTable& table : metal_tables()) names.emplace_back(table.name);
  names.emplace_back("stdillum-A");
  for (const Daylight& each : kDaylights) names.emplace_back(each.name);
  for (std::size_t i = 0; i < kFluorescent.size(); ++i) names.push_back(lamp_name(i));
  return names;
}

SpectralCurve blackbody(float kelvin) {
  constexpr double kSecondConstant = 1.438776877e7;  // hc / k, in nm K
  const double t = static_cast<double>(kelvin);
  // In logarithms, because for a cold or very hot body both factors of Planck's law leave the range of a double.
  const auto log_radiance = [&](double nm) {
    const double x = kSecondConstant / (nm * t);
    return -5 * std::log(nm) - (x > 50 ? x : std::log(std::expm1(x)));
  };
  const double peak = log_radiance(2.897771955e6 / t);  // Wien's displacement
  return tabulate(360, 830, 1, [&](int nm) { return std::exp(log_radiance(nm) - peak); });
}

}  // namespace dspm
