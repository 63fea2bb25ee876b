// The leader's book, without machines.
#include "dspm/session/machines/desk.h"

#include <gtest/gtest.h>

namespace dspm::test {
namespace desk_test {

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

TEST(Desk, FetchesTheNextBlockAndFewBeforeTheirTurn) {
  Desk desk;
  desk.open(0, 0, 4);
  for (const int machine : {1, 2, 3, 4}) desk.hand_out(machine);
  for (const int machine : {2, 3, 4}) desk.rendered(machine, 4 * (machine - 1));
  EXPECT_EQ(to_fetch(desk), (Fetches{{2, 4}, {3, 8}}));  // so that they are there when the first one comes
  EXPECT_EQ(to_fetch(desk), Fetches{});                  // they are on their way
  desk.rendered(1, 0);
  EXPECT_EQ(to_fetch(desk), (Fetches{{1, 0}}));  // it always has room
  desk.arrived(4, "b");
  EXPECT_FALSE(desk.is_here(0));
  EXPECT_FALSE(desk.take(0));
  desk.arrived(0, "a");
  EXPECT_TRUE(desk.is_here(0));
  EXPECT_EQ(desk.take(0), "a");
  EXPECT_EQ(to_fetch(desk), Fetches{});
  EXPECT_EQ(desk.take(4), "b");
  EXPECT_EQ(to_fetch(desk), (Fetches{{4, 12}}));
}

TEST(Desk, MachinesHoldTwoBlocks) {
  Desk desk;
  desk.open(0, 0, 4);
  EXPECT_EQ(begin_of(desk.hand_out(1)), 0);
  EXPECT_EQ(begin_of(desk.hand_out(2)), 4);
  desk.rendered(1, 0);
  EXPECT_EQ(begin_of(desk.hand_out(1)), 8);
  desk.rendered(1, 8);
  EXPECT_FALSE(desk.hand_out(1));  // the first one is rendered, and on its way
  EXPECT_EQ(begin_of(desk.hand_out(3)), 12);
  desk.arrived(0, ""), desk.take(0);
  EXPECT_EQ(begin_of(desk.hand_out(1)), 16);
}

TEST(Desk, ASlowMachinesBlockIsRenderedByAFasterOneToo) {
  Desk desk;
  desk.open(0, 0, 4);
  EXPECT_EQ(begin_of(desk.hand_out(1)), 0);  // the slow one
  const auto render_two = [&](int machine, int first) {
    for (const int begin : {first, first + 4}) {
      EXPECT_EQ(begin_of(desk.hand_out(machine)), begin);
      desk.rendered(machine, begin);
    }
  };
  render_two(2, 4), render_two(3, 12);
  EXPECT_EQ(begin_of(desk.hand_out(2)), 0);
  EXPECT_FALSE(desk.hand_out(2));
  EXPECT_FALSE(desk.hand_out(3));  // one more is enough
  EXPECT_EQ(to_fetch(desk), (Fetches{{2, 4}, {2, 8}}));
  desk.rendered(2, 0), desk.rendered(1, 0);
  EXPECT_EQ(to_fetch(desk), (Fetches{{2, 0}}));  // of the first one that has it
  desk.arrived(0, "");
  EXPECT_EQ(desk.wanted_from(), 0);
  desk.take(0);
  EXPECT_EQ(desk.wanted_from(), 4);
  desk.rendered(1, 0), desk.arrived(0, "late");
  EXPECT_FALSE(desk.is_here(0));
  EXPECT_EQ(begin_of(desk.hand_out(1)), 20);
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

}  // namespace desk_test
}  // namespace dspm::test
