// Resuming after variations were edited or taken away: the frames that had them start anew, the others lose nothing.
#include <map>

#include "tests/checkpoint/chair.h"

namespace dspm::test {
namespace changed_variations_test {

class ChangedVariations : public ChairTest {
 protected:
  /// Against the image of a run without interruption; how its interval adds up may round otherwise.
  void expect_as_before(const std::string& label, const Image& before) const {
    const Image now = read_image(file(label));
    ASSERT_EQ(now.pixels.size(), before.pixels.size());
    for (std::size_t i = 0; i < now.pixels.size(); ++i)
      ASSERT_NEAR(luminance(now.pixels[i]), luminance(before.pixels[i]), 1e-4f * luminance(before.pixels[i]))
          << label << ", pixel " << i;
  }
  /// Images of all four variations after so many iterations.
  std::map<std::string, Image> uninterrupted(const Product& product, int iterations) {
    put(product.text());
    good({"--iterations", std::to_string(iterations)});
    std::map<std::string, Image> images;
    for (const char* label : {"oak-plain", "oak-dim", "steel-plain", "steel-dim"})
      images[label] = read_image(file(label));
    return images;
  }
};

TEST_F(ChangedVariations, StartAnewAndTheOthersGoOn) {
  Product product;
  std::map<std::string, Image> before = uninterrupted(product, 5);
  begin(product);
  product.oak = ".2 .3 .8";
  put(product.text());
  const Outcome outcome = good({"--resume", "a", "--iterations", "5"});
  EXPECT_NE(outcome.err.find("material \"legs\" of variation \"oak\" has changed since the checkpoint"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("these start anew: oak-plain, oak-dim\n"), std::string::npos) << outcome.err;
  for (const char* label : {"steel-plain", "steel-dim"}) expect_as_before(label, before[label]);
  const std::vector<std::vector<std::string>> parted = {{"steel-plain", "steel-dim"}, {"oak-plain", "oak-dim"}};
  EXPECT_EQ(intervals(), parted);
  // As those of a run of their own, which knows what the checkpoint's frames decide.
  Choices choices;
  choices.known = known;
  TestScene reference(product.text(), choices);
  const std::unique_ptr<Scene> scene = reference.scene({FileFrame(0), FileFrame(1)});
  const std::unique_ptr<Integrator> made = reference.integrator(*scene);
  for (int i = 0; i < 5; ++i) made->iterate({i, *scene});
  EXPECT_EQ(read_image(file("oak-plain")), made->estimate(0));
  EXPECT_EQ(read_image(file("oak-dim")), made->estimate(1));
}

TEST_F(ChangedVariations, GoOnHoweverOftenTheyChange) {
  Product product;
  std::map<std::string, Image> before = uninterrupted(product, 6);
  begin(product);
  for (const char* more : {"4", "5"}) {
    product.oak = more == std::string("4") ? ".2 .3 .8" : ".9 .3 .1";
    put(product.text());
    good({"--resume", "a", "--iterations", more});
  }
  const Outcome outcome = good({"--resume", "a", "--iterations", "6"});  // nothing has changed now
  EXPECT_EQ(outcome.err.find("anew"), std::string::npos) << outcome.err;
  for (const char* label : {"steel-plain", "steel-dim"}) expect_as_before(label, before[label]);
  EXPECT_EQ(iterations("oak-plain"), 6);
}

// Else they would be given up, and nobody would render them.
TEST_F(ChangedVariations, AreNotLeftToOnlyNew) {
  Product product;
  begin(product, {"--iterations", "1"});
  const std::string before = contents(directory / "a");
  product.oak = ".2 .3 .8", product.last_legs = kBrass;
  put(product.text());
  const Outcome outcome = dspm({"--resume", "a", "--only-new"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("material \"legs\" of variation \"oak\" has changed since the checkpoint"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("dspm: --only-new: what has changed is not new; resume without --only-new"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(contents(directory / "a"), before);
}

// Whoever edits a variation and asks for what is new learns what was edited, not that there is nothing to do.
TEST_F(ChangedVariations, AreNamedIfNothingIsNew) {
  Product product;
  begin(product, {"--iterations", "1"});
  const Outcome same = dspm({"--resume", "a", "--only-new"});
  EXPECT_EQ(same.err, "dspm: --only-new: the checkpoint holds all chosen frames already\n");
  product.oak = ".2 .3 .8";
  put(product.text());
  const Outcome outcome = dspm({"--resume", "a", "--only-new"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("material \"legs\" of variation \"oak\" has changed since the checkpoint"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("these start anew: oak-plain, oak-dim"), std::string::npos) << outcome.err;
}

TEST_F(ChangedVariations, MayBeTakenAwayAndComeBack) {
  Product product;
  std::map<std::string, Image> before = uninterrupted(product, 5);
  begin(product);
  product.more = "AxisExclude \"oak\"";
  put(product.text());
  const Outcome outcome = good({"--resume", "a", "--iterations", "4"});
  EXPECT_NE(outcome.err.find("given up: oak-plain, oak-dim of the checkpoint, not there any more"), std::string::npos)
      << outcome.err;
  product.more = "";
  put(product.text());
  good({"--resume", "a", "--iterations", "5"});
  for (const char* label : {"steel-plain", "steel-dim"}) expect_as_before(label, before[label]);
  EXPECT_EQ(iterations("oak-plain"), 5);
}

TEST_F(ChangedVariations, AreRefusedIfNobodyCouldGoOn) {
  Product product;
  begin(product, {"--iterations", "1"});
  const std::string before = contents(directory / "a");
  const auto expect_refused = [&](const Product& changed, const std::string& told) {
    put(changed.text());
    const Outcome outcome = dspm({"--resume", "a"});
    EXPECT_EQ(outcome.code, 1) << told;
    EXPECT_NE(outcome.err.find(told), std::string::npos) << told << "\n" << outcome.err;
    EXPECT_EQ(contents(directory / "a"), before);
  };
  Product brighter = product;
  brighter.key = ".9";
  expect_refused(brighter,
                 "how lights are chosen, or the sphere around everything, has changed since the checkpoint\n");
  expect_refused(brighter, "variation \"dim\" has changed since the checkpoint\n");
  Product other = product;
  other.more = "AxisExclude \"steel\"", other.oak = ".1 .1 .1";
  expect_refused(other, "material \"legs\" of variation \"oak\" has changed since the checkpoint\n");
  expect_refused(other, "steel-plain, steel-dim of the checkpoint, not there any more\n");
  other.more = "AxisExclude \"oak\"\nAxisExclude \"steel\"", other.last_legs = kBrass;
  expect_refused(other, "no variation that the checkpoint was begun with is there any more\n");
}

}  // namespace changed_variations_test
}  // namespace dspm::test
