// What the user sees of a mistake.
#include "dspm/base/params/errors.h"

#include <gtest/gtest.h>

namespace dspm {
namespace {

TEST(Diagnostic, ShowsTheLineAndTheHint) {
  std::string text(13, '\n');
  text += "  Material \"diffuse\" \"rgb reflectence\" [.7 .68 .65]\n";
  const SourceFile file{"drop.dsc", text};
  EXPECT_EQ(to_string({Severity::error,
                       {&file, 14, 22, 17},
                       "unknown parameter \"reflectence\" of material \"diffuse\"",
                       "did you mean \"reflectance\"? (dspm --describe material:diffuse lists them all)"}),
            "drop.dsc:14:22: error: unknown parameter \"reflectence\" of material \"diffuse\"\n"
            "   14 |   Material \"diffuse\" \"rgb reflectence\" [.7 .68 .65]\n"
            "      |                      ^~~~~~~~~~~~~~~~~\n"
            "  did you mean \"reflectance\"? (dspm --describe material:diffuse lists them all)\n");
}

TEST(Diagnostic, ManagesWithoutAPlace) {
  const SourceFile file{"a.dsc", ""};
  EXPECT_EQ(to_string({Severity::warning, {}, "odd", ""}), "warning: odd\n");
  EXPECT_EQ(to_string({Severity::note, {&file}, "odd", ""}), "a.dsc: note: odd\n");
  EXPECT_EQ(to_string({Severity::note, {&file, 7, 9, 3}, "odd", ""}), "a.dsc:7:9: note: odd\n    7 | \n      | ^\n");
}

TEST(Diagnostic, ClipsLongLines) {
  const SourceFile file{"a.dsc", std::string(500, 'x') + "HERE" + std::string(500, 'y')};
  EXPECT_EQ(to_string({Severity::error, {&file, 1, 501, 4}, "odd", ""}),
            "a.dsc:1:501: error: odd\n"
            "    1 | ..." +
                std::string(50, 'x') + "HERE" + std::string(46, 'y') +
                "...\n"
                "      |    " +
                std::string(50, ' ') + "^~~~\n");
}

TEST(Diagnostic, CountsCharactersNotBytesAndTabsAsOne) {
  const SourceFile file{"a.dsc", "\t\"\xC3\xA4\xC3\xB6\" Oops\x01"};
  EXPECT_EQ(to_string({Severity::error, {&file, 1, 9, 4}, "odd", ""}),
            "a.dsc:1:9: error: odd\n    1 |  \"\xC3\xA4\xC3\xB6\" Oops?\n      |       ^~~~\n");
}

TEST(Names, TheNearestComeFirst) {
  const std::vector<std::string> names{"reflectance", "transmittance", "roughness", "uroughness", "vroughness", "eta"};
  EXPECT_EQ(nearest_names("reflectence", names), std::vector<std::string>{"reflectance"});
  EXPECT_EQ(nearest_names("roughnes", names), (std::vector<std::string>{"roughness", "uroughness", "vroughness"}));
  EXPECT_EQ(nearest_names("aet", {"eta", "eat"}), std::vector<std::string>{"eat"});
  EXPECT_EQ(nearest_names("Eta", names), std::vector<std::string>{"eta"});
  EXPECT_EQ(nearest_names("colour", names), std::vector<std::string>{});
  EXPECT_EQ(nearest_names("x", {"y"}), std::vector<std::string>{});
  EXPECT_EQ(did_you_mean("roughnes", names), "did you mean \"roughness\", \"uroughness\" or \"vroughness\"?");
  EXPECT_EQ(did_you_mean("x", names), "");
}

TEST(Names, OtherRenderersWordsAreKnown) {
  const std::vector<std::string> materials{"coateddiffuse", "conductor", "dielectric", "diffuse", "principled"};
  EXPECT_EQ(did_you_mean("glass", materials), "did you mean \"dielectric\"?");
  EXPECT_EQ(did_you_mean("plastic", materials), "did you mean \"coateddiffuse\" or \"principled\"?");
  EXPECT_EQ(did_you_mean("standard_surface", materials), "did you mean \"principled\"?");
  EXPECT_EQ(did_you_mean("matte", {"sphere"}), "");
  EXPECT_EQ(did_you_mean("Base_Color", {"basecolor", "coat"}), "did you mean \"basecolor\"?");
}

TEST(Diagnostics, LenientTurnsWhatIsLackingIntoWarnings) {
  Diagnostics strict, lenient(true);
  strict.unsupported({}, "no media");
  lenient.unsupported({}, "no media");
  EXPECT_EQ(strict.error_count(), 1);
  EXPECT_EQ(lenient.error_count(), 0);
  EXPECT_EQ(lenient.all().at(0).severity, Severity::warning);
  EXPECT_THROW(strict.throw_if_errors(), SceneError);
  EXPECT_NO_THROW(lenient.throw_if_errors());
}

TEST(Diagnostics, ThrowsTheFirstTwenty) {
  Diagnostics diagnostics;
  diagnostics.warning({}, "never mind");
  for (int i = 1; i <= 23; ++i) diagnostics.error({}, "mistake " + std::to_string(i));
  try {
    diagnostics.throw_if_errors();
    FAIL();
  } catch (const SceneError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("error: mistake 1\n"));
    EXPECT_TRUE(text.ends_with("error: mistake 20\n... and 3 more errors\n"));
  }
}

}  // namespace
}  // namespace dspm
