#include "bench/measure/rounds.h"

#include <gtest/gtest.h>

namespace dspm {
namespace rounds_test {

/// Its iterations take `hit_points` and 2 s, the first one ten times as long.
class Scripted : public Integrator {
 public:
  explicit Scripted(double hit_points) {
    statistics_.steps = {{"hit points", 0}, {"photons", 0}}, seconds_ = hit_points;
  }
  int iterations() const override { return 0; }
  std::string settings() const override { return {}; }
  void iterate(const Iteration& iteration) override {
    const double slow = iteration.number == 0 ? 10 : 1;
    statistics_.steps[0].seconds += slow * seconds_, statistics_.steps[1].seconds += slow * 2;
  }
  Image estimate(Frame, const std::string&) const override { return {}; }
  Statistics statistics() const override { return statistics_; }

 private:
  Statistics statistics_;
  double seconds_;
};

Group group_of(std::initializer_list<double> seconds) {
  Group group;
  for (const double s : seconds) group.push_back({std::make_unique<Scene>(), std::make_unique<Scripted>(s)});
  return group;
}

std::vector<Group> two_groups() {
  std::vector<Group> groups;
  groups.push_back(group_of({6}));
  groups.push_back(group_of({1, 3}));
  return groups;
}

TEST(InTurns, TakesMeansOfGroupsWithoutTheFirstIteration) {
  const std::vector<Rounds> rounds = in_turns(two_groups(), 3);
  ASSERT_EQ(rounds.size(), 2u);
  ASSERT_EQ(rounds[0].size(), 2u);
  EXPECT_EQ(rounds[0][0], (StepSeconds{6, 2, 0, 0, 8}));
  EXPECT_EQ(rounds[1][1], (StepSeconds{2, 2, 0, 0, 4}));
}

TEST(InTurns, CountsTheFirstIterationWhereThereIsNoOther) {
  const std::vector<Rounds> rounds = in_turns(two_groups(), 1);
  ASSERT_EQ(rounds[1].size(), 1u);
  EXPECT_EQ(rounds[1][0], (StepSeconds{20, 20, 0, 0, 40}));
}

TEST(Ratios, AreMediansOfTheRoundsRatios) {
  const Rounds over = {{2, 1, 1, 1, 5}, {30, 1, 1, 1, 33}, {8, 1, 1, 1, 11}};
  const Rounds under = {{1, 1, 1, 1, 4}, {10, 1, 1, 1, 13}, {2, 1, 1, 1, 5}};
  EXPECT_EQ(ratios(over, under)[0], 3);
  EXPECT_EQ(medians(over)[0], 8);
}

}  // namespace rounds_test
}  // namespace dspm
