// The canonical form. Its properties on real scenes are in corpus_test.cpp.
#include "dspm/lang/formatter.h"

#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

std::string format(const std::string& text) {
  Diagnostics diagnostics;
  const auto formatted = format_scene({"scene.dsc", text}, diagnostics);
  return formatted ? *formatted : "failed";
}

struct Example {
  const char *text, *formatted;
};

TEST(Formatter, WritesTheCanonicalForm) {
  const Example examples[] = {
      {"", ""},
      {"  WorldBegin  ", "WorldBegin\n"},
      {"WorldBegin Shape\"sphere\"\n\"float radius\"\n[ 1 ]", "WorldBegin\nShape \"sphere\" \"float radius\" 1\n"},
      {"AttributeBegin Shape \"a\" AttributeEnd", "AttributeBegin\n  Shape \"a\"\nAttributeEnd\n"},
      {"Ask 1 Zoom 2", "Ask 1\nZoom 2\n"},  // known or not
      {"Translate 1\n2 3 Rotate 1 0 0 1", "Translate 1 2 3\nRotate 1 0 0 1\n"},
      {"Transform[1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]", "Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]\n"},
      {"A\n\n\n\nB", "A\n\nB\n"},
      {"LookAt 0 1\n-5 \"ball\" 0 1 0 Camera \"a\"", "LookAt 0 1 -5 \"ball\" 0 1 0\nCamera \"a\"\n"},
      {"LookAt \"a\" \"b\" 0 1 0 LookAt \"a\" 0 0 0\n0 1 0 # c",
       "LookAt \"a\" \"b\" 0 1 0\nLookAt \"a\" 0 0 0 0 1 0  # c\n"},
      {"Keyframe 1.5s \"string ease\" [\"cubic\"] Identity KeyframeEnd \"string after\" [ \"offset\" ]",
       "Keyframe 1.5s \"string ease\" \"cubic\"\n  Identity\nKeyframeEnd \"string after\" \"offset\"\n"},
      {"\n\n# first\n  # second\nA # third\r\nB", "# first\n# second\nA  # third\nB\n"},
      {"Option \"seed\" 3 ActiveTransform All ColorSpace \"srgb\"",
       "Option \"seed\" 3\nActiveTransform All\nColorSpace \"srgb\"\n"},
      {"MediumInterface \"a\" MediumInterface \"a\" \"b\"", "MediumInterface \"a\"\nMediumInterface \"a\" \"b\"\n"},
      {"Shape \"a\" \"float f\" $x \"string s\" [\"$y\"]", "Shape \"a\" \"float f\" $x \"string s\" \"$y\"\n"},
      {"Shape \"a\" \"rgb c\" [ 1 2 3 ] \"float n\" []", "Shape \"a\" \"rgb c\" [1 2 3] \"float n\" []\n"},
      {"DynamicBegin \"b\" Keyframe 1 Translate 0 1 0 Keyframe 5 Identity KeyframeEnd Shape \"a\" DynamicEnd",
       "DynamicBegin \"b\"\n  Keyframe 1\n    Translate 0 1 0\n  Keyframe 5\n    Identity\n  KeyframeEnd\n"
       "  Shape \"a\"\nDynamicEnd\n"},
  };
  for (const Example& example : examples) EXPECT_EQ(format(example.text), example.formatted);
}

TEST(Formatter, KeepsCommentsWhereTheyStand) {
  EXPECT_EQ(format(R"(Shape "a"  # the shape
  # its size
  "float radius" 1 # in metres
  "rgb c" [1 # red
  # and green
  2 3]
  # behind
Shape "b" "float f" # why
  2)"),
            R"(Shape "a"  # the shape
    # its size
    "float radius" 1  # in metres
    "rgb c" [1  # red
      # and green
      2 3]
# behind
Shape "b"
    "float f"  # why
      2
)");
}

TEST(Formatter, BreaksLongLines) {
  std::string list = "Shape \"trianglemesh\" \"integer indices\" [";
  for (int i = 0; i < 60; ++i) list += std::to_string(i) + " ";
  const std::string formatted = format(list + "]");
  EXPECT_EQ(formatted,
            "Shape \"trianglemesh\"\n"
            "    \"integer indices\" [0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28\n"
            "      29 30 31 32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59]\n");
}

TEST(Formatter, SaysWhatIsNoToken) {
  Diagnostics diagnostics;
  const SourceFile file{"scene.dsc", "Shape \"a"};
  EXPECT_FALSE(format_scene(file, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 1);
}

TEST(Formatter, LeavesNonsenseUnharmed) {
  for (const char* text :
       {"]", "[ [ ]", "1 2 3", "\"a\" \"b\"", "Shape [", "Shape \"a\" ] \"float f\"", "Keyframe", "x # y"}) {
    const std::string once = format(text);
    EXPECT_EQ(format(once), once) << text;
  }
}

}  // namespace
}  // namespace dspm::test
