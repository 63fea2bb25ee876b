#include "dspm/image/icc_profile.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "dspm/image/big_endian.h"

namespace dspm {
namespace {

constexpr double kD50[] = {0.9642, 1, 0.8249};  // under which all profiles meet, as the ICC rounds it
constexpr std::size_t kHeaderSize = 128, kTagSize = 12;

std::string fixed(double value) { return big_endian(static_cast<std::uint32_t>(std::lround(value * 65536))); }

std::string fixed(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += fixed(value);
  return text;
}

std::string xyz(double x, double y, double z) { return "XYZ " + big_endian(0) + fixed({x, y, z}); }

/// Stores a text as UTF-16 in American English, as readers expect.
std::string in_words(std::string_view ascii) {
  std::string text = "mluc" + big_endian(0) + big_endian(1) + big_endian(12) + "enUS" +
                     big_endian(static_cast<std::uint32_t>(2 * ascii.size())) + big_endian(28);
  for (const char letter : ascii) text += std::string(1, '\0') + letter;
  return text;
}

/// Returns sRGB's curve as the parametric curve of type 3. [IEC 61966-2-1]
std::string srgb_curve() {
  return "para" + big_endian(0) + big_endian(3, 2) + big_endian(0, 2) +
         fixed({2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045});
}

std::string header(std::size_t size) {
  std::string text =
      big_endian(static_cast<std::uint32_t>(size)) + big_endian(0) + big_endian(0x04300000) + "mntrRGB XYZ ";
  for (const int part : {2017, 7, 7, 0, 0, 0})
    text += big_endian(static_cast<std::uint32_t>(part), 2);  // a date must be
  text += "acsp";
  text.resize(68, '\0');
  text += fixed({kD50[0], kD50[1], kD50[2]});
  text.resize(kHeaderSize, '\0');
  return text;
}

struct Tag {
  std::string_view name;
  std::string content;
};

}  // namespace

std::string icc_profile(ColourSpace space, const std::string& name) {
  const Chromaticities& primaries = chromaticities(space);
  constexpr double kSum = kD50[0] + kD50[1] + kD50[2];
  const ColourMatrix adapted = adaptation(primaries.white, {kD50[0] / kSum, kD50[1] / kSum}),
                     columns = adapted * xyz_from_rgb(primaries);
  const auto column = [&](std::size_t i) { return xyz(columns[0][i], columns[1][i], columns[2][i]); };
  std::string chad = "sf32" + big_endian(0);
  for (const auto& row : adapted) chad += fixed({row[0], row[1], row[2]});
  std::vector<Tag> tags = {
      {"desc", in_words(name)}, {"cprt", in_words("CC0")}, {"wtpt", xyz(kD50[0], kD50[1], kD50[2])},
      {"chad", chad},           {"rXYZ", column(0)},       {"gXYZ", column(1)},
      {"bXYZ", column(2)},      {"rTRC", srgb_curve()},    {"gTRC", srgb_curve()},
      {"bTRC", srgb_curve()}};
  std::string table = big_endian(static_cast<std::uint32_t>(tags.size())), contents;
  const std::size_t begin = kHeaderSize + 4 + kTagSize * tags.size();
  for (const Tag& tag : tags) {
    table += std::string(tag.name) + big_endian(static_cast<std::uint32_t>(begin + contents.size())) +
             big_endian(static_cast<std::uint32_t>(tag.content.size()));
    contents += tag.content;
    contents.resize((contents.size() + 3) / 4 * 4, '\0');
  }
  return header(begin + contents.size()) + table + contents;
}

}  // namespace dspm
