// Pictures between threads.
#include "dspm/looking/serve/gallery.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>

namespace dspm {
namespace gallery_test {

using std::chrono::milliseconds;

Picture picture_of(const Wish& wish, int iterations = 1) {
  Picture picture;
  picture.wish = wish, picture.iterations = iterations, picture.pixels = "pixels";
  return picture;
}

const Wish kWish{2, kRadiance, 1};

auto request(Gallery& gallery, std::uint64_t viewer, std::vector<Gallery::Seen> seen, int patience = 10'000) {
  return std::async(std::launch::async, [&gallery, viewer, seen = std::move(seen), patience] {
    return gallery.newer({viewer, seen}, milliseconds(patience));
  });
}
void wait_for_wishes(const Gallery& gallery, std::size_t count) {
  while (gallery.wanted().size() != count) std::this_thread::sleep_for(milliseconds(1));
}

TEST(Gallery, APictureIsWantedWhileSomeoneWaitsAndAMomentLonger) {
  Gallery gallery;
  gallery.begin_run(8);
  EXPECT_TRUE(gallery.wanted().empty());
  auto viewer = request(gallery, 1, {{kWish}});
  wait_for_wishes(gallery, 1);
  EXPECT_EQ(gallery.wanted(), std::vector{kWish});
  gallery.put({picture_of(kWish)});
  const Gallery::Pictures pictures = viewer.get();
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_GT(pictures[0]->version, 0u);
  const auto now = Gallery::Clock::now();
  EXPECT_EQ(gallery.wanted(Gallery::kNewer, now), std::vector{kWish}) << "the viewer has yet to see what it was given";
  EXPECT_TRUE(gallery.wanted(1, now).empty());
  gallery.begin_run(8);
  EXPECT_EQ(gallery.wanted(1, now), std::vector{kWish}) << "the first picture of the next run is made all the same";
  EXPECT_TRUE(gallery.wanted(Gallery::kNewer, now + Gallery::kMoment).empty());
}

// During the run it serves; at its end someone may see all of it.
TEST(Gallery, AShrunkPictureIsNoLastOne) {
  Gallery gallery;
  gallery.begin_run(8);
  auto viewer = request(gallery, 1, {{kWish}});
  wait_for_wishes(gallery, 1);
  Picture shrunk = picture_of(kWish, 5);
  shrunk.shrunk = true;
  gallery.put({shrunk});
  viewer.get();
  EXPECT_TRUE(gallery.wanted(0).empty());
  EXPECT_EQ(gallery.wanted(5), std::vector{kWish});
  gallery.put({picture_of(kWish, 5)});
  EXPECT_TRUE(gallery.wanted(5).empty());
}

TEST(Gallery, WhatAViewerHasIsNotSentAgain) {
  Gallery gallery;
  gallery.begin_run(8);
  gallery.put({picture_of(kWish)});
  const auto version = request(gallery, 1, {{kWish}}).get().at(0)->version;
  EXPECT_TRUE(request(gallery, 1, {{kWish, version, version}}, 20).get().empty());
  gallery.put({picture_of(kWish, 2)});
  EXPECT_EQ(request(gallery, 1, {{kWish, version, version}}).get().at(0)->iterations, 2);
}

TEST(Gallery, AnotherSizeStandsInOnce) {
  Gallery gallery;
  gallery.begin_run(8);
  gallery.put({picture_of({2, kRadiance, 3})});
  const auto stand_in = request(gallery, 1, {{kWish}}).get();
  ASSERT_EQ(stand_in.size(), 1u);
  EXPECT_EQ(stand_in[0]->wish.halvings, 3);
  auto viewer = request(gallery, 1, {{kWish, 0, stand_in[0]->version}});
  wait_for_wishes(gallery, 1);
  gallery.put({picture_of(kWish)});
  EXPECT_EQ(viewer.get().at(0)->wish, kWish);
}

TEST(Gallery, KnowsWhatIsOutdated) {
  Gallery gallery;
  gallery.begin_run(8);
  gallery.put({picture_of(kWish, 3)});
  const auto version = request(gallery, 1, {{kWish}}).get().at(0)->version;
  auto viewer = request(gallery, 1, {{kWish, version, version}});
  wait_for_wishes(gallery, 1);
  EXPECT_TRUE(gallery.wanted(0).empty());
  EXPECT_TRUE(gallery.wanted(3).empty());
  EXPECT_EQ(gallery.wanted(4).size(), 1u);
  gallery.close();
  viewer.get();
}

TEST(Gallery, ANewRequestEndsTheViewersEarlierOne) {
  Gallery gallery;
  gallery.begin_run(8);
  auto first = request(gallery, 1, {{kWish}});
  wait_for_wishes(gallery, 1);
  auto other_viewer = request(gallery, 2, {{kWish}});
  auto second = request(gallery, 1, {{{3, kRadiance, 0}}});
  EXPECT_TRUE(first.get().empty());
  wait_for_wishes(gallery, 2);
  gallery.put({picture_of(kWish), picture_of({3, kRadiance, 0})});
  EXPECT_EQ(second.get().at(0)->wish.frame, 3);
  EXPECT_EQ(other_viewer.get().at(0)->wish.frame, 2);
}

TEST(Gallery, OldPicturesStayUntilThereAreNewOnes) {
  Gallery gallery;
  gallery.begin_run(8);
  gallery.put({picture_of(kWish), picture_of({7, kRadiance, 1})});
  gallery.begin_run(4);
  auto viewer = request(gallery, 1, {{kWish}, {{7, kRadiance, 1}}});
  const auto pictures = viewer.get();
  ASSERT_EQ(pictures.size(), 1u) << "frame 7 is none of the new run's";
  auto next = request(gallery, 1, {{kWish, pictures[0]->version, pictures[0]->version}});
  wait_for_wishes(gallery, 1);
  EXPECT_EQ(gallery.wanted(1), std::vector{kWish}) << "the new run has no picture yet";
  gallery.close();
  EXPECT_TRUE(next.get().empty());
}

TEST(Gallery, WhatNobodyLooksAtIsDroppedWhenItIsTooMuch) {
  Gallery gallery;
  gallery.begin_run(100);
  for (int frame = 0; frame < 12; ++frame) {
    Picture picture = picture_of({frame, kRadiance, 0});
    picture.pixels.resize(std::size_t{32} << 20);
    std::vector<Picture> pictures;
    pictures.push_back(std::move(picture));
    gallery.put(std::move(pictures));
  }
  EXPECT_TRUE(request(gallery, 1, {{{0, kRadiance, 0}}}, 20).get().empty());
  EXPECT_EQ(request(gallery, 1, {{{11, kRadiance, 0}}}, 20).get().size(), 1u);
}

}  // namespace gallery_test
}  // namespace dspm
