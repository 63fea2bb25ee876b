// The leader's book, without machines.
#include "dspm/machines/desk.h"

#include <gtest/gtest.h>

namespace dspm::test {
namespace {

using Fetches = std::vector<std::pair<int, int>>;

Fetches to_fetch(Desk& desk) {
  Fetches all;
  for (const auto& [machine, begin] : desk.to_fetch()) all.emplace_back(machine, begin);
  return all;
}

int begin_of(const std::optional<Block>& block) { return block ? block->begin : -1; }

TEST(Desk, HandsOutAllIterationsOnce) {
  Desk desk;
  EXPECT_FALSE(desk.hand_out(1));  // not open yet
  desk.open(6, 14, 4);
  std::vector<int> edges;
  for (int machine = 1; const auto block = desk.hand_out(machine); ++machine)
    edges.insert(edges.end(), {block->begin, block->end});
  EXPECT_EQ(edges, (std::vector<int>{6, 8, 8, 12, 12, 14}));  // blocks begin at multiples of four, wherever a run does
}

TEST(Desk, FetchesInOrderAndFewAtATime) {
  Desk desk;
  desk.open(0, 0, 4);
  for (const int machine : {1, 2, 3, 4}) desk.hand_out(machine);
  for (const int machine : {2, 3, 4}) desk.rendered(machine, 4 * (machine - 1));
  EXPECT_EQ(to_fetch(desk), Fetches{});  // the first one is missing
  desk.rendered(1, 0);
  EXPECT_EQ(to_fetch(desk), (Fetches{{1, 0}, {2, 4}}));
  EXPECT_EQ(to_fetch(desk), Fetches{});  // they are on their way
  desk.arrived(4, "b");
  EXPECT_FALSE(desk.take(0));
  desk.arrived(0, "a");
  EXPECT_EQ(desk.take(0), "a");
  EXPECT_EQ(to_fetch(desk), (Fetches{{3, 8}}));
  EXPECT_EQ(desk.take(4), "b");
  EXPECT_EQ(to_fetch(desk), (Fetches{{4, 12}}));
}

TEST(Desk, MachinesWaitWithTwoBlocksInHand) {
  Desk desk;
  desk.open(0, 0, 4);
  EXPECT_EQ(begin_of(desk.hand_out(1)), 0);  // a slow machine
  for (const int begin : {4, 8}) {
    EXPECT_EQ(begin_of(desk.hand_out(2)), begin);
    desk.rendered(2, begin);
  }
  EXPECT_FALSE(desk.hand_out(2));
  EXPECT_EQ(begin_of(desk.hand_out(3)), 12);
  desk.rendered(1, 0), desk.arrived(0, ""), desk.take(0), desk.arrived(4, ""), desk.take(4);
  EXPECT_EQ(begin_of(desk.hand_out(2)), 16);
}

TEST(Desk, ForgetsWhatWasBefore) {
  Desk desk;
  desk.open(0, 8, 4);
  desk.hand_out(1);
  desk.close();
  EXPECT_FALSE(desk.hand_out(1));
  desk.open(8, 16, 4);
  desk.rendered(1, 0), desk.arrived(0, "late");
  EXPECT_EQ(to_fetch(desk), Fetches{});
  EXPECT_FALSE(desk.take(0));
  EXPECT_EQ(begin_of(desk.hand_out(1)), 8);
}

}  // namespace
}  // namespace dspm::test
