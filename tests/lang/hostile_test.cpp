// Input that nobody means well with: it may be refused, but must neither crash nor take long.
#include <fmt/format.h>

#include <ctime>
#include <random>

#include "dspm/lang/formatter.h"
#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

const std::string kScene = R"(# a comment
Frames 8 "float fps" 25
LookAt 0 1 -3  0 0 0  0 1 0
Camera "perspective" "float fov@1" 38 "float fov@8" [ 40 ]
Film "rgb" "integer xresolution" 64 "string filename" "a.exr"
WorldBegin
MakeNamedMaterial "m" "string type" "diffuse" "rgb reflectance" [.5 .4 .3]
Texture "t" "float" "constant" "float value" 2
ObjectBegin "o" Shape "sphere" ObjectEnd
DynamicBegin "d" "integer frames" [2 7]
  Keyframe 1 "string ease" "smooth" Translate 0 1 0  Keyframe 5 Rotate 30 0 1 0  KeyframeEnd
  AttributeBegin NamedMaterial "m" Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0 1 0 0 0 1 0]
  AttributeEnd
  ObjectInstance "o"
DynamicEnd
LightSource "point" "string name" "l"
AxisBegin "x"
  VariationBegin "a" MakeNamedMaterial "m" "string type" "conductor" Show "d" VariationEnd
  VariationBegin "b" Texture "t" "float" "constant" "float value@3" 1 Light "l" "float scale" 2 VariationEnd
AxisEnd
VariationBegin "c" Hide "d" VariationEnd
)";

void read(const std::string& text) {
  for (const char* name : {"scene.dsc", "scene.pbrt"}) {
    const Parsed parsed = parse(text, {{"x", "1"}}, name);
    EXPECT_LE(parsed.diagnostics.error_count(), 60);
    parsed.messages();
  }
  Diagnostics diagnostics;
  const SourceFile file{"scene.dsc", text};
  if (const auto once = format_scene(file, diagnostics)) {
    EXPECT_EQ(format_scene({"scene.dsc", *once}, diagnostics).value_or("failed"), *once) << text;
  }
}

TEST(Hostile, MutatedScenes) {
  std::mt19937 rng(7);
  using namespace std::string_literals;
  const std::string junk = "\"[]#@$\\\n \t\r\0\xFF%-+.e9A"s;
  for (int i = 0; i < 4000; ++i) {
    std::string text = kScene;
    for (int change = 0; change < 1 + i % 8; ++change) {
      const std::size_t at = rng() % text.size(), length = rng() % 12;
      switch (rng() % 4) {
        case 0: text[at] = junk[rng() % junk.size()]; break;
        case 1: text.erase(at, length); break;
        case 2: text.insert(at, text.substr(rng() % text.size(), length)); break;
        default: text.insert(at, 1, junk[rng() % junk.size()]); break;
      }
      if (text.empty()) text.push_back('A');
    }
    read(text);
    if (HasFailure()) return;
  }
}

TEST(Hostile, EveryPrefix) {
  for (std::size_t length = 0; length < kScene.size(); ++length) read(kScene.substr(0, length));
}

TEST(Hostile, RandomBytes) {
  std::mt19937 rng(3);
  for (int i = 0; i < 300; ++i) {
    std::string bytes(rng() % 3000, '\0');
    for (char& c : bytes) c = static_cast<char>(rng());
    read(bytes);
  }
}

double seconds_for(const std::string& text) {
  const std::clock_t start = std::clock();  // of this process: others may keep the machine busy
  parse(text).messages();
  Diagnostics diagnostics;
  format_scene({"scene.dsc", text}, diagnostics);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

/// With 0, 1, 2, ... put in.
std::string numbered(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += fmt::format(fmt::runtime(text), i);
  return result;
}

/// A megabyte of each takes far less than a second when the time is linear, minutes when it is quadratic.
TEST(Hostile, TakesLinearTime) {
  const std::pair<const char*, std::string> cases[] = {
      {"WorldBegin {}", repeated("AttributeBegin ", 70000)},
      {"WorldBegin {}", repeated("AttributeEnd ", 70000)},
      {"WorldBegin {}", repeated("Shape \"a\" ", 100000)},
      {"WorldBegin Shape \"a\" {}", repeated("\"float f\" 1 ", 80000)},
      {"WorldBegin Shape \"a\" \"float {}\" 1", repeated("x", 1000000)},
      {"WorldBegin Shape \"a\" \"float f\" [{}", repeated("1 ", 500000)},
      {"WorldBegin Shape \"a\" \"string f\" [{}", repeated("\"b\" ", 250000)},
      {"WorldBegin {}", repeated("[", 1000000)},
      {"WorldBegin {}", repeated("\"", 1000000)},
      {"{}", repeated("A", 1000000)},
      {"{}", repeated("1", 1000000)},
      {"Translate {} 1 1", repeated("9", 1000000)},
      {"Translate 0.{}1 1 1", repeated("0", 1000000)},
      {"{}Oops", repeated("\n", 1000000)},
      {"{}", std::string(1000000, '\0')},
      {"WorldBegin {}", repeated("$y ", 300000)},
      {"WorldBegin {}", repeated("# c\n", 250000)},
      {"WorldBegin DynamicBegin \"a\" {}", repeated("Keyframe 1 Translate 1 0 0 ", 40000)},
      {"WorldBegin {}", repeated("VariationBegin \"a\" Hide \"b\" VariationEnd ", 30000)},
      {"WorldBegin AxisBegin \"x\" {}", numbered("VariationBegin \"{}\" Hide \"b\" VariationEnd ", 30000)},
      {"WorldBegin DynamicBegin \"b\" DynamicEnd {}",
       numbered("VariationBegin \"{}\" Hide \"b\" VariationEnd ", 30000)},
      {"WorldBegin {}", repeated("AxisBegin \"a\" ", 70000)},
      {"WorldBegin {}", numbered("AxisBegin \"{}\" VariationBegin \"a\" Hide \"b\" VariationEnd AxisEnd ", 15000)},
      {"WorldBegin DynamicBegin \"b\" DynamicEnd {}",
       numbered("AxisBegin \"{}\" VariationBegin \"a\" Hide \"b\" VariationEnd AxisEnd ", 15000)},
      {"WorldBegin {}", repeated("Texture \"a\" \"float\" \"b\" ", 40000)},
  };
  for (const auto& [frame, filling] : cases)
    EXPECT_LT(seconds_for(fmt::format(fmt::runtime(frame), filling)), 2) << frame << " " << filling.substr(0, 40);
}

TEST(Hostile, NestingIsLimited) {
  const Parsed parsed = parse(fmt::format("WorldBegin\n{}", repeated("AttributeBegin\n", 1001)));
  ASSERT_FALSE(parsed.diagnostics.all().empty());
  EXPECT_EQ(parsed.diagnostics.all()[0].message, "blocks are nested more than 1000 deep");
  EXPECT_EQ(parsed.diagnostics.all()[0].where.line, 1002);
}

// Also by variations that belong to none, as those behind an axis too many do.
TEST(Hostile, AxesAreLimited) {
  const std::string axes = numbered("AxisBegin \"{}\" VariationBegin \"a\" Hide \"b\" VariationEnd AxisEnd\n", 1000);
  const Parsed parsed = parse("WorldBegin DynamicBegin \"b\" DynamicEnd\n" + axes);
  EXPECT_NE(parsed.messages().find("scene.dsc:66:1: error: there are more than 64 axes"), std::string::npos);
  EXPECT_LE(parsed.scene.axes.size(), 65u);
}

}  // namespace
}  // namespace dspm::test
