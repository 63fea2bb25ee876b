// What a small file may cost: the program itself reads files that announce, nest or multiply far more than they hold.
// Each is refused within seconds of work (one on a quiet machine) and below a gigabyte, and the message says what is wrong and where.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>

#include "tests/support/process.h"

namespace dspm::test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kMostSeconds = 30, kMostBytes = 8e9;  // sanitizers take their share
#else
constexpr double kMostSeconds = 4, kMostBytes = 1e9;
#endif

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

/// A box of 8 x 8 pixels, with that before and after WorldBegin.
std::string scene(const std::string& world, const std::string& options = "") {
  return "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
         "Integrator \"dsppm\" \"integer iterations\" 1 \"integer photons\" 10\n" +
         options + "WorldBegin\nLightSource \"point\"\n" + world;
}

class Bounds : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& bytes) {
    ASSERT_LE(bytes.size(), 1'100'000u) << name << " is no small file";
    put_file(directory / name, bytes);
  }

  /// The message holds all of `words`.
  void expect_refused(const std::vector<std::string>& words, const std::string& file = "a.dsc") {
    const Outcome outcome = run(directory, {file, "--quiet"});
    EXPECT_EQ(outcome.code, 1) << outcome.err.substr(0, 1000);
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << "\n" << outcome.err.substr(0, 1000);
    EXPECT_LT(outcome.err.size(), 120'000u);
    EXPECT_LT(outcome.peak_bytes, kMostBytes);
    // On a shared machine the same work takes up to twice the processor time, but not six times in a row.
    double seconds = outcome.cpu_seconds;
    for (int again = 0; again < 5 && seconds >= kMostSeconds; ++again)
      seconds = std::min(seconds, run(directory, {file, "--quiet"}).cpu_seconds);
    EXPECT_LT(seconds, kMostSeconds);
  }
  void expect_refused_scene(const std::string& text, const std::vector<std::string>& words) {
    put("a.dsc", text);
    expect_refused(words);
  }
  void expect_refused_mesh(const std::string& bytes, const std::string& words) {
    put("a.ply", bytes);
    expect_refused_scene(scene("Shape \"plymesh\" \"string filename\" \"a.ply\""), {"a.dsc:5:17", "a.ply", words});
  }
  void expect_refused_image(const std::string& bytes, const std::string& words) {
    put("a.image", bytes);
    expect_refused_scene(scene("LightSource \"infinite\" \"string filename\" \"a.image\""), {"a.dsc:5:", words});
  }

  TemporaryDirectory directory;
};

TEST_F(Bounds, FilesThatIncludeOneAnother) {
  expect_refused_scene("Include \"a.dsc\"", {"a.dsc:1:9", "this file includes itself"});
  put("b.dsc", repeated("Shape \"sphere\"\n", 7'000));
  expect_refused_scene(scene(repeated("Include \"b.dsc\"\n", 3'000)),
                       {"a.dsc:27:9", "including the same files repeatedly adds up to", "ObjectInstance"});
  for (int i = 0; i < 40; ++i) put(fmt::format("f{}.dsc", i), repeated(fmt::format("Include \"f{}.dsc\" ", i + 1), 2));
  put("f40.dsc", "");
  expect_refused_scene("WorldBegin Include \"f0.dsc\"", {"more than 50000 files are included"});
}

TEST_F(Bounds, Devices) {
  expect_refused_scene("WorldBegin Include \"/dev/zero\"", {"a.dsc:1:20", "it is not a regular file"});
  for (const char* shape : {"plymesh", "objmesh"})
    expect_refused_scene(scene(fmt::format("Shape \"{}\" \"string filename\" \"/dev/zero\"", shape)),
                         {"a.dsc:5:", "it is not a regular file"});
}

TEST_F(Bounds, ABillionFrames) {
  expect_refused_scene(scene("", "Frames 1000000000\n"), {"a.dsc:3:1", "a number of frames from 1 to 100000"});
  expect_refused_scene(scene("Keyframe 1000000000 Translate 1 0 0 KeyframeEnd Shape \"sphere\""), {"a.dsc:5:"});
  expect_refused_scene(scene(repeated("AxisBegin \"a\" VariationBegin \"x\" Hide \"p\" VariationEnd AxisEnd\n", 3000)),
                       {"a.dsc:"});
}

TEST_F(Bounds, HugeFilms) {
  for (const char* side : {"100000", "65536", "2147483647"})
    expect_refused_scene(
        fmt::format("Film \"rgb\" \"integer xresolution\" {0} \"integer yresolution\" {0}\nWorldBegin", side),
        {"a.dsc:1:"});
}

TEST_F(Bounds, DeepNesting) {
  for (const char* begin : {"AttributeBegin\n", "TransformBegin\n", "ObjectBegin \"a\"\n", "DynamicBegin \"a\"\n"})
    expect_refused_scene(scene(repeated(begin, 60'000)), {"a.dsc:"});
  const std::string keyed = "DynamicBegin \"d\" Keyframe 1 Translate 0 0 0 Keyframe 2 Rotate 9 1 0 0 KeyframeEnd\n";
  expect_refused_scene(scene(repeated(keyed, 999) + repeated("Shape \"sphere\"\n", 50'000), "Frames 2\n"),
                       {"a.dsc:38:18", "keyed transforms are nested more than 32 deep"});
}

TEST_F(Bounds, TexturesThatDouble) {
  std::string textures = "Texture \"t0\" \"spectrum\" \"constant\"\n";
  for (int i = 1; i <= 60; ++i)
    textures += fmt::format("Texture \"t{}\" \"spectrum\" \"mix\" \"texture tex1\" \"t{}\" \"texture tex2\" \"t{}\"\n",
                            i, i - 1, i - 1);
  expect_refused_scene(scene(textures), {"each lookup of texture \"t9\" takes 1000 others or more"});
}

TEST_F(Bounds, PathsWithoutEnd) {
  for (const char* integrator : {"dsppm", "sppm", "photonmap", "path", "vcm"})
    expect_refused_scene(
        scene("Shape \"sphere\"\n", fmt::format("Integrator \"{}\" \"integer maxdepth\" 10001\n", integrator)),
        {"maxdepth must lie between", "and 10000"});
}

TEST_F(Bounds, NamesWithZeros) {
  using namespace std::string_literals;
  expect_refused_scene(scene("Shape \"plymesh\" \"string filename\" \"a\0.ply\""s),
                       {"a.dsc:5:", "this string contains a zero byte"});
}

TEST_F(Bounds, LongListsInForce) {
  const std::string list = "Attribute \"shape\" \"float a\" [" + repeated("1 ", 400'000) + "]\n";
  expect_refused_scene(scene(list + repeated("AttributeBegin\n", 999)), {"a.dsc:5:1", "defaults for every shape"});
  expect_refused_scene(scene(list + repeated("Shape \"sphere\"\n", 10'000)), {"a.dsc:5:1", "defaults for every shape"});
}

TEST_F(Bounds, NamesOfAMegabyte) {
  const std::string name(1'000'000, 'x');
  for (const char* directive :
       {"Shape \"{}\"", "Shape \"sphere\" \"float {}\" 1", "NamedMaterial \"{}\"", "Include \"{}\"",
        "MakeNamedMaterial \"{}\" \"string type\" \"diffuse\"", "Shape \"plymesh\" \"string filename\" \"{}\""})
    expect_refused_scene(scene(fmt::format(fmt::runtime(directive), name)),
                         {"a.dsc:5:", "this string is longer than 4096 bytes"});
  expect_refused_scene(scene(name), {"a.dsc:5:1"});
  expect_refused_scene(scene("X" + name), {"a.dsc:5:1", "unknown directive Xxxx"});
}

TEST_F(Bounds, HugeNumbers) {
  const std::string digits(1'000'000, '9');
  for (const std::string& number : {digits, fmt::format("1e{}", digits), std::string("1e39"), std::string("0x7fff")})
    expect_refused_scene(scene("Translate 0 " + number + " 0"), {"a.dsc:5:"});
  for (const std::string& number : {digits, std::string("-2147483649"), std::string("4294967296")})
    expect_refused_scene(scene("Shape \"sphere\" \"integer a\" " + number), {"a.dsc:5:"});
  expect_refused_scene(scene("Shape \"loopsubdiv\" \"integer levels\" 2147483647 \"integer indices\" [0 1 2] "
                             "\"point3 P\" [0 0 0 1 0 0 0 1 0]"),
                       {"a.dsc:5:", "levels"});
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

std::string ply(const std::string& elements, const std::string& body, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + body;
}

TEST_F(Bounds, MeshesThatAnnounceABillion) {
  const std::string zeros(100, '\0'), many("\xff\xff\xff\x3f", 4);
  expect_refused_mesh(ply("element vertex 1000000000\n" + kXyz, "0 0 0\n"), "the file ends early");
  expect_refused_mesh(ply("element vertex 1000000000\n" + kXyz, zeros, "binary_little_endian"), "the file ends early");
  const std::string face = "element face 1\nproperty list uint int vertex_indices\n";
  expect_refused_mesh(ply("element vertex 1\n" + kXyz + face, "0 0 0\n1000000000 0 0 0\n"), "the file ends early");
  expect_refused_mesh(ply("element vertex 1\n" + kXyz + face, zeros.substr(0, 12) + many, "binary_little_endian"),
                      "this is not the count of a list");
  expect_refused_mesh(ply("element other 1000000000000000000\nproperty char a\n", zeros, "binary_little_endian"),
                      "the file ends early");
}

TEST_F(Bounds, PolygonsThatWouldTakeHours) {
  constexpr int kCorners = 20'000;
  std::string corners, face = fmt::format("{}", kCorners);
  for (int i = 0; i < kCorners; ++i) {  // a circle with a dent: each corner is compared with all others
    const double angle = 6.283 * i / kCorners, radius = i == kCorners / 4 ? 0.5 : 1;
    corners += fmt::format("{:.9g} {:.9g} 0\n", radius * std::cos(angle), radius * std::sin(angle));
    face += fmt::format(" {}", i);
  }
  expect_refused_mesh(ply(fmt::format("element vertex {}\n", kCorners) + kXyz +
                              "element face 1\nproperty list int int vertex_indices\n",
                          corners + face + "\n"),
                      "polygons are too intricate");
}

std::string big_endian(unsigned n) {
  return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8), static_cast<char>(n)};
}

std::string png_chunk(const std::string& type_and_data) {
  const uLong sum =
      crc32(0, reinterpret_cast<const Bytef*>(type_and_data.data()), static_cast<uInt>(type_and_data.size()));
  return big_endian(static_cast<unsigned>(type_and_data.size() - 4)) + type_and_data +
         big_endian(static_cast<unsigned>(sum));
}

/// As PNG has it with `window` 15, as gzip with 15 + 16.
std::string compressed(std::size_t bytes, char filling, int window) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, window, 9, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(bytes / 500 + 1000, '\0'), chunk(std::size_t{1} << 20, filling);
  stream.next_out = reinterpret_cast<Bytef*>(packed.data()), stream.avail_out = static_cast<uInt>(packed.size());
  for (std::size_t done = 0; done < bytes; done += chunk.size()) {
    stream.next_in = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_in = static_cast<uInt>(std::min(chunk.size(), bytes - done));
    deflate(&stream, done + chunk.size() >= bytes ? Z_FINISH : Z_NO_FLUSH);
  }
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// Grey, one bit a pixel.
std::string png(unsigned width, unsigned height, const std::string& data) {
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR" + big_endian(width) + big_endian(height) + std::string("\1\0\0\0\0", 5)) +
         png_chunk("IDAT" + data) + png_chunk("IEND");
}

TEST_F(Bounds, HugeImages) {
  expect_refused_image(png(100'000, 100'000, ""), "100000 x 100000 pixels are too many");
  expect_refused_image("#?RADIANCE\n\n-Y 100000 +X 100000\n", "100000 x 100000 pixels are too many");
  const std::string whole = compressed(2001u * 16'000, '\0', 15);
  expect_refused_image(png(16'000, 16'000, whole), "16000 x 16000 pixels are too many");
}

TEST_F(Bounds, PicturesOfManyScans) {
  const std::string tables = "\xff\xdb" + std::string("\0\x43\0", 3) + std::string(64, '\1') + "\xff\xc4" +
                             std::string("\0\x14\0\1", 4) + std::string(16, '\0');
  const std::string frame = "\xff\xc2" + std::string("\0\x0b\x08\x10\0\x10\0\1\1\x11\0", 11);  // 4096 x 4096
  const std::string scan = "\xff\xda" + std::string("\0\x08\1\1\0\0\0\0", 8);
  expect_refused_image("\xff\xd8" + tables + frame + repeated(scan, 100'000) + "\xff\xd9", "more than 100 scans");
}

TEST_F(Bounds, ZipBombs) {
  const std::string bomb = repeated(compressed(std::size_t{1} << 23, ' ', 15 + 16), 64);  // half a gigabyte
  put("a.dsc.gz", bomb);
  expect_refused({"a.dsc.gz", "the gzip data expands to more than", "gunzip"}, "a.dsc.gz");
  expect_refused_mesh(bomb, "the gzip data expands to more than");
}

}  // namespace
}  // namespace dspm::test
