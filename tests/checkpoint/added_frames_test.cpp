// Resuming with frames that were added, or chosen, since: those that were there keep their state, and every image is,
// bit by bit, that of a run of all frames with what the checkpoint's first frames decide.
#include "tests/checkpoint/chair.h"

namespace dspm::test {
namespace added_frames_test {

using AddedFrames = ChairTest;

TEST_F(AddedFrames, AreThoseOfARunOfAll) {
  Product product;
  begin(product);
  product.first_seat = kDark, product.last_legs = kBrass;  // among the others, and after them
  put(product.text());
  const Outcome outcome = good({"--resume", "a", "--iterations", "5"});
  EXPECT_NE(outcome.err.find("5 frames added to the checkpoint's"), std::string::npos) << outcome.err;
  expect_all(product.text(), 5, 9);
  // A file with all from the start chooses lights otherwise.
  TestScene anew(product.text());
  EXPECT_NE(read_image(file("oak-plain")), anew.render(FileFrame(1), 5));

  // Once more, at the end of a run that had added some.
  product.first_legs = variation("white", R"(MakeNamedMaterial "legs" "string type" "diffuse")");
  put(product.text());
  good({"--resume", "a", "--iterations", "6", "--memory", "1G"});
  expect_all(product.text(), 6, 12);
}

TEST_F(AddedFrames, OnlyNewOnesGoAsFarAsTheOthers) {
  Product product;
  begin(product);
  product.last_legs = kBrass;
  put(product.text());
  for (const char* old : {"oak-plain", "oak-dim", "steel-plain", "steel-dim"}) std::filesystem::remove(file(old));
  good({"--resume", "a", "--only-new"});
  EXPECT_FALSE(std::filesystem::exists(file("oak-plain")));
  EXPECT_EQ(iterations("brass-plain"), 3);
  EXPECT_EQ(iterations("brass-dim"), 3);
  EXPECT_EQ(dspm({"--resume", "a", "--only-new"}).err,
            "dspm: --only-new: the checkpoint holds all chosen frames already\n");
  good({"--resume", "a", "--iterations", "4"});
  expect_all(product.text(), 4, 6);
}

TEST_F(AddedFrames, MayHaveBeenLeftOutBefore) {
  const Product product;
  begin(product, {"--variation", "oak-*"});
  good({"--resume", "a", "--variation", "steel-dim"});
  EXPECT_FALSE(std::filesystem::exists(file("steel-plain")));
  good({"--resume", "a"});
  expect_all(product.text(), 3, 4);
}

TEST_F(AddedFrames, SomeOfTheFramesAloneAreRefused) {
  begin({});
  const std::string before = contents(directory / "a");
  const Outcome outcome = dspm({"--resume", "a", "--variation", "oak-*", "--iterations", "9"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--variation: the checkpoint's frames go on together"), std::string::npos) << outcome.err;
  const Outcome frames = dspm({"--resume", "a", "--frames", "1", "--variation", "oak-dim", "--iterations", "9"});
  EXPECT_NE(frames.err.find("--frames: the checkpoint's frames go on together"), std::string::npos) << frames.err;
  EXPECT_EQ(contents(directory / "a"), before);
  good({"--resume", "a", "--variation", "*", "--iterations", "4"});
}

TEST_F(AddedFrames, MakeAnimationsLonger) {
  Product product;
  product.frames = "Frames 2";
  product.more =
      R"(DynamicBegin "ball" Keyframe 1 Translate 0 0 -1 Keyframe 2 Translate 0 1 -1 Keyframe 3 Translate 0 .5 -1
KeyframeEnd Shape "sphere" "float radius" .2 DynamicEnd)";
  begin(product, {"--frames", "1"});
  product.frames = "Frames 3";
  put(product.text());
  good({"--resume", "a"});
  expect_all(product.text(), 3, 12);
}

TEST_F(AddedFrames, MayHaveNewShapes) {
  Product product;
  begin(product);
  product.more =
      R"(DynamicBegin "bell" Material "conductor" Translate 0 .9 0 Shape "sphere" "float radius" .2 DynamicEnd)";
  product.last_seat = variation("bell", R"(Show "bell" Hide "cushion")");
  put(product.text());
  good({"--resume", "a"});
  expect_all(product.text(), 3, 6);
}

struct Refused {
  Product product;
  std::string told;
};

TEST_F(AddedFrames, ThatWouldBeWrongAreRefusedByName) {
  begin({}, {"--iterations", "1"});
  const std::string before = contents(directory / "a");
  const auto with = [](auto&& change) {
    Product product;
    change(product);
    return product;
  };
  const std::string lamp =
      R"(AttributeBegin AreaLightSource "diffuse" DynamicBegin "lamp" Translate 0 1 0 Shape "sphere" "float radius" .1
DynamicEnd AttributeEnd)";
  const std::string far = R"(DynamicBegin "far" Translate 0 0 90 Shape "sphere" DynamicEnd)";
  const std::vector<Refused> all = {
      {with([&](Product& p) { p.more = lamp, p.last_seat = variation("lit", "Show \"lamp\""); }),
       "error: oak-lit, steel-lit: the light \"lamp\" shone in no frame that the checkpoint was begun with\n"},
      {with([&](Product& p) { p.more = far, p.last_seat = variation("wide", "Show \"far\""); }),
       "error: oak-wide, steel-wide: some of it lies outside of what the checkpoint was begun with\n"},
      {with([&](Product& p) { p.last_seat = variation("soft", "Show \"cushion\""); }),
       "which Dynamic blocks are there in \"oak-plain\" has changed since the checkpoint"},
      {with([&](Product& p) { p.more = "Shape \"sphere\""; }), "shape \"sphere\" is new since the checkpoint"},
  };
  for (const Refused& each : all) {
    put(each.product.text());
    const Outcome outcome = dspm({"--resume", "a"});
    EXPECT_EQ(outcome.code, 1) << each.told;
    EXPECT_NE(outcome.err.find(each.told), std::string::npos) << each.told << "\n" << outcome.err;
    EXPECT_EQ(contents(directory / "a"), before);
  }
}

// Whoever does not choose them can go on.
TEST_F(AddedFrames, ThatAreNotCoveredDisturbNoOthers) {
  Product product;
  begin(product, {"--iterations", "1"});
  product.more = R"(DynamicBegin "far" Translate 0 0 90 Shape "sphere" DynamicEnd)";
  product.last_seat = variation("wide", "Show \"far\"") + kDark;
  put(product.text());
  EXPECT_EQ(dspm({"--resume", "a", "--iterations", "2"}).code, 1);
  good({"--resume", "a", "--iterations", "2", "--variation", "*-dark"});
  EXPECT_EQ(iterations("oak-plain"), 2);
  EXPECT_EQ(iterations("oak-dark"), 2);
  EXPECT_FALSE(std::filesystem::exists(file("oak-wide")));
}

}  // namespace added_frames_test
}  // namespace dspm::test
