#include "dspm/image/film/read_sensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "dspm/base/system/number_file.h"

namespace dspm {
namespace {

constexpr std::string_view kPbrtsSensors[] = {
    "canon_eos_100d",     "canon_eos_1dx_mkii", "canon_eos_200d",    "canon_eos_200d_mkii", "canon_eos_5d",
    "canon_eos_5d_mkii",  "canon_eos_5d_mkiii", "canon_eos_5d_mkiv", "canon_eos_5ds",       "canon_eos_m",
    "hasselblad_l1d_20c", "nikon_d810",         "nikon_d850",        "sony_ilce_6400",      "sony_ilce_7m3",
    "sony_ilce_7rm3",     "sony_ilce_9"};

/// pbrt's default white balance for real sensors.
constexpr float kWhiteOfRealSensors = 6500;

/// Throws std::runtime_error if the numbers are no responses by wavelength.
std::array<SpectralCurve, 3> responses_of(const std::vector<float>& numbers) {
  constexpr std::size_t kColumns = 4;
  if (numbers.size() % kColumns != 0 || numbers.size() < 2 * kColumns)
    throw std::runtime_error(fmt::format("it has {} numbers, which are not rows of {}", numbers.size(), kColumns));
  std::array<SpectralCurve, 3> responses;
  for (std::size_t row = 0; row < numbers.size(); row += kColumns) {
    if (row > 0 && !(numbers[row] > numbers[row - kColumns]))
      throw std::runtime_error(
          fmt::format("its wavelengths must ascend, but {} follows {}", numbers[row], numbers[row - kColumns]));
    for (std::size_t c = 0; c < 3; ++c) {
      responses[c].nm.push_back(numbers[row]);
      responses[c].values.push_back(numbers[row + 1 + c]);
    }
  }
  return responses;
}

std::shared_ptr<const Sensor> sensor_of(ParamReader& reader, const std::filesystem::path& file) {
  try {
    return std::make_shared<const Sensor>(responses_of(read_numbers(file)));
  } catch (const std::runtime_error& e) {
    reader.error("sensorfile", fmt::format("cannot read the sensor \"{}\": {}", file.string(), e.what()),
                 "a sensor's file has rows of four numbers: nm, and what red, green and blue respond to it");
    return nullptr;
  }
}

}  // namespace

void read_sensor(ParamReader& reader, FilmSettings& film) {
  const std::string name = reader.text("sensor", "cie1931", "cie1931, or a camera of pbrt's");
  const std::filesystem::path file = reader.optional_file(
      "sensorfile", "a camera's responses: rows of nm, red, green and blue, in place of those of \"sensor\"");
  if (name == "cie1931" && file.empty()) return;
  const bool is_known = std::ranges::find(kPbrtsSensors, name) != std::end(kPbrtsSensors);
  if (name != "cie1931" && !is_known)
    return reader.error("sensor", fmt::format("unknown sensor \"{}\"", name),
                        did_you_mean(name, {std::begin(kPbrtsSensors), std::end(kPbrtsSensors)}));
  if (!reader.has("whitebalance")) film.white_kelvin = kWhiteOfRealSensors;
  film.sensor = file.empty() ? named_sensor(name) : sensor_of(reader, file);
  if (film.sensor == nullptr && file.empty())
    reader.diagnostics().note(reader.where("sensor"),
                              fmt::format("\"cie1931\" stands in for sensor \"{}\", with a white balance of {:.0f} K: "
                                          "dspm has no measurements of it, but \"sensorfile\" takes yours",
                                          name, film.white_kelvin));
}

}  // namespace dspm
