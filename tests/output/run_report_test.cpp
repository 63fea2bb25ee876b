#include "dspm/output/report/run_report.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "dspm/base/math/moments.h"
#include "tests/output/json_check.h"

namespace dspm {
namespace run_report_test {

Statistics interval(int iterations, double seconds) {
  Statistics s;
  s.iterations = iterations;
  s.steps = {{"hit points", seconds, {seconds, seconds / 8}}, {"photons", 2 * seconds, {2 * seconds, seconds / 4}}};
  s.camera.segments = {10, 40};
  s.camera.paths = 4;
  s.camera.dynamic_paths = 1;
  s.photons_stored = {1000, 3000};
  s.energy = {{.emitted = 3, .absorbed = 2, .escaped = 1, .terminated = 0}};
  s.bytes = 5;
  s.counters.add("joined paths", 1'500);
  return s;
}

TEST(RunReport, AddsIntervals) {
  RunReport report;
  report.add(interval(2, 1), {FileFrame(2)});
  Statistics second = interval(3, 10);
  second.counters.add("a count of its own", 7);
  report.add(second, {FileFrame(0)});
  const Statistics& s = report.statistics;
  EXPECT_EQ(report.iterations, (std::vector<int>{2, 3}));
  EXPECT_EQ(s.iterations, 5);
  ASSERT_EQ(s.steps.size(), 2u);
  EXPECT_EQ(s.steps[0].seconds, 11);
  EXPECT_EQ(s.steps[1].seconds, 22);
  EXPECT_EQ(s.steps[1].work.all, 22);
  EXPECT_EQ(s.steps[1].work.span, 2.75);
  EXPECT_EQ(s.camera.segments.separate, 80u);
  EXPECT_EQ(s.energy.size(), 2u);
  EXPECT_EQ(s.bytes, 5u);
  std::vector<std::pair<std::string, std::uint64_t>> counters;
  for (const Counters::Entry& counter : s.counters) counters.emplace_back(counter.name, counter.value);
  EXPECT_EQ(counters, (decltype(counters){{"joined paths", 3'000}, {"a count of its own", 7}}));
}

TEST(RunReport, TableAndJsonHoldTheSharingFactors) {
  RunReport report;
  report.add(interval(2, 1), {FileFrame(0)});
  report.seconds = 4;
  SceneDescription description;
  description.frames = FileFrames(3, {{}});
  Job job;
  job.description = &description;
  job.scene_file = "a \"quoted\" name.dsc";
  job.frames = {FileFrame(0), FileFrame(2)};
  const std::string table = table_of(job, report), json = json_of(job, report);
  EXPECT_NE(table.find("camera path segments                  10                40      4.00"), std::string::npos)
      << table;
  EXPECT_NE(table.find("3,000"), std::string::npos) << table;
  EXPECT_NE(table.find("joined paths                       1,500\n"), std::string::npos) << table;
  EXPECT_TRUE(test::JsonCheck::valid(json)) << json;
  EXPECT_NE(json.find("\"factor\": 3"), std::string::npos) << json;
  EXPECT_NE(json.find("\"joined_paths\": 1500"), std::string::npos) << json;
}

}  // namespace run_report_test
}  // namespace dspm
