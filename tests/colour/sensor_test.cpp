// Sensors against the observer of 1931, and against what a measured one must record.
#include "dspm/base/colour/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/observer.h"
#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/smooth_spectra.h"
#include "dspm/base/colour/spectrum_tables.h"
#include "dspm/base/colour/wavelength.h"

namespace dspm {
namespace {

template <class Value>
Rgb recorded(const Sensor& sensor, Value&& value) {
  std::array<double, 3> sum{};
  for (int nm = kFirstNm; nm <= kLastNm; ++nm)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += sensor.part_of_white(nm)[c] * static_cast<double>(value(nm));
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

// A sensor whose responses are blends of the observer's sees what the observer sees, whatever the blends: the matrix is found
// that undoes them.
TEST(Sensor, WhoseResponsesAreThoseOfTheObserverSeesItsColours) {
  std::array<SpectralCurve, 3> responses;
  for (int nm = kFirstNm; nm <= kLastNm; nm += 5) {
    const Xyz o = observer(nm);
    const double blends[] = {5 * o.x + o.y, 0.2 * o.x + 3 * o.y + 0.1 * o.z, 0.3 * o.y + 7 * o.z};
    for (std::size_t c = 0; c < 3; ++c) {
      responses[c].nm.push_back(static_cast<float>(nm));
      responses[c].values.push_back(static_cast<float>(blends[c]));
    }
  }
  const Sensor sensor(responses);
  for (int nm = kFirstNm; nm <= kLastNm; ++nm)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(sensor.part_of_white(nm)[c], part_of_white(nm)[c], 2e-6) << nm << ' ' << c;
}

TEST(Sensor, OfACameraShowsWhiteAndGreysAsTheyAreAndDyesNearly) {
  const Sensor& camera = *named_sensor("canon_eos_5d_mkii");
  for (const float grey : {1.f, 0.3f}) {
    const Rgb seen = recorded(camera, [&](int) { return grey; });
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], grey, 1e-5f);
  }
  double squares = 0;
  int count = 0;
  for (const int r : {3, 8, 13})
    for (const int g : {3, 8, 13})
      for (const int b : {3, 8, 13}) {
        const Rgb seen = recorded(camera, [&](int nm) { return SmoothSpectra::all().at(r, g, b).at(nm); });
        const Rgb miss = seen - Rgb(static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)) / 16;
        squares += static_cast<double>(miss.r * miss.r + miss.g * miss.g + miss.b * miss.b) / 3, ++count;
      }
  EXPECT_LT(std::sqrt(squares / count), 0.025);
}

double determinant(const std::array<std::array<double, 3>, 3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Whatever matrix and white balance turn responses into colours, the ratio of two determinants of three lines each remains.
TEST(Sensor, RecordsLinesByItsResponses) {
  const SensorTable& table = sensor_tables().front();
  const auto sensor = named_sensor(table.name);
  ASSERT_NE(sensor, nullptr);
  const SpectralCurve daylight = *named_spectrum("stdillum-D65");
  const auto of_lines = [&](std::array<int, 3> lines) {
    std::array<std::array<double, 3>, 3> recorded, responses;
    for (std::size_t k = 0; k < 3; ++k) {
      recorded[k] = sensor->part_of_white(lines[k]);
      for (std::size_t c = 0; c < 3; ++c)
        responses[k][c] = static_cast<double>(table.responses[static_cast<std::size_t>(lines[k] - 380) / 5][c]) *
                          static_cast<double>(daylight.at(static_cast<float>(lines[k])));
    }
    return std::pair(determinant(recorded), determinant(responses));
  };
  const auto [recorded, responses] = of_lines({450, 545, 610});
  for (const std::array<int, 3>& lines : {std::array{435, 520, 590}, {405, 500, 700}, {480, 570, 650}}) {
    const auto [others_recorded, others_responses] = of_lines(lines);
    EXPECT_NEAR(others_recorded / recorded, others_responses / responses,
                1e-4 * std::abs(others_responses / responses));
  }
}

TEST(Sensor, ThatCannotTellColoursApartIsRefused) {
  const SpectralCurve flat{{400, 700}, {1, 1}}, rising{{400, 700}, {0, 1}}, none{{400, 700}, {0, 0}};
  EXPECT_THROW(Sensor({flat, flat, rising}), std::runtime_error);
  EXPECT_THROW(Sensor({flat, none, rising}), std::runtime_error);
}

TEST(Sensor, GivesPalettesItsColours) {
  const auto camera = named_sensor("canon_eos_5d_mkii");
  const SmoothSpectrum& dye = SmoothSpectra::all().at(12, 4, 2);
  const Rgb expected = recorded(*camera, [&](int nm) { return dye.at(nm); });
  for (const auto& [iterations, tolerance] : {std::pair{16, 0.02f}, {64, 0.006f}}) {
    Rgb sum, white;
    for (int i = 0; i < iterations; ++i) {
      const auto palette = Palette::of_iteration(3, static_cast<std::uint64_t>(i), camera.get());
      sum += palette->seen(palette->carried(Rgb(12, 4, 2) / 16)), white += palette->seen(Spectrum(1));
    }
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sum[c] / static_cast<float>(iterations), expected[c], tolerance) << iterations;
      EXPECT_NEAR(white[c] / static_cast<float>(iterations), 1, tolerance) << iterations;
    }
  }
}

}  // namespace
}  // namespace dspm
