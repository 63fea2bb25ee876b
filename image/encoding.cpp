#include "dspm/image/encoding.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"

namespace dspm {

float srgb_to_linear(float encoded) {
  const float v = std::abs(encoded);
  const float linear = v <= 0.04045f ? v / 12.92f : rounded::pow((v + 0.055f) / 1.055f, 2.4f);
  return std::copysign(linear, encoded);
}

float linear_to_srgb(float linear) {
  const float v = std::abs(linear);
  const float encoded = v <= 0.0031308f ? v * 12.92f : 1.055f * rounded::pow(v, 1 / 2.4f) - 0.055f;
  return std::copysign(encoded, linear);
}

float decode(ColorEncoding encoding, float encoded) {
  switch (encoding.kind) {
    case ColorEncoding::Kind::srgb: return srgb_to_linear(encoded);
    case ColorEncoding::Kind::gamma: return std::copysign(rounded::pow(std::abs(encoded), encoding.exponent), encoded);
    case ColorEncoding::Kind::automatic:
    case ColorEncoding::Kind::linear: break;
  }
  return encoded;
}

std::vector<float> decoding_table(ColorEncoding encoding, int levels) {
  if (encoding.kind == ColorEncoding::Kind::automatic) encoding.kind = ColorEncoding::Kind::srgb;
  std::vector<float> table;
  table.reserve(static_cast<std::size_t>(levels));
  for (int i = 0; i < levels; ++i)
    table.push_back(decode(encoding, static_cast<float>(i) / static_cast<float>(levels - 1)));
  return table;
}

std::string srgb_bytes(const Image& image) {
  std::string bytes;
  bytes.reserve(image.pixels.size() * channels_of(image));
  for (const std::uint16_t value : encoded(image, 256, true)) bytes.push_back(static_cast<char>(value));
  return bytes;
}

std::vector<std::uint16_t> encoded(const Image& image, int levels, bool srgb) {
  std::vector<std::uint16_t> values;
  values.reserve(image.pixels.size() * channels_of(image));
  const auto add = [&](float value) {
    const float clamped = value > 0 ? std::min(value, 1.f) : 0.f;
    values.push_back(static_cast<std::uint16_t>(std::lround(clamped * static_cast<float>(levels - 1))));
  };
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) add(srgb ? linear_to_srgb(image.pixels[i][c]) : image.pixels[i][c]);
    if (!image.alpha.empty()) add(image.alpha[i]);
  }
  return values;
}

std::optional<ColorEncoding> ColorEncoding::parse(std::string_view words) {
  if (words == "sRGB") return ColorEncoding{Kind::srgb, 1};
  if (words == "linear") return ColorEncoding{Kind::linear, 1};
  if (!words.starts_with("gamma ")) return std::nullopt;
  ColorEncoding encoding{Kind::gamma, 0};
  const char* const end = words.data() + words.size();
  const auto [stop, error] = std::from_chars(words.data() + 6, end, encoding.exponent);
  if (error != std::errc() || stop != end || !(encoding.exponent > 0) || !std::isfinite(encoding.exponent)) {
    return std::nullopt;
  }
  return encoding;
}

}  // namespace dspm
