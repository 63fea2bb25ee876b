// Numbers, triangles and faults of glTF files, by hand.
#include <gtest/gtest.h>

#include "dspm/lang/gltf/accessor.h"
#include "dspm/lang/gltf/primitive.h"
#include "dspm/lang/gltf/translation.h"
#include "dspm/lang/gltf/uri.h"
#include "tests/gltf/gltf_file.h"

namespace dspm::gltf {
namespace {

using test::GltfFile, test::Square;

Document document(const std::string& text) { return Document("/nowhere/test.gltf", text); }

std::string fault_of(const std::string& text) try {
  translate(std::make_shared<const Document>("/nowhere/test.gltf", text), "test.gltf", {});
  return "";
} catch (const std::runtime_error& error) {
  return error.what();
}

constexpr const char* kOneMesh =
    R"("scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}])";

TEST(Uri, DataAndEscapes) {
  EXPECT_EQ(data_of_uri("data:text/plain;base64,aGk="), "hi");
  EXPECT_EQ(data_of_uri("data:,a%20b"), "a b");
  EXPECT_FALSE(data_of_uri("chair.bin"));
  EXPECT_EQ(unescaped("a%20chair%2.bin"), "a chair%2.bin");
  EXPECT_THROW(data_of_uri("data:;base64,?"), std::runtime_error);
}

TEST(Accessors, NormalisedIntegersAreShares) {
  GltfFile file;
  file.add(std::vector<std::uint8_t>{0, 51, 255, 0}, "SCALAR", 5121, 1, R"(,"normalized":true)");
  file.add(std::vector<std::int8_t>{-128, -127, 0, 127}, "SCALAR", 5120, 1, R"(,"normalized":true)");
  const Document d = document(file.text(R"("nodes":[])"));
  EXPECT_EQ(numbers_of(d, 0).values, (std::vector<float>{0, 0.2f, 1, 0}));
  EXPECT_EQ(numbers_of(d, 1).values, (std::vector<float>{-1, -1, 0, 1}));
}

TEST(Accessors, SparseValuesReplaceOthers) {
  GltfFile file;
  file.add(std::vector<std::uint16_t>{1, 3}, "SCALAR", 5123, 1);
  file.add_floats({7, 9}, "SCALAR", 1);
  file.add_floats({1, 2, 3, 4}, "SCALAR", 1);
  const std::string sparse =
      R"("sparse":{"count":2,"indices":{"bufferView":0,"componentType":5123},"values":{"bufferView":1}})";
  const std::string text = file.text(R"("nodes":[])");
  const auto with = [&](const std::string& accessor) {
    std::string changed = text;
    return changed.insert(changed.find(R"("accessors":[)") + 13, accessor + ",");
  };
  EXPECT_EQ(
      numbers_of(document(with(R"({"bufferView":2,"componentType":5126,"count":4,"type":"SCALAR",)" + sparse + "}")), 0)
          .values,
      (std::vector<float>{1, 7, 3, 9}));
  EXPECT_EQ(numbers_of(document(with(R"({"componentType":5126,"count":4,"type":"SCALAR",)" + sparse + "}")), 0).values,
            (std::vector<float>{0, 7, 0, 9}));
}

TEST(Primitives, StripsAndFansBecomeTriangles) {
  using Faces = std::vector<std::array<std::uint32_t, 3>>;
  GltfFile file;
  const int positions = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 2, 0}, "VEC3", 3);
  const auto faces = [&](int mode) {
    const std::string primitive = fmt::format(R"({{"attributes":{{"POSITION":{}}},"mode":{}}})", positions, mode);
    const Document d = document(file.text(fmt::format(kOneMesh, primitive)));
    return read_primitive(d, d["meshes"][0]["primitives"][0]).faces;
  };
  EXPECT_EQ(faces(4), (Faces{{0, 1, 2}}));
  EXPECT_EQ(faces(5), (Faces{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(faces(6), (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(Primitives, MorphTargetsAndJointsMoveVertices) {
  Primitive p;
  p.positions = {1, 3, {1, 0, 0}};
  p.targets.push_back({{1, 3, {0, 2, 0}}, {}, {}});
  p.joints = {{1, 4, {0, 1, 0, 0}}}, p.weights = {{1, 4, {0.5f, 0.5f, 0, 0}}};
  pose(p, {0.5}, {Matrix4::translate(0, 0, 2), Matrix4::translate(4, 0, 0)});
  EXPECT_EQ(p.positions.values, (std::vector<float>{3, 1, 1}));
}

TEST(Faults, AreNamedWithTheirPlace) {
  GltfFile file;
  const Square square(file);
  const int far = file.add(std::vector<std::uint16_t>{0, 1, 9}, "SCALAR", 5123, 1);
  const auto mesh = [&](const std::string& primitive) { return file.text(fmt::format(kOneMesh, primitive)); };
  EXPECT_EQ(fault_of(mesh(square.primitive())), "");
  EXPECT_EQ(fault_of(mesh(fmt::format(R"({{"attributes":{{"POSITION":0}},"indices":{}}})", far))),
            "meshes/0/primitives/0/indices: there is no vertex 9: there are 4");
  EXPECT_EQ(fault_of(mesh(R"({"attributes":{"POSITION":77}})")),
            "meshes/0/primitives/0/attributes/POSITION: there is no number 77: there are 4");
  EXPECT_EQ(fault_of(mesh(square.primitive(R"(,"mode":"x")"))), "meshes/0/primitives/0/mode: a number is expected");
  EXPECT_EQ(fault_of(file.text(R"("nodes":[{"children":[1]},{"children":[0]}])")),
            "nodes/0: its parents form a ring, or are more than 200");
  EXPECT_EQ(fault_of(file.text(R"("extensionsRequired":["KHR_texture_basisu"])")),
            "it requires the extension KHR_texture_basisu, which dspm does not read");
  EXPECT_EQ(fault_of(R"({"asset":{"version":"1.0"}})"), "it is of glTF 1.0, and dspm reads glTF 2");
  EXPECT_EQ(fault_of(R"({"asset":{"version":"20.0"}})"), "it is of glTF 20.0, and dspm reads glTF 2");
  EXPECT_EQ(fault_of(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"),
            "it needs glTF 2.1, and dspm reads glTF 2.0");
  EXPECT_EQ(fault_of(R"({"asset":{}})"), "it is not a glTF file: asset/version is missing");
  EXPECT_LT(fault_of("{\"a\": x" + std::string(100'000, 'y') + "}").size(), 300u);
  EXPECT_LT(fault_of(R"({"asset":{"version":")" + std::string(100'000, '7') + "\"}}").size(), 100u);
  EXPECT_EQ(fault_of(file.text(R"("nodes":[])")),
            "its scene has nothing to show: no meshes with surfaces, and no lights");
  EXPECT_NE(fault_of("{").find("it is not a glTF file"), std::string::npos);
}

TEST(Uris, HaveSchemesAndTypesOfAnyCase) {
  for (const char* uri : {"data:text/plain;base64,YWI=", "DATA:Text/Plain;BASE64,YWI=", "Data:,ab", "data:;x=y,a%62"})
    EXPECT_EQ(data_of_uri(uri), "ab") << uri;
  EXPECT_EQ(data_of_uri("datas/a.bin"), std::nullopt);
  EXPECT_EQ(type_of_data_uri("DATA:Image/PNG;base64,"), "image/png");
}

}  // namespace
}  // namespace dspm::gltf
