// The examples of docs/language.md: scenes and parts of scenes parse without a word; wrong ones get the text that
// follows.
#include <fstream>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/read_file.h"
#include "dspm/lang/directives.h"
#include "dspm/lang/formatter.h"
#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

struct Fence {
  std::string kind, text;
};

std::vector<Fence> fences() {
  std::ifstream page(std::string(DSPM_SOURCE_DIR) + "/docs/language.md");
  std::vector<Fence> found;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) found.push_back({line.substr(3), ""});
    } else if (inside) {
      found.back().text += line + "\n";
    }
  }
  return found;
}

TEST(Documentation, ExamplesAreTrue) {
  const std::vector<Fence> all = fences();
  int scenes = 0, parts = 0, errors = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].kind == "dsc") {
      good(all[i].text);
      ++scenes;
    } else if (all[i].kind == "dsc part") {
      good("Frames 25\nWorldBegin\n" + all[i].text);
      ++parts;
    } else if (all[i].kind == "dsc error") {
      ASSERT_LT(i + 1, all.size());
      EXPECT_EQ(parse(all[i].text).messages(), all[i + 1].text);
      ++errors;
    }
  }
  EXPECT_GE(scenes, 2);
  EXPECT_GE(parts, 6);
  EXPECT_GE(errors, 2);
}

TEST(Documentation, NamesEveryDirective) {
  const std::string page = read_file(std::string(DSPM_SOURCE_DIR) + "/docs/language.md");
  for (const std::string& name : directive_names()) EXPECT_NE(page.find(name), page.npos) << name;
}

TEST(Documentation, ExamplesSurviveFormatting) {
  for (const Fence& fence : fences()) {
    if (fence.kind != "dsc") continue;
    Diagnostics diagnostics;
    const std::string once = format_scene({"scene.dsc", fence.text}, diagnostics).value();
    EXPECT_EQ(format_scene({"scene.dsc", once}, diagnostics).value(), once);
    const SceneDescription a = good(fence.text), b = good(once);
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (int number = 1; number <= a.moments; ++number)
      for (std::size_t i = 0; i < a.shapes.size(); ++i)
        EXPECT_EQ(a.shapes[i].world_from_object.at(Moment::numbered(number)),
                  b.shapes[i].world_from_object.at(Moment::numbered(number)));
  }
}

}  // namespace
}  // namespace dspm::test
