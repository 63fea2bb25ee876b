#include "dspm/output/report/scaling_table.h"

#include <gtest/gtest.h>

#include "dspm/output/report/run_report.h"

namespace dspm {
namespace scaling_table_test {

StepTime step(const char* name, double all, double span) { return {name, all / 2, {all, span}}; }

TEST(ScalingTable, SaysWhatIsLeftOfIterationsAndWhatThreadsWouldDo) {
  const std::vector<StepTime> around = {step("reading the scene", 2, 2), step(kIterations, 100, 3)};
  const std::vector<StepTime> steps = {step("hit points", 60, 0.5), step("photons", 39, 0.5)};
  const std::vector<StepTime> all = worked_steps(around, steps);
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(all[3].name, "rest of iterations");
  EXPECT_DOUBLE_EQ(all[3].work.all, 1);
  EXPECT_DOUBLE_EQ(all[3].work.span, 2);

  // Amdahl: 1 / (s + (1 - s) / n) with s = 1 and s = 0.03.
  const std::string table = scaling_table(around, steps);
  EXPECT_NE(table.find("reading the scene                   2.00   100.00%     1.0     1.0     1.0\n"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("iterations                        100.00     3.00%    11.0    22.1    26.6\n"),
            std::string::npos)
      << table;
}

TEST(ScalingTable, IsEmptyIfNoWorkIsCounted) {
  EXPECT_EQ(scaling_table({{"reading the scene", 2}, {kIterations, 3}}, {{"hit points", 1}}), "");
}

}  // namespace scaling_table_test
}  // namespace dspm
