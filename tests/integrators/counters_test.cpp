#include "dspm/integrators/counters.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dspm/base/system/state_in_memory.h"
#include "dspm/integrators/statistics.h"

namespace dspm {
namespace counters_test {

using Listed = std::vector<std::pair<std::string, std::uint64_t>>;

Listed listed(const Counters& counters) {
  Listed list;
  for (const Counters::Entry& entry : counters) list.emplace_back(entry.name, entry.value);
  return list;
}

TEST(Counters, AddByName) {
  Counters counters, others;
  counters.add("splats", 2);
  counters.add("lost", 1);
  counters.add("splats", std::uint64_t{1} << 40);
  others.add("found", 5);
  others.add("lost", 3);
  counters += others;
  EXPECT_EQ(listed(counters), (Listed{{"splats", (std::uint64_t{1} << 40) + 2}, {"lost", 4}, {"found", 5}}));
}

TEST(Counters, AreBounded) {
  Counters counters;
  const std::string longest(Counters::kLongestName, 'x');
  counters.add(longest, 1);
  EXPECT_EQ(listed(counters), (Listed{{longest, 1}}));
  EXPECT_THROW(counters.add(longest + "x", 1), std::length_error);
  for (std::size_t i = 1; i < Counters::kMost; ++i) counters.add(std::to_string(i), i);
  EXPECT_THROW(counters.add("one more", 1), std::length_error);
  counters.add(longest, 1);
  EXPECT_EQ(listed(counters).front().second, 2u);
}

// As part of the statistics, into an integrator that has counted other things.
TEST(Counters, AreLoadedAsTheyWereSaved) {
  Statistics saved, loaded;
  saved.camera.paths = 9;
  saved.counters.add("splats", 3);
  saved.counters.add("lost", 0);
  loaded.counters.add("found", 7);
  const std::string bytes = state_of(saved);
  LoadedState state(bytes);
  loaded.persist(state);
  EXPECT_TRUE(state.all_read());
  EXPECT_EQ(loaded.camera.paths, 9u);
  EXPECT_EQ(listed(loaded.counters), (Listed{{"splats", 3}, {"lost", 0}}));
}

TEST(Counters, DoNotLoadWhatTheyCannotHold) {
  Counters counters;
  counters.add("splats", 3);
  std::string bytes = state_of(counters);
  const auto load = [&] {
    Counters loaded;
    LoadedState state(bytes);
    loaded.persist(state);
  };
  EXPECT_NO_THROW(load());
  for (std::size_t i = 0; i <= Counters::kLongestName; ++i) bytes[sizeof(std::uint64_t) + i] = 'x';
  EXPECT_THROW(load(), std::runtime_error);
  bytes[1] = 1;  // 257 of them
  EXPECT_THROW(load(), std::runtime_error);
}

}  // namespace counters_test
}  // namespace dspm
