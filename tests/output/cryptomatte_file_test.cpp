// Cryptomattes in files, read as the specification's decoders do: from what the header says, and nothing else.
#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <regex>
#include <set>

#include "dspm/image/exr.h"
#include "dspm/integrators/output_info.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace cryptomatte_file_test {

struct Cryptomatte {
  std::string name, hash, conversion, manifest;
  /// "ball": the float whose bits are the manifest's hexadecimal digits.
  std::map<std::string, float> ids() const {
    std::map<std::string, float> ids;
    const std::regex entry("\"([^\"]+)\": \"([0-9a-f]{8})\"");
    for (std::sregex_iterator at(manifest.begin(), manifest.end(), entry), end; at != end; ++at)
      ids[(*at)[1]] = std::bit_cast<float>(static_cast<std::uint32_t>(std::stoul((*at)[2], nullptr, 16)));
    return ids;
  }
};

/// By key, the seven digits.
std::map<std::string, Cryptomatte> cryptomattes_in(const ExrHeader& header) {
  std::map<std::string, Cryptomatte> all;
  const std::regex attribute("cryptomatte/([0-9a-f]{7})/(name|hash|conversion|manifest)");
  for (const auto& [name, text] : header.texts)
    if (std::smatch parts; std::regex_match(name, parts, attribute)) {
      Cryptomatte& one = all[parts[1]];
      (parts[2] == "name"         ? one.name
       : parts[2] == "hash"       ? one.hash
       : parts[2] == "conversion" ? one.conversion
                                  : one.manifest) = text;
    }
  return all;
}

/// Channels of a Cryptomatte in the order of ranks: id, share, id, share, ...
std::vector<std::string> ranks_of(const ExrHeader& header, const std::string& name) {
  std::vector<std::string> channels;
  for (int layer = 0; layer < 100; ++layer)
    for (const char* letter : {"r", "g", "b", "a"}) {
      const std::string channel = name + (layer < 10 ? "0" : "") + std::to_string(layer) + "." + letter;
      if (std::find(header.channels.begin(), header.channels.end(), channel) == header.channels.end()) return channels;
      channels.push_back(channel);
    }
  return channels;
}

void expect_decodable(const std::filesystem::path& file, const std::set<std::string>& names) {
  const ExrHeader header = read_exr_header(file);
  const auto all = cryptomattes_in(header);
  std::set<std::string> found;
  for (const auto& [key, cryptomatte] : all) {
    found.insert(cryptomatte.name);
    char digits[9];
    std::snprintf(digits, sizeof digits, "%08x", name_hash(cryptomatte.name));
    EXPECT_EQ(key, std::string(digits).substr(0, 7));
    EXPECT_EQ(cryptomatte.hash, "MurmurHash3_32");
    EXPECT_EQ(cryptomatte.conversion, "uint32_to_float32");
    std::set<float> ids;
    for (const auto& [name, id] : cryptomatte.ids()) {
      EXPECT_EQ(id, id_of(name)) << name;
      ids.insert(id);
    }
    const std::vector<std::string> channels = ranks_of(header, cryptomatte.name);
    ASSERT_EQ(channels.size(), 12U) << "three layers";
    std::vector<float> sums;
    for (std::size_t rank = 0; rank < channels.size(); rank += 2) {
      const Image pairs = read_exr_channels(file, {channels[rank], channels[rank + 1]});
      sums.resize(pairs.pixels.size());
      for (std::size_t i = 0; i < pairs.pixels.size(); ++i) {
        if (pairs.pixels[i].g > 0) {
          EXPECT_TRUE(ids.contains(pairs.pixels[i].r)) << "in the manifest";
        }
        sums[i] += pairs.pixels[i].g;
      }
    }
    for (const float sum : sums) EXPECT_NEAR(sum, 1, 1e-6f) << "the tiny scene is in a room";
  }
  EXPECT_EQ(found, names);
}

TEST(CryptomatteFile, IsDecodable) {
  const TinyDirectory directory;
  const std::vector<std::string> asked = {"tiny.dsc", "--aov", "cryptoobject,cryptomaterial"};
  const std::set<std::string> both = {"CryptoObject", "CryptoMaterial"};
  const Outcome outcome = run(directory, asked);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* image : kTinyImages) expect_decodable(directory / image, both);
  const auto cryptomattes = cryptomattes_in(read_exr_header(directory / kTinyImages[1]));
  for (const auto& [key, cryptomatte] : cryptomattes)
    if (cryptomatte.name == "CryptoObject") {
      EXPECT_TRUE(cryptomatte.ids().contains("ball"));
    }
  // Lossy compression spares them.
  ASSERT_EQ(run(directory, asked + Arguments{"--compression", "dwaa"}).code, 0);
  expect_decodable(directory / kTinyImages[1], both);
  ASSERT_EQ(run(directory, asked + Arguments{"--aov-files"}).code, 0);
  expect_decodable(directory / "tiny.cryptoobject.0002.exr", {"CryptoObject"});
  expect_decodable(directory / "tiny.cryptomaterial.0002.exr", {"CryptoMaterial"});
  expect_decodable(directory / kTinyImages[1], {});
  const Outcome half = run(directory, asked + Arguments{"--half=cryptoobject"});
  EXPECT_EQ(half.code, 2);
}

// The transparent film's alpha lies where compositors and our own reader look for it.
TEST(CryptomatteFile, AlphaIsChannelA) {
  const TemporaryDirectory directory;
  std::string scene = kTinyScene;
  scene.replace(scene.find("Film \"rgb\""), 10, "Film \"rgb\" \"bool transparent\" true");
  scene.replace(scene.find("float radius\" 29"), 16, "float radius\" .1");
  put_file(directory / "tiny.dsc", scene);
  const Outcome outcome = run(directory, {"tiny.dsc", "--iterations", "32"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Image image = read_image(directory / kTinyImages[1]);
  ASSERT_EQ(image.alpha.size(), image.pixels.size());
  EXPECT_EQ(image.alpha.front(), 0);
  const float most = *std::max_element(image.alpha.begin(), image.alpha.end());
  EXPECT_GT(most, 0.5f) << "the ball in the middle covers two pixels each way";
  EXPECT_LE(most, 1);
}

TEST(CryptomatteFile, ThereIsNoneOfThatNameAlone) {
  const TinyDirectory directory;
  const Outcome outcome = run(directory, {"tiny.dsc", "--aov", "cryptomatte"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("there are two, \"cryptoobject\" and \"cryptomaterial\""), std::string::npos)
      << outcome.err;
}

}  // namespace cryptomatte_file_test
}  // namespace dspm::test
