// PLY files: the same mesh in all three formats, what properties mean, and files that lie.
#include "dspm/shapes/ply.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "tests/shapes/making.h"
#include "tests/shapes/random.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

const std::string kHeader =
    "comment a pyramid\nelement vertex 5\nproperty float x\nproperty double y\nproperty float z\n"
    "property uchar quality\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float s\n"
    "property float t\nelement face 3\nproperty short face_indices\nproperty list uchar int vertex_indices\n"
    "element edge 1\nproperty int a\nproperty list uint8 uint16 more\nend_header\n";

/// Numbers as PLY types, in the one or the other order of bytes.
class Bytes {
 public:
  explicit Bytes(bool big) : big_(big) {}
  template <class T>
  Bytes& put(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (big_) std::reverse(bytes, bytes + sizeof(T));
    text.append(bytes, sizeof(T));
    return *this;
  }
  std::string text;

 private:
  bool big_;
};

const float kVertices[5][8] = {{-1, -1, 0, 0, 0, 1, 0, 0},
                               {1, -1, 0, 0, 0, 1, 1, 0},
                               {1, 1, 0, 0, 0, 1, 1, 1},
                               {-1, 1, 0, 0, 0, 1, 0, 1},
                               {0, 0, 0.1f, 0, 0, 1, 0.5f, 0.5f}};

std::string binary(bool big) {
  Bytes b(big);
  for (const auto& v : kVertices) {
    b.put(v[0]).put(double{v[1]}).put(v[2]).put(std::uint8_t{7});
    for (int i = 3; i < 8; ++i) b.put(v[i]);
  }
  const std::vector<std::vector<std::int32_t>> faces{{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}};
  for (const auto& face : faces) {
    b.put(std::int16_t{-3}).put(static_cast<std::uint8_t>(face.size()));
    for (const auto v : face) b.put(v);
  }
  b.put(std::int32_t{1}).put(std::uint8_t{2}).put(std::uint16_t{8}).put(std::uint16_t{9});
  return (big ? "ply\nformat binary_big_endian 1.0\n" : "ply\nformat binary_little_endian 1.0\n") + kHeader + b.text;
}

std::string ascii() {
  std::string text = "ply\r\nformat ascii 1.0\r\n" + kHeader;
  for (const auto& v : kVertices)
    text += fmt::format("{} {} {:+} 7 {} {} {} {} {}\n", v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]);
  return text + "-3 4 0 1 2 3\n-3 3 0 1 4\n-3 3 1 2 4\n1 2 8 9\n";
}

void expect_pyramid(const MeshData& mesh) {
  ASSERT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[2], (Vec3{1, 1, 0}));
  EXPECT_EQ(mesh.vertices[4], (Vec3{0, 0, 0.1f}));
  EXPECT_EQ(mesh.normals[1], (Vec3{0, 0, 1}));
  EXPECT_EQ(mesh.uvs[4], (Vec2{0.5f, 0.5f}));
  EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {1, 2, 4}}));
}

std::string message(const std::string& file) {
  try {
    read_ply(file);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

TEST(Ply, AllFormatsGiveTheSameMesh) {
  expect_pyramid(read_ply(ascii()));
  expect_pyramid(read_ply(binary(false)));
  expect_pyramid(read_ply(binary(true)));
}

// The numbers of a binary file follow the header's last line end at once, whatever they are.
TEST(Ply, HeadersMayHaveAMarkAndAnyLineEnds) {
  for (const std::string& file : {ascii(), binary(false), binary(true)})
    for (const std::string end : {"\n", "\r", "\r\n"}) {
      const std::size_t size = file.find("end_header\n") + 11;
      std::string head = file.substr(0, size);
      std::erase(head, '\r');
      for (std::size_t at = 0; (at = head.find('\n', at)) != head.npos; at += end.size()) head.replace(at, 1, end);
      expect_pyramid(read_ply(head + file.substr(size)));
      expect_pyramid(read_ply("\xEF\xBB\xBF" + head + file.substr(size)));
    }
}

// As the Stanford scans have them: the second triangle of a strip is the other way round, and -1 begins another.
TEST(Ply, StripsAreTriangles) {
  const auto mesh = [](const std::string& type, const std::string& strip) {
    return read_ply(
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int " +
        type + " vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0\n" + strip);
  };
  const std::vector<Face> faces{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {3, 4, 5}};
  EXPECT_EQ(mesh("int", "9 0 1 2 3 4 -1 3 4 5").faces, faces);
  EXPECT_EQ(mesh("uint", "9 0 1 2 3 4 4294967295 3 4 5").faces, faces);
  EXPECT_EQ(mesh("int", "7 0 1 2 2 2 3 4").faces, (std::vector<Face>{{0, 1, 2}, {2, 3, 4}})) << "a corner turned";
  EXPECT_EQ(mesh("int", "4 0 1 -1 2").faces.size(), 0u);
  EXPECT_THROW(mesh("int", "3 0 1 6"), std::runtime_error);
  EXPECT_THROW(mesh("int", "3 0 1 -2"), std::runtime_error);
}

TEST(Ply, PluginReadsCompressedFiles) {
  const test::TemporaryDirectory directory;
  const std::string name = (directory / "pyramid.ply.gz").string(), bytes = binary(true);
  const gzFile file = gzopen(name.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  ParamList list{{test::param(ParamType::text, "filename", std::vector<std::string>{name})}};
  Diagnostics diagnostics;
  const auto made = test::make_shapes("plymesh", list, diagnostics);
  ASSERT_EQ(test::messages(diagnostics), "");
  ASSERT_EQ(made.size(), 1u);
  EXPECT_EQ(made[0].shape->primitive_count(), 4);

  const std::string whole = test::contents(name);
  test::put_file(name, whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(test::make_shapes("plymesh", list, diagnostics).empty());
  EXPECT_NE(test::messages(diagnostics).find("ends early"), std::string::npos);
}

TEST(Ply, FaultsSayWhatAndWhere) {
  EXPECT_EQ(message("solid x\n"), "this is not a PLY file");
  EXPECT_EQ(message("ply\nformat ascii 1.0\n"), "the PLY header does not end");
  EXPECT_EQ(message("ply\nelement vertex 0\nend_header\n"), "the header has no format line (line 3)");
  EXPECT_EQ(message("ply\nformat ascii 1.0\nelement vertex many\n"), "\"many\" is not a count (line 3)");
  EXPECT_EQ(message("ply\nelement vertex 1\nproperty real x\n"), "unknown number type (line 3)");
  for (const char* type : {"float", "double"})
    EXPECT_NE(message(std::string("ply\nformat ascii 1.0\nelement face 1\nproperty list ") + type +
                      " int vertex_indices\nend_header\n3 0 1 2\n")
                  .find("(line 4)"),
              std::string::npos)
        << "a count is a whole number, not a " << type;
  EXPECT_EQ(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
            "vertices have no x, y, z (in \"vertex\" 0 of 1)");
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0 ";
  EXPECT_EQ(message(head), "the file ends early (in \"vertex\" 2 of 3)");
  EXPECT_EQ(message(head + "0 1 O"), "this is not a number (in \"vertex\" 2 of 3)");
  EXPECT_EQ(message(head + "0 1 0\n3 0 1 -1"), "-1 is not a vertex index (in \"face\" 0 of 1)");
  EXPECT_EQ(message(head + "0 1 0\n3 0 1 3"), "a face refers to vertex 3 of 3");
  EXPECT_EQ(message(head + "0 1 0\n-3 0 1 3"), "this is not the count of a list (in \"face\" 0 of 1)");
}

// Counts far beyond the data cost neither memory nor time.
TEST(Ply, AnnouncedCountsAreNotBelieved) {
  const std::string huge = "18446744073709551615";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_NE(message("ply\nformat binary_little_endian 1.0\nelement vertex " + huge + "\n" + xyz + "end_header\nabc")
                .find("ends early"),
            std::string::npos);
  EXPECT_NE(message("ply\nformat ascii 1.0\nelement nothing " + huge + "\nelement vertex " + huge + "\n" + xyz +
                    "element face " + huge + "\nproperty list uint uint vertex_index\nend_header\n1 2 3")
                .find("ends early"),
            std::string::npos);
  EXPECT_NE(message("ply\nformat binary_big_endian 1.0\nelement face 1\nproperty list uint uchar vertex_index\n"
                    "end_header\n\xff\xff\xff\xff")
                .find("not the count"),
            std::string::npos);
}

// Bytes that are changed, cut off or repeated never crash the reader, nor get a bad index through.
TEST(Ply, DamagedFilesAreErrorsOrMeshes) {
  test::Random random(32);
  const std::string files[] = {ascii(), binary(false), binary(true)};
  for (int i = 0; i < 60'000; ++i) {
    std::string file = files[i % 3];
    for (int k = random.below(4); k >= 0; --k)
      file[static_cast<std::size_t>(random.below(static_cast<int>(file.size())))] =
          static_cast<char>(random.below(256));
    if (random.below(4) == 0) file.resize(static_cast<std::size_t>(random.below(static_cast<int>(file.size()))));
    try {
      const MeshData mesh = read_ply(file);
      for (const Face& f : mesh.faces)
        for (const int v : f) ASSERT_TRUE(v >= 0 && v < static_cast<int>(mesh.vertices.size()));
    } catch (const std::runtime_error&) {}
  }
}

// Colours in whole numbers are a picture's: 188 of 255 is half of the light. Opacities are as they are.
TEST(Ply, ColoursTangentsAndSecondTextureCoordinates) {
  const auto triangle = [](const std::string& type, const std::string& red) {
    const std::string colour = " " + red + " 0 0 " + red + " ";
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty " +
           type + " red\nproperty " + type + " green\nproperty " + type + " blue\nproperty " + type +
           " alpha\nproperty float u2\nproperty float v2\nproperty float tx\nproperty float ty\nproperty float "
           "tz\nproperty float tw\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0" +
           colour + "1 2 3 4 5 1\n1 0 0" + colour + "1 2 3 4 5 -1\n0 1 0" + colour + "6 7 3 4 5 1\n3 0 1 2\n";
  };
  const MeshData whole = read_ply(triangle("uchar", "188"));
  ASSERT_EQ(whole.colours.size(), 3u);
  EXPECT_NEAR(whole.colours[1][0], 0.503f, 1e-3f);
  EXPECT_EQ(whole.colours[1][1], 0);
  EXPECT_EQ(whole.colours[1][3], 188 / 255.f);
  ASSERT_EQ(whole.second_uvs.size(), 3u);
  EXPECT_EQ(whole.second_uvs[2], (Vec2{6, 7}));
  ASSERT_EQ(whole.tangents.size(), 3u);
  EXPECT_EQ(whole.tangents[0], (Vec3{3, 4, 5}));
  EXPECT_EQ(whole.turned, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(read_ply(triangle("float", "0.25")).colours[2][0], 0.25f);
  EXPECT_NEAR(read_ply(triangle("ushort", "48316")).colours[2][0], 0.503f, 1e-3f);
}

}  // namespace
}  // namespace dspm
