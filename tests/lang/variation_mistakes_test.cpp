// What bad axes and variations get: the message, what is underlined, and the way out.
#include <fmt/format.h>

#include "tests/lang/parsing.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

struct Mistake {
  const char* text;                   // behind kBase, which has 5 lines
  std::vector<const char*> messages;  // line:column: message | hint
};

constexpr const char* kBase =
    "Frames 5 WorldBegin LightSource \"point\" \"string name\" \"key\"\n"
    "MakeNamedMaterial \"legs\" \"string type\" \"diffuse\"\n"
    "MakeNamedMaterial \"seat\" \"string type\" \"diffuse\"\n"
    "Texture \"cloth\" \"spectrum\" \"constant\"\n"
    "DynamicBegin \"cushion\" DynamicEnd\n";

class VariationMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(VariationMistakes, AreTold) {
  const Parsed parsed = parse(std::string(kBase) + GetParam().text);
  std::vector<std::string> messages;
  for (const Diagnostic& each : parsed.diagnostics.all())
    messages.push_back(fmt::format("{}:{}: {} | {}", each.where.line, each.where.column, each.message, each.hint));
  const std::vector<std::string> expected(GetParam().messages.begin(), GetParam().messages.end());
  EXPECT_EQ(messages, expected) << GetParam().text;
}

const Mistake kPlaces[] = {
    {"AxisBegin \"a\"\nVariationBegin \"b\" Shape \"sphere\" VariationEnd AxisEnd",
     {"7:20: Shape cannot stand in VariationBegin \"b\" of line 7 | a variation holds MakeNamedMaterial, Texture, "
      "Light, Show and Hide"}},
    {"AxisBegin \"a\"\nShow \"cushion\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd",
     {"7:1: Show must stand in a variation | VariationBegin \"a name\" begins one"}},
    {"AxisBegin \"a\"\nTranslate 1 2 3\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd",
     {"7:1: Translate cannot stand in AxisBegin \"a\" of line 6 | an axis holds VariationBegin .. VariationEnd"}},
    {"Light \"key\" \"float scale\" 2",
     {"6:1: Light must stand in a variation | LightSource makes a light; VariationBegin \"a name\" begins a "
      "variation"}},
    {"AttributeBegin\nAxisBegin \"a\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd\nAttributeEnd",
     {"7:1: AxisBegin inside AttributeBegin of line 6 | AttributeEnd must stand before it"}},
    {"DynamicBegin \"d\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd\nDynamicEnd",
     {"7:1: VariationBegin inside DynamicBegin \"d\" of line 6 | DynamicEnd must stand before it"}},
    {"ObjectBegin \"o\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd\nObjectEnd",
     {"7:1: VariationBegin inside ObjectBegin \"o\" of line 6 | ObjectEnd must stand before it"}},
    {"AxisBegin \"a\"\nAxisBegin \"b\"\nVariationBegin \"c\" Show \"cushion\" VariationEnd\nAxisEnd AxisEnd",
     {"7:1: AxisBegin inside AxisBegin \"a\" of line 6 | AxisEnd must stand before it"}},
    {"VariationBegin \"a\"\nShow \"cushion\"\nVariationBegin \"b\"\nHide \"cushion\" VariationEnd VariationEnd",
     {"8:1: VariationBegin inside VariationBegin \"a\" of line 6 | VariationEnd must stand before it"}},
    {"AxisBegin \"a\" VariationBegin \"b\" Show \"cushion\"",
     {"6:1: AxisBegin \"a\" is not closed | AxisEnd is missing",
      "6:15: VariationBegin \"b\" is not closed | VariationEnd is missing"}},
    {"AxisBegin \"a\"\nVariationBegin \"b\" Show \"cushion\"\nAxisEnd",
     {"8:1: AxisEnd closes VariationBegin \"b\" of line 7 | VariationBegin ends with VariationEnd"}},
    {"VariationEnd", {"6:1: VariationEnd without VariationBegin | "}},
    {"AxisEnd", {"6:1: AxisEnd without AxisBegin | "}},
};
INSTANTIATE_TEST_SUITE_P(Places, VariationMistakes, testing::ValuesIn(kPlaces));

const Mistake kNames[] = {
    {"AxisBegin \"a\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd\nAxisBegin \"a\"\nVariationBegin "
     "\"c\" Show \"cushion\" VariationEnd AxisEnd",
     {"8:11: AxisBegin \"a\" a second time | the first stands in scene.dsc:6"}},
    {"VariationBegin \"b\" Show \"cushion\" VariationEnd\nVariationBegin \"b\" Hide \"cushion\" VariationEnd",
     {"7:16: VariationBegin \"b\" a second time | the first stands in scene.dsc:6"}},
    {"AxisBegin \"a\" AxisEnd",
     {"6:1: AxisBegin \"a\" holds no variation | VariationBegin \"a name\" .. VariationEnd makes one"}},
    {"AxisBegin \"\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd", {"6:11: an axis needs a name | "}},
    {"VariationBegin \"b\" VariationEnd",
     {"6:1: VariationBegin \"b\" replaces nothing | a variation holds MakeNamedMaterial, Texture, Light, Show or Hide; "
      "what shall stay as it is is defined again"}},
    {"VariationBegin \"a/b\" Show \"cushion\" VariationEnd",
     {"6:16: \"a/b\" cannot be part of a file's name | images are named after variations: up to 100 characters, none "
      "of / \\ : * ? \" < > |"}},
    {"VariationBegin \"\" Show \"cushion\" VariationEnd",
     {"6:16: \"\" cannot be part of a file's name | images are named after variations: up to 100 characters, none of / "
      "\\ : * ? \" < > |"}},
    {"VariationBegin \"..\" Show \"cushion\" VariationEnd",
     {"6:16: \"..\" cannot be part of a file's name | images are named after variations: up to 100 characters, none of "
      "/ \\ : * ? \" < > |"}},
    {"AxisBegin \"x\" VariationBegin \"a\" Show \"cushion\" VariationEnd\n"
     "VariationBegin \"a-b\" Show \"cushion\" VariationEnd AxisEnd\n"
     "AxisBegin \"y\" VariationBegin \"b-c\" Show \"cushion\" VariationEnd\n"
     "VariationBegin \"c\" Show \"cushion\" VariationEnd AxisEnd",
     {"7:16: two variations of the product are named \"a-b-c\" | one of them with \"a\", one with \"a-b\": give one of "
      "these another name"}},
};
INSTANTIATE_TEST_SUITE_P(Names, VariationMistakes, testing::ValuesIn(kNames));

const Mistake kContents[] = {
    {"VariationBegin \"b\" MakeNamedMaterial \"saet\" \"string type\" \"diffuse\" VariationEnd",
     {"6:20: the scene has no material named \"saet\" | did you mean \"seat\"? there are: legs, seat"}},
    {"VariationBegin \"b\" Texture \"wood\" \"spectrum\" \"constant\" VariationEnd",
     {"6:20: the scene has no spectrum texture named \"wood\" | there are: cloth"}},
    {"VariationBegin \"b\" Texture \"cloth\" \"float\" \"constant\" VariationEnd",
     {"6:20: the scene has no float texture named \"cloth\" | Texture defines one"}},
    {"VariationBegin \"b\" Light \"kye\" \"float scale\" 2 VariationEnd",
     {"6:26: the scene has no light named \"kye\" | did you mean \"key\"? there are: key"}},
    {"VariationBegin \"b\" Hide \"seat\" VariationEnd",
     {"6:25: the scene has no Dynamic block named \"seat\" | there are: cushion"}},
    {"VariationBegin \"b\" Show \"cushion\" Hide \"cushion\" VariationEnd",
     {"6:40: Hide \"cushion\" a second time | the first stands in scene.dsc:6"}},
    {"VariationBegin \"b\" Light \"key\" VariationEnd",
     {"6:20: Light \"key\" changes nothing | \"float scale\" 0.5 halves its strength"}},
    {"VariationBegin \"b\" Light \"key\" \"float scale\" -1 VariationEnd",
     {"6:32: \"scale\" of Light must not be below 0 | "}},
    {"VariationBegin \"b\" MakeNamedMaterial \"seat\" \"rgb reflectance\" [1 0 0] VariationEnd",
     {"6:20: MakeNamedMaterial \"seat\" needs a \"string type\" | "}},
    {"VariationBegin \"b\" Light \"key\" \"float scale@9\" 2 VariationEnd",
     {"6:32: this key for frame 9 lies outside: the scene has 5 frames | "}},
};
INSTANTIATE_TEST_SUITE_P(Contents, VariationMistakes, testing::ValuesIn(kContents));

TEST(VariationMistakes, ManyCombinationsTakeAChoice) {
  std::string text = kBase;
  for (int a = 0; a < 5; ++a) {
    text += fmt::format("AxisBegin \"a{}\"\n", a);
    for (int v = 0; v < 10; ++v) text += fmt::format("VariationBegin \"{}\" Show \"cushion\" VariationEnd\n", v);
    text += "AxisEnd\n";
  }
  const Parsed parsed = parse(text);
  EXPECT_EQ(parsed.messages(),
            "scene.dsc:6:1: error: the axes make 10 x 10 x 10 x 10 x 10 = 100000 variations, more than 10000\n"
            "    6 | AxisBegin \"a0\"\n"
            "      | ^~~~~~~~~\n"
            "  --variation 'oak-*' chooses some by their names\n");
  Diagnostics diagnostics;
  parse_text("scene.dsc", text, {{}, {"*"}}, diagnostics);
  ASSERT_EQ(diagnostics.error_count(), 1);
  EXPECT_NE(diagnostics.all()[0].message.find("--variation chooses more than 10000"), std::string::npos);
}

TEST(VariationMistakes, ManyVariationsOfLongAnimationsTakeAChoice) {
  std::string text = "Frames 5000 WorldBegin MakeNamedMaterial \"seat\" \"string type\" \"diffuse\"\nAxisBegin \"a\"\n";
  for (int i = 0; i < 21; ++i)
    text +=
        fmt::format("VariationBegin \"{}\" MakeNamedMaterial \"seat\" \"string type\" \"diffuse\" VariationEnd\n", i);
  const Parsed parsed = parse(text + "AxisEnd");
  ASSERT_EQ(parsed.diagnostics.error_count(), 1);
  EXPECT_EQ(parsed.diagnostics.all()[0].message, "the axes make 21 variations, more than 20 of 5000 frames");
}

TEST(VariationMistakes, AnAxisStandsAfterWorldBegin) {
  EXPECT_EQ(parse("AxisBegin \"a\"\nVariationBegin \"b\" VariationEnd AxisEnd\n").diagnostics.all()[0].message,
            "AxisBegin must stand after WorldBegin");
}

TEST(VariationMistakes, NothingIsImportedInto) {
  const TemporaryDirectory directory;
  put_file(directory / "part.dsc", "Material \"diffuse\"\n");
  const Parsed parsed = parse(std::string(kBase) + "VariationBegin \"b\"\nImport \"part.dsc\" VariationEnd", {},
                              (directory / "scene.dsc").string());
  ASSERT_EQ(parsed.diagnostics.error_count(), 1) << parsed.messages();
  EXPECT_EQ(parsed.diagnostics.all()[0].message, "Import cannot stand in VariationBegin \"b\" of line 6");
}

TEST(VariationMistakes, OfIncludedFilesPointIntoThem) {
  const TemporaryDirectory directory;
  put_file(directory / "fabrics.dsc",
           "VariationBegin \"wool\" Show \"cushion\" VariationEnd\nVariationBegin \"silk\"\n");
  const Parsed parsed = parse(std::string(kBase) + "AxisBegin \"seat\"\nInclude \"fabrics.dsc\"\nAxisEnd\n", {},
                              (directory / "scene.dsc").string());
  ASSERT_EQ(parsed.diagnostics.error_count(), 1) << parsed.messages();
  const std::string messages = parsed.messages();
  EXPECT_NE(messages.find("scene.dsc:8:1: error: AxisEnd closes VariationBegin \"silk\" of "), messages.npos)
      << messages;
  EXPECT_NE(messages.find("fabrics.dsc:2\n"), messages.npos) << messages;
}

}  // namespace
}  // namespace dspm::test
