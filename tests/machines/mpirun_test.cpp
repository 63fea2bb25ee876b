// dspm under mpirun, where Open MPI was there when it was built.
#include <gtest/gtest.h>

#include "dspm/base/system/find_program.h"
#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace mpirun_test {

class Mpirun : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path module = std::filesystem::path(DSPM_BINARY).parent_path() / "libdspm_mpi.so";
    if (!std::filesystem::exists(module) || find_program("mpirun").empty())
      GTEST_SKIP() << "there is no Open MPI (libopenmpi-dev and openmpi-bin)";
  }

  /// The exit code; what was said is in out.txt and err.txt.
  int mpirun(int machines, const std::string& arguments) const {
    return shell(directory,
                 "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe --bind-to none -n " +
                     std::to_string(machines) + " " DSPM_BINARY " -t 1 " + arguments);
  }
  std::vector<float> image(const std::string& name) const {
    std::vector<float> all;
    for (const Rgb& c : read_image(directory / name).pixels) all.insert(all.end(), {c.r, c.g, c.b});
    return all;
  }
  int lines_with(const std::string& words) const {
    const std::string text = contents(directory / "err.txt");
    int count = 0;
    for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at + 1)) ++count;
    return count;
  }

  TinyDirectory directory;
};

TEST_F(Mpirun, MachinesGiveTheSameBits) {
  ASSERT_EQ(mpirun(1, "tiny.dsc --iterations 18 --float -o one.exr"), 0) << contents(directory / "err.txt");
  ASSERT_EQ(mpirun(3, "tiny.dsc --iterations 18 --float -o three.exr --png --stats"), 0);
  EXPECT_EQ(image("one.0002.exr"), image("three.0002.exr"));
  EXPECT_TRUE(directory.has("three.0003.png"));
  EXPECT_EQ(read_exr_header(directory / "three.0003.exr").integers.at("iterations"), 18);
  EXPECT_EQ(lines_with("3 machines"), 1);
  EXPECT_EQ(lines_with("bytes between them"), 1);
  EXPECT_EQ(lines_with("an iteration and frame"), 1);

  ASSERT_EQ(run(directory, {"tiny.dsc", "--iterations", "18", "--float", "-o", "alone.exr"}).code, 0);
  const std::vector<float> one = image("one.0002.exr"), alone = image("alone.0002.exr");
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], alone[i], 1e-6 + 1e-5 * alone[i]);
}

TEST_F(Mpirun, GoesOnWithAnotherNumberOfThem) {
  ASSERT_EQ(mpirun(2, "tiny.dsc --iterations 8 --float -o a.exr --checkpoint a.ck"), 0);
  ASSERT_EQ(mpirun(3, "tiny.dsc --iterations 20 --float -o a.exr --resume a.ck"), 0);
  ASSERT_EQ(mpirun(2, "tiny.dsc --iterations 20 --float -o b.exr"), 0);
  EXPECT_EQ(image("a.0003.exr"), image("b.0003.exr"));
}

TEST_F(Mpirun, EndsWhenTheErrorIsSmall) {
  ASSERT_EQ(mpirun(1, "tiny.dsc --until-error 20% --float -o one.exr"), 0) << contents(directory / "err.txt");
  ASSERT_EQ(mpirun(2, "tiny.dsc --until-error 20% --float -o two.exr"), 0);
  EXPECT_EQ(lines_with("the estimated error is"), 1);
  EXPECT_EQ(image("one.0002.exr"), image("two.0002.exr"));
}

TEST_F(Mpirun, IntervalsFollowOneAnother) {
  ASSERT_EQ(mpirun(2, "tiny.dsc --iterations 10 --integrator sppm --float -o a.exr"), 0)
      << contents(directory / "err.txt");
  ASSERT_EQ(mpirun(1, "tiny.dsc --iterations 10 --integrator sppm --float -o b.exr"), 0);
  EXPECT_EQ(image("a.0003.exr"), image("b.0003.exr"));
}

TEST_F(Mpirun, WhatIsWrongIsSaidOnce) {
  put_file(directory / "wrong.dsc", "WorldBegin\nShape \"spere\"\n");
  EXPECT_NE(mpirun(3, "wrong.dsc"), 0);
  EXPECT_EQ(lines_with("spere"), 2);  // the message, and the line that it shows
  EXPECT_NE(mpirun(2, "tiny.dsc --part 1/2 --checkpoint a.ck"), 0);
  EXPECT_EQ(lines_with("does not go together with mpirun"), 1) << contents(directory / "err.txt");
  EXPECT_EQ(mpirun(3, "--list-variations tiny.dsc"), 0);
}

TEST_F(Mpirun, ASchedulersSingleProcessIsNoneOfMany) {
  EXPECT_EQ(shell(directory, "PMIX_RANK=0 SLURM_STEP_NUM_TASKS=1 PMI_RANK=0 PMI_SIZE=1 " DSPM_BINARY
                             " tiny.dsc --part 1/2 --checkpoint part.ck"),
            0)
      << contents(directory / "err.txt");
}

TEST_F(Mpirun, ADeadHelperLeavesTheCheckpointWhole) {
  const std::string image = (directory / "a.exr").string();
  std::thread killer([&] {
    ASSERT_TRUE(appears(directory / "a.ck"));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    // The one that was started last; brackets keep the pattern from being found in this command.
    EXPECT_EQ(shell(TemporaryDirectory(), "pkill -KILL -n -f '[-]o " + image + "'"), 0);
  });
  EXPECT_NE(
      mpirun(2, "tiny.dsc --iterations 1000000 --time-limit 60s --checkpoint a.ck --checkpoint-every 4 -o " + image),
      0);
  killer.join();
  EXPECT_GE(lines_with("on node "), 1) << contents(directory / "err.txt");
  EXPECT_EQ(run(directory, {"tiny.dsc", "--resume", "a.ck", "--iterations", "1"}).code, 0);
}

}  // namespace mpirun_test
}  // namespace dspm::test
