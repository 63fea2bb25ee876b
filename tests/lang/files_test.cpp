// Scenes of several files: Include and Import, gzip, -D, and what can be wrong with files.
#include <fmt/format.h>
#include <zlib.h>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/read_file.h"
#include "tests/lang/parsing.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

class Files : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((directory / name).parent_path());
    put_file(directory / name, text);
  }

  /// The messages, without the directory's name.
  std::string parse(const std::vector<std::string>& names, const Defines& defines = {}) {
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back((directory / name).string());
    Diagnostics diagnostics;
    scene = parse_files(paths, {defines}, diagnostics);
    std::string messages;
    for (const Diagnostic& each : diagnostics.all()) messages += to_string(each);
    const std::string prefix = (directory / "").string();
    for (std::size_t at; (at = messages.find(prefix)) != messages.npos;) messages.erase(at, prefix.size());
    return messages;
  }

  TemporaryDirectory directory;
  SceneDescription scene;
};

std::string gzip(const std::string& text) {
  std::string packed(text.size() + 100, '\0');
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

TEST_F(Files, IncludeIsTextual) {
  put("main.dsc", "WorldBegin\nInclude \"parts/a.dsc\"\nShape \"after\"\nAttributeEnd");
  put("parts/a.dsc", "AttributeBegin\nTranslate 1 0 0\nInclude \"b.dsc\"\n");
  put("parts/b.dsc", "Shape \"in b\"");
  EXPECT_EQ(parse({"main.dsc"}), "");
  ASSERT_EQ(scene.shapes.size(), 2u);
  expect_near(scene.shapes[1].world_from_object.at(Moment()), Matrix4::translate(1, 0, 0));
  EXPECT_EQ(scene.shapes[0].where.file->name, (directory / "parts/b.dsc").string());
}

TEST_F(Files, MayHaveAMarkAndAnyLineEnds) {
  for (const char* text : {"\xEF\xBB\xBFWorldBegin\n# none\nShape \"a\"\nInclude \"b.dsc\"\n",
                           "# none\rWorldBegin # none\rShape \"a\"\rInclude \"b.dsc\"\r",
                           "\xEF\xBB\xBFWorldBegin\r\nShape \"a\"\r\n\r\nInclude \"b.dsc\""}) {
    put("main.dsc", text);
    put("b.dsc", "\xEF\xBB\xBF# a comment\rShape \"b\"\rAttributeEnd");
    EXPECT_NE(parse({"main.dsc"}).find("b.dsc:3:1: error"), std::string::npos);
    EXPECT_EQ(scene.shapes.size(), 2u) << text;
  }
}

TEST_F(Files, SayWhatIsNoPlainText) {
  using namespace std::string_literals;
  put("main.dsc", "\xFF\xFEW\0o\0r\0"s);
  EXPECT_EQ(parse({"main.dsc"}), "error: cannot read \"main.dsc\": it is text in UTF-16: save it as UTF-8\n");
  put("main.dsc",
      "WorldBegin\nTranslate\xC2\xA0"
      "1 2 3\nScale 1 2\xC2\xA0"
      "3\n\n"
      "Shape \"sphere\" \"float\xC2\xA0radius\" [ 1\xC2\xA0]\n");
  const std::string messages = parse({"main.dsc"});
  for (const char* place : {"2:10", "3:10", "5:22"})
    EXPECT_NE(messages.find(fmt::format("main.dsc:{}: error: this is a no-break space (U+00A0)", place)),
              std::string::npos)
        << place << "\n"
        << messages;
  put("main.dsc", "WorldBegin\nShape \xE2\x80\x9Csphere\xE2\x80\x9D\n");
  const std::string of_quotes = parse({"main.dsc"});
  EXPECT_NE(of_quotes.find("2:7: error: this is a typographic quote (U+201C)"), std::string::npos) << of_quotes;
}

TEST_F(Files, AreLookedForBesideTheNamingFileThenBesideTheMainFile) {
  put("main.dsc", "WorldBegin Include \"parts/a.dsc\"");
  put("parts/a.dsc", "Include \"b.dsc\" Include \"c.dsc\"");
  put("parts/b.dsc", "Shape \"beside\"");
  put("b.dsc", "Shape \"main\"");
  put("c.dsc", "Shape \"main\"");
  EXPECT_EQ(parse({"main.dsc"}), "");
  EXPECT_EQ(scene.shapes.at(0).type, "beside");
  EXPECT_EQ(scene.shapes.at(1).type, "main");
}

TEST_F(Files, ADefineThatNothingUsesIsTold) {
  put("main.dsc", "WorldBegin\nInclude \"a.dsc\"\nShape \"$kind\"");
  put("a.dsc", "Scale $size $size $size");
  EXPECT_EQ(parse({"main.dsc"}, {{"kind", "b"}, {"size", "2"}, {"siz", "3"}}),
            "warning: -D siz: the scene has no $siz\n");
}

TEST_F(Files, ImportLeavesNothingInForce) {
  put("main.dsc", "WorldBegin\nMaterial \"diffuse\"\nTranslate 1 0 0\nImport \"a.dsc\"\nShape \"after\"");
  put("a.dsc",
      "Shape \"first\"\nMaterial \"conductor\"\nScale 2 2 2\nShape \"second\"\n"
      "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"");
  EXPECT_EQ(parse({"main.dsc"}), "");
  ASSERT_EQ(scene.shapes.size(), 3u);
  EXPECT_EQ(scene.shapes[0].material.index, 0);
  EXPECT_EQ(scene.shapes[1].material.index, 1);
  EXPECT_EQ(scene.shapes[2].material.index, 0);
  expect_near(scene.shapes[2].world_from_object.at(Moment()), Matrix4::translate(1, 0, 0));
  EXPECT_EQ(scene.materials.size(), 3u);
}

TEST_F(Files, ImportedFilesCloseTheirOwnBlocks) {
  put("main.dsc", "WorldBegin\nAttributeBegin\nImport \"a.dsc\"\nAttributeEnd");
  put("a.dsc", "AttributeEnd\nDynamicBegin \"x\"\n");
  EXPECT_EQ(parse({"main.dsc"}),
            "a.dsc:1:1: error: AttributeEnd does not match Import \"a.dsc\" (main.dsc:3)\n"
            "    1 | AttributeEnd\n"
            "      | ^~~~~~~~~~~~\n"
            "  an imported file cannot close blocks that were opened outside it\n"
            "a.dsc:2:1: error: DynamicBegin \"x\" is not closed\n"
            "    2 | DynamicBegin \"x\"\n"
            "      | ^~~~~~~~~~~~\n"
            "  DynamicEnd is missing\n");
}

TEST_F(Files, WrongNestingNamesTheOtherFile) {
  put("main.dsc", "WorldBegin\nInclude \"a.dsc\"\nDynamicEnd");
  put("a.dsc", "AttributeBegin");
  EXPECT_EQ(parse({"main.dsc"}),
            "main.dsc:3:1: error: DynamicEnd does not match AttributeBegin (a.dsc:1)\n"
            "    3 | DynamicEnd\n"
            "      | ^~~~~~~~~~\n"
            "  AttributeBegin ends with AttributeEnd\n");
}

TEST_F(Files, CyclesAreNamed) {
  put("a.dsc", "WorldBegin\nInclude \"b.dsc\"");
  put("b.dsc", "Include \"./c.dsc\"");
  put("c.dsc", "\n  Include \"b.dsc\"");
  EXPECT_EQ(parse({"a.dsc"}),
            "c.dsc:2:11: error: this file includes itself\n"
            "    2 |   Include \"b.dsc\"\n"
            "      |           ^~~~~~~\n"
            "  b.dsc -> c.dsc -> b.dsc\n");
}

TEST_F(Files, IncludesAreLimited) {
  for (int i = 0; i < 80; ++i)
    put("f" + std::to_string(i) + ".dsc",
        (i == 0 ? "WorldBegin Include \"f" : "Include \"f") + std::to_string(i + 1) + ".dsc\"");
  put("f80.dsc", "");
  EXPECT_NE(parse({"f0.dsc"}).find("Include and Import are nested more than 64 deep"), std::string::npos);
  for (int i = 0; i < 40; ++i) {
    const std::string next = "Include \"g" + std::to_string(i + 1) + ".dsc\" ";
    put("g" + std::to_string(i) + ".dsc", (i == 0 ? "WorldBegin " : "") + next + next);
  }
  put("g40.dsc", "");
  EXPECT_NE(parse({"g0.dsc"}).find("more than 50000 files are included"), std::string::npos);
}

TEST_F(Files, MissingOnesAreErrorsAtTheirName) {
  put("main.dsc", "WorldBegin\nInclude \"gone.dsc\"\nImport \".\"\nShape \"a\"");
  EXPECT_EQ(parse({"main.dsc"}),
            "main.dsc:2:9: error: cannot read \"gone.dsc\": there is no such file, or it cannot be read\n"
            "    2 | Include \"gone.dsc\"\n"
            "      |         ^~~~~~~~~~\n"
            "main.dsc:3:8: error: cannot read \"\": it is a directory\n"
            "    3 | Import \".\"\n"
            "      |        ^~~\n");
  EXPECT_EQ(scene.shapes.size(), 1u);
  EXPECT_EQ(parse({"gone.dsc"}), "error: cannot read \"gone.dsc\": there is no such file, or it cannot be read\n");
}

TEST_F(Files, SeveralAreReadAsOne) {
  put("camera.dsc", "Camera \"perspective\" WorldBegin AttributeBegin Translate 1 0 0");
  put("shapes.pbrt", "Shape \"a\" AttributeEnd");
  EXPECT_EQ(parse({"camera.dsc", "shapes.pbrt"}), "");
  EXPECT_EQ(scene.dialect, Dialect::dsc);
  expect_near(scene.shapes.at(0).world_from_object.at(Moment()), Matrix4::translate(1, 0, 0));
}

TEST_F(Files, GzipIsExpanded) {
  put("main.pbrt.gz", gzip("Film \"rgb\"\nWorldBegin\nInclude \"a.pbrt.gz\""));
  put("a.pbrt.gz", gzip("Shape \"a\"\n") + gzip("Shape \"b\"\n"));  // two members
  EXPECT_EQ(parse({"main.pbrt.gz"}), "");
  EXPECT_EQ(scene.dialect, Dialect::pbrt);
  EXPECT_EQ(scene.shapes.size(), 2u);
  std::string large;
  for (int i = 0; i < 100000; ++i) large += std::to_string(i * 7919) + " ";
  EXPECT_EQ(expand_gzip(gzip(large)), large);
}

TEST_F(Files, DamagedGzipIsAnError) {
  const std::string packed = gzip("WorldBegin\nShape \"sphere\"\n");
  for (std::size_t size = 2; size < packed.size(); ++size)
    EXPECT_THROW(expand_gzip(packed.substr(0, size)), std::runtime_error) << size;
  put("main.dsc", "WorldBegin\nInclude \"a.gz\"");
  put("a.gz", packed.substr(0, packed.size() / 2));
  EXPECT_EQ(parse({"main.dsc"}),
            "main.dsc:2:9: error: cannot read \"a.gz\": the gzip data ends early\n"
            "    2 | Include \"a.gz\"\n"
            "      |         ^~~~~~\n");
}

TEST_F(Files, DefinesAreReplaced) {
  put("main.dsc",
      "# $nothing\nFrames $frames\nWorldBegin\nShape \"$kind\" \"float radius\" -$r Shape \"#$kind\"\nOops");
  EXPECT_EQ(parse({"main.dsc"}, {{"frames", "12"}, {"kind", "a long name"}, {"r", "2.5"}}),
            "main.dsc:5:1: error: unknown directive Oops\n"
            "    5 | Oops\n"
            "      | ^~~~\n");
  EXPECT_EQ(scene.moments, 12);
  EXPECT_EQ(scene.shapes.at(0).type, "a long name");
  EXPECT_EQ(floats(scene.shapes[0].params, "radius"), std::vector<float>{-2.5f});
  EXPECT_EQ(scene.shapes.at(1).type, "#a long name");
  EXPECT_EQ(scene.shapes[0].params.params[0].where.column, 15);  // as in the file
  EXPECT_EQ(scene.shapes[0].params.params[0].values_where.column, 30);
  EXPECT_EQ(scene.shapes[0].params.params[0].values_where.length, 3);
}

TEST_F(Files, ReplacedTextIsShownAsWritten) {
  put("main.dsc", "WorldBegin\nTranslate 0 $y 0");
  EXPECT_EQ(parse({"main.dsc"}, {{"y", "high"}}),
            "main.dsc:2:13: error: expected a number\n"
            "    2 | Translate 0 $y 0\n"
            "      |             ^~\n");
  EXPECT_EQ(parse({"main.dsc"}, {{"z", "1"}, {"yy", "1"}}),
            "main.dsc:2:13: error: $y has no value\n"
            "    2 | Translate 0 $y 0\n"
            "      |             ^~\n"
            "  did you mean \"yy\"?\n");
}

}  // namespace
}  // namespace dspm::test
