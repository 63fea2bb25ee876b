// What bad axes and variations get: the message, what is underlined, and the way out.
#include <fmt/format.h>

#include "tests/lang/parsing.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace {

struct VariationMistake {
  const char* text;                   // behind kBase, which has 5 lines
  std::vector<const char*> messages;  // line:column: message | hint
};

constexpr const char* kBase =
    "Frames 5 WorldBegin LightSource \"point\" \"string name\" \"key\"\n"
    "MakeNamedMaterial \"legs\" \"string type\" \"diffuse\"\n"
    "MakeNamedMaterial \"seat\" \"string type\" \"diffuse\"\n"
    "Texture \"cloth\" \"spectrum\" \"constant\"\n"
    "DynamicBegin \"cushion\" DynamicEnd\n";

class VariationMistakes : public testing::TestWithParam<VariationMistake> {};

TEST_P(VariationMistakes, AreTold) {
  const Parsed parsed = parse(std::string(kBase) + GetParam().text);
  std::vector<std::string> messages;
  for (const Diagnostic& each : parsed.diagnostics.all())
    messages.push_back(fmt::format("{}:{}: {} | {}", each.where.line, each.where.column, each.message, each.hint));
  const std::vector<std::string> expected(GetParam().messages.begin(), GetParam().messages.end());
  EXPECT_EQ(messages, expected) << GetParam().text;
}

const VariationMistake kPlaces[] = {
    {"AxisBegin \"a\"\nVariationBegin \"b\" Shape \"sphere\" VariationEnd AxisEnd",
     {"7:20: Shape is not allowed in VariationBegin \"b\" (line 7) | a variation contains MakeNamedMaterial, "
      "MakeNamedMedium, "
      "Texture, Light, LightSource, AreaLightSource, Show, Hide, Dynamic blocks, Camera and Integrator"}},
    {"AxisBegin \"a\"\nShow \"cushion\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd",
     {"7:1: Show is only allowed in a variation | VariationBegin \"a name\" begins one"}},
    {"AxisBegin \"a\"\nTranslate 1 2 3\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd",
     {"7:1: Translate is not allowed in AxisBegin \"a\" (line 6) | an axis contains only VariationBegin .. "
      "VariationEnd"}},
    {"Light \"key\" \"float scale\" 2",
     {"6:1: Light is only allowed in a variation | LightSource defines a light; VariationBegin \"a name\" begins a "
      "variation"}},
    {"AttributeBegin\nAxisBegin \"a\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd\nAttributeEnd",
     {"7:1: AxisBegin inside AttributeBegin (line 6) | AttributeEnd must come before it"}},
    {"DynamicBegin \"d\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd\nDynamicEnd",
     {"7:1: VariationBegin inside DynamicBegin \"d\" (line 6) | DynamicEnd must come before it"}},
    {"ObjectBegin \"o\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd\nObjectEnd",
     {"7:1: VariationBegin inside ObjectBegin \"o\" (line 6) | ObjectEnd must come before it"}},
    {"AxisBegin \"a\"\nAxisBegin \"b\"\nVariationBegin \"c\" Show \"cushion\" VariationEnd\nAxisEnd AxisEnd",
     {"7:1: AxisBegin inside AxisBegin \"a\" (line 6) | AxisEnd must come before it"}},
    {"VariationBegin \"a\"\nShow \"cushion\"\nVariationBegin \"b\"\nHide \"cushion\" VariationEnd VariationEnd",
     {"8:1: VariationBegin inside VariationBegin \"a\" (line 6) | VariationEnd must come before it"}},
    {"AxisBegin \"a\" VariationBegin \"b\" Show \"cushion\"",
     {"6:1: AxisBegin \"a\" is not closed | AxisEnd is missing",
      "6:15: VariationBegin \"b\" is not closed | VariationEnd is missing"}},
    {"AxisBegin \"a\"\nVariationBegin \"b\" Show \"cushion\"\nAxisEnd",
     {"8:1: AxisEnd does not match VariationBegin \"b\" (line 7) | VariationBegin ends with VariationEnd"}},
    {"VariationEnd", {"6:1: VariationEnd without VariationBegin | "}},
    {"AxisEnd", {"6:1: AxisEnd without AxisBegin | "}},
};
INSTANTIATE_TEST_SUITE_P(Places, VariationMistakes, testing::ValuesIn(kPlaces));

const VariationMistake kVariationNames[] = {
    {"AxisBegin \"a\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd\nAxisBegin \"a\"\nVariationBegin "
     "\"c\" Show \"cushion\" VariationEnd AxisEnd",
     {"8:11: AxisBegin \"a\" appears twice | the first is at scene.dsc:6"}},
    {"VariationBegin \"b\" Show \"cushion\" VariationEnd\nVariationBegin \"b\" Hide \"cushion\" VariationEnd",
     {"7:16: VariationBegin \"b\" appears twice | the first is at scene.dsc:6"}},
    {"AxisBegin \"a\" AxisEnd",
     {"6:1: AxisBegin \"a\" contains no variation | define one with VariationBegin \"a name\" .. VariationEnd"}},
    {"AxisBegin \"\"\nVariationBegin \"b\" Show \"cushion\" VariationEnd AxisEnd", {"6:11: an axis needs a name | "}},
    {"AxisBegin \"a\" VariationBegin \"b\" VariationEnd VariationBegin \"red\" VariationEnd AxisEnd\n"
     "AxisExclude \"b\" \"rde\"\nAxisOnly \"A:b\" \"a:red\" \"a:x\"",
     {"7:17: no variation is named \"rde\" | did you mean \"red\"?",
      "8:10: there is no axis \"A\" | did you mean \"a\"?", "8:24: no variation is named \"x\" | "}},
    {"AxisBegin \"a\" VariationBegin \"b\" VariationEnd VariationBegin \"c\" VariationEnd AxisEnd\n"
     "AxisExclude \"b\"\nAxisOnly \"b\"",
     {"7:1: AxisExclude and AxisOnly leave no variation | "}},
    {"VariationBegin \"a\" AxisExclude \"a\" VariationEnd",
     {"6:20: AxisExclude inside VariationBegin \"a\" (line 6) | VariationEnd must come before it"}},
    {"VariationBegin \"a/b\" Show \"cushion\" VariationEnd",
     {"6:16: \"a/b\" cannot be part of a file name | images are named after variations: up to 100 characters, none "
      "of / \\ : * ? \" < > |"}},
    {"VariationBegin \"\" Show \"cushion\" VariationEnd",
     {"6:16: \"\" cannot be part of a file name | images are named after variations: up to 100 characters, none of / "
      "\\ : * ? \" < > |"}},
    {"VariationBegin \"..\" Show \"cushion\" VariationEnd",
     {"6:16: \"..\" cannot be part of a file name | images are named after variations: up to 100 characters, none of "
      "/ \\ : * ? \" < > |"}},
    {"AxisBegin \"x\" VariationBegin \"a\" Show \"cushion\" VariationEnd\n"
     "VariationBegin \"a-b\" Show \"cushion\" VariationEnd AxisEnd\n"
     "AxisBegin \"y\" VariationBegin \"b-c\" Show \"cushion\" VariationEnd\n"
     "VariationBegin \"c\" Show \"cushion\" VariationEnd AxisEnd",
     {"7:16: two variations of the product are named \"a-b-c\" | one has \"a\", the other \"a-b\": rename one of "
      "these"}},
};
INSTANTIATE_TEST_SUITE_P(Names, VariationMistakes, testing::ValuesIn(kVariationNames));

const VariationMistake kContents[] = {
    {"VariationBegin \"b\" MakeNamedMaterial \"saet\" \"string type\" \"diffuse\" VariationEnd",
     {"6:20: the scene has no material named \"saet\" | did you mean \"seat\"? available: legs, seat"}},
    {"VariationBegin \"b\" Texture \"wood\" \"spectrum\" \"constant\" VariationEnd",
     {"6:20: the scene has no spectrum texture named \"wood\" | available: cloth"}},
    {"VariationBegin \"b\" Texture \"cloth\" \"float\" \"constant\" VariationEnd",
     {"6:20: the scene has no float texture named \"cloth\" | define it with Texture"}},
    {"VariationBegin \"b\" Light \"kye\" \"float scale\" 2 VariationEnd",
     {"6:26: the scene has no light named \"kye\" | did you mean \"key\"? available: key"}},
    {"VariationBegin \"b\" Hide \"seat\" VariationEnd",
     {"6:25: the scene has no Dynamic block named \"seat\" | available: cushion"}},
    {"VariationBegin \"b\" Show \"cushion\" Hide \"cushion\" VariationEnd",
     {"6:40: Hide \"cushion\" appears twice | the first is at scene.dsc:6"}},
    {"VariationBegin \"b\" Light \"key\" VariationEnd",
     {"6:20: Light \"key\" changes nothing | \"float scale\" 0.5 halves its strength"}},
    {"VariationBegin \"b\" Light \"key\" \"float scale\" -1 VariationEnd",
     {"6:32: \"scale\" of Light must not be negative | "}},
    {"VariationBegin \"b\" MakeNamedMaterial \"seat\" \"rgb reflectance\" [1 0 0] VariationEnd",
     {"6:20: MakeNamedMaterial \"seat\" needs a \"string type\" | "}},
    {"VariationBegin \"b\" Light \"key\" \"float scale@9\" 2 VariationEnd",
     {"6:32: this key for frame 9 is out of range: the scene has 5 frames | "}},
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
            "  choose some by name: --variation 'oak-*'\n");
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
            "AxisBegin must come after WorldBegin");
}

TEST(VariationMistakes, NothingIsImportedInto) {
  const TemporaryDirectory directory;
  put_file(directory / "part.dsc", "Material \"diffuse\"\n");
  const Parsed parsed = parse(std::string(kBase) + "VariationBegin \"b\"\nImport \"part.dsc\" VariationEnd", {},
                              (directory / "scene.dsc").string());
  ASSERT_EQ(parsed.diagnostics.error_count(), 1) << parsed.messages();
  EXPECT_EQ(parsed.diagnostics.all()[0].message, "Import is not allowed in VariationBegin \"b\" (line 6)");
}

TEST(VariationMistakes, OfIncludedFilesPointIntoThem) {
  const TemporaryDirectory directory;
  put_file(directory / "fabrics.dsc",
           "VariationBegin \"wool\" Show \"cushion\" VariationEnd\nVariationBegin \"silk\"\n");
  const Parsed parsed = parse(std::string(kBase) + "AxisBegin \"seat\"\nInclude \"fabrics.dsc\"\nAxisEnd\n", {},
                              (directory / "scene.dsc").string());
  ASSERT_EQ(parsed.diagnostics.error_count(), 1) << parsed.messages();
  const std::string messages = parsed.messages();
  EXPECT_NE(messages.find("scene.dsc:8:1: error: AxisEnd does not match VariationBegin \"silk\" ("), messages.npos)
      << messages;
  EXPECT_NE(messages.find("fabrics.dsc:2)\n"), messages.npos) << messages;
}

}  // namespace
}  // namespace dspm::test
