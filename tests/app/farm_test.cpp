// --farm: jobs that farms run as they are. Slurm's by Slurm itself, where it is installed; and by a stand-in anywhere.
#include <gtest/gtest.h>

#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "dspm/session/checkpoint/checkpoint_file.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace {

/// Runs every task at once.
constexpr const char* kStandIn = R"(#!/bin/sh
echo "$@" >> ../calls
while [ $# -gt 0 ]; do case $1 in --array) tasks=$2;; esac; shift; done
cat > job
for task in $(seq $(echo ${tasks:-1-1} | tr - ' ')); do SLURM_ARRAY_TASK_ID=$task sh job >> ../jobs 2>&1; done
echo "7;cluster"
)";

/// A cluster of this machine alone: its daemons end with it.
class Slurm {
 public:
  Slurm() {
    put_file(directory_ / "start", R"(
for program in munged slurmctld slurmd sbatch scontrol; do command -v $program || exit 77; done
mkdir state spool
head -c 1024 /dev/urandom > key; chmod 600 key; chmod 755 .
munged --force --socket=$PWD/socket --key-file=$PWD/key --pid-file=$PWD/munged.pid --log-file=$PWD/munged.log --seed-file=$PWD/seed
cat > slurm.conf <<END
ClusterName=dspm
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$PWD/socket,cred_expire=5
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
SlurmctldPort=26817
SlurmdPort=26818
SlurmctldLogFile=$PWD/slurmctld.log
SlurmdLogFile=$PWD/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=1
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
MailProg=/bin/true
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=ALL Default=YES State=UP
END
export SLURM_CONF=$PWD/slurm.conf
slurmctld -f slurm.conf && slurmd -f slurm.conf || exit 77
for i in $(seq 100); do sinfo -h -o %t | grep -q idle && exit 0; sleep .1; done
exit 77
)");
    started_ = shell(directory_, "sh start > start.log 2>&1") == 0;
  }
  ~Slurm() {
    shell(directory_, "for daemon in slurmd slurmctld munged; do kill $(cat $daemon.pid); done 2> /dev/null");
  }
  Slurm(const Slurm&) = delete;
  Slurm& operator=(const Slurm&) = delete;

  bool started() const { return started_; }
  std::string conf() const { return (directory_ / "slurm.conf").string(); }

 private:
  TemporaryDirectory directory_;
  bool started_ = false;
};

class Farm : public testing::Test {
 protected:
  void write_job(const Arguments& arguments) {
    const Outcome outcome = run(directory, Arguments{"tiny.dsc", "--farm", "slurm"} + arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    put_file(directory / "farm.sh", outcome.out);
  }
  /// Of one machine that did all.
  void expect_images(const Arguments& arguments, int iterations) {
    ASSERT_EQ(run(directory, Arguments{"tiny.dsc", "--float", "-o", "whole.exr"} + arguments).code, 0);
    for (const char* number : {".0001", ".0002", ".0003"}) {
      const std::string image = number + std::string(".exr");
      ASSERT_TRUE(directory.has("it's" + image));
      const Image merged = read_image(directory / ("it's" + image)), whole = read_image(directory / ("whole" + image));
      for (std::size_t i = 0; i < whole.pixels.size(); ++i)
        ASSERT_NEAR(merged.pixels[i].g, whole.pixels[i].g, 1e-6 + 1e-5 * std::abs(whole.pixels[i].g));
      EXPECT_EQ(read_exr_header(directory / ("it's" + image)).integers.at("iterations"), iterations);
    }
  }

  TinyDirectory directory;
};

TEST_F(Farm, JobsArePartsAndTheirMerge) {
  std::filesystem::create_directory(directory / "bin");
  put_file(directory / "bin/sbatch", kStandIn);
  std::filesystem::permissions(directory / "bin/sbatch", std::filesystem::perms::owner_all);
  const std::string call = "mkdir -p run && cp tiny.dsc run && cd run && PATH=../bin:$PATH sh ../farm.sh --time 5";
  write_job({"--parts", "3", "--iterations", "6", "--seed=9", "--float", "-o", "../it's.exr", "--png"});
  ASSERT_EQ(shell(directory, call), 0);
  EXPECT_EQ(contents(directory / "calls"),
            "--parsable --job-name dspm-part --array 1-3 --requeue --time 5\n"
            "--parsable --job-name dspm-merge --dependency afterany:7\n");
  expect_images({"--iterations", "6", "--seed", "9"}, 6);
  EXPECT_TRUE(directory.has("it's.0002.png"));

  write_job({"--parts", "3", "--iterations", "12", "--seed=9", "--float", "-o", "../it's.exr"});
  ASSERT_EQ(shell(directory, call), 0) << "parts go on";
  expect_images({"--iterations", "12", "--seed", "9"}, 12);
}

TEST_F(Farm, SlurmRunsThemAndPartsGoOnThatWereKilled) {
  const Slurm slurm;
  if (!slurm.started())
    GTEST_SKIP() << "SKIPPED: no Slurm can be started here (slurmctld, slurmd, slurm-client, munge)";
  const std::string conf = "SLURM_CONF=" + slurm.conf() + " ";
  write_job({"--parts", "2", "--iterations", "600", "--float", "-o", "it's.exr", "--checkpoint-every", "1"});
  ASSERT_EQ(shell(directory, conf + "sh farm.sh > submitted"), 0);
  const std::filesystem::path part = directory / "tiny.parts/1-of-2.ck";
  ASSERT_TRUE(comes_true(
      [&] { return std::filesystem::exists(part) && CheckpointFile(part).intervals().front().iterations > 2; }));
  ASSERT_EQ(shell(directory, conf + "scontrol requeue $(sed 's/parts: \\([0-9]*\\).*/\\1/' submitted)_1 2> requeued"),
            0)
      << contents(directory / "requeued");
  ASSERT_TRUE(appears(directory / "it's.0003.exr"));
  ASSERT_TRUE(comes_true([&] { return shell(directory, conf + "test -z \"$(squeue -h)\"") == 0; }));
  expect_images({"--iterations", "600"}, 600);
}

/// Of the other kinds, by stand-ins for their schedulers, which hold the job to what is published of them.
TEST_F(Farm, OtherKindsAreWhatTheirSchedulersTake) {
  const std::string here = std::filesystem::path(__FILE__).parent_path().string();
  const std::pair<const char*, std::string> kinds[] = {{"flamenco", "node " + here + "/flamenco.js"},
                                                       {"openjd", "python3 " + here + "/openjd.py"}};
  std::filesystem::rename(directory / "tiny.dsc", directory / "a \"tiny\" $one.dsc");
  for (const auto& [kind, scheduler] : kinds) {
    const Outcome job = run(directory, {"a \"tiny\" $one.dsc", "--parts", "3", "--iterations", "6", "--seed=9",
                                        "--float", "-o", "it's.exr", "--farm", kind});
    ASSERT_EQ(job.code, 0) << job.err;
    put_file(directory / "job", job.out);
    const int code = shell(directory, scheduler + " job > tasks");
    if (code == 77 || code == 127) GTEST_SKIP() << "SKIPPED: it takes node, and python3 with yaml";
    ASSERT_EQ(code, 0) << kind << "\n" << job.out;
    ASSERT_EQ(shell(directory, "sh tasks > said 2>&1"), 0) << contents(directory / "said");
    std::filesystem::copy(directory / "a \"tiny\" $one.dsc", directory / "tiny.dsc",
                          std::filesystem::copy_options::overwrite_existing);
    expect_images({"--iterations", "6", "--seed", "9"}, 6);
    for (const char* frame : {"1", "2", "3"})
      std::filesystem::remove(directory / (std::string("it's.000") + frame + ".exr"));
    EXPECT_TRUE(directory.has("a \"tiny\" $one.parts/3-of-3.ck"));
    std::filesystem::remove_all(directory / "a \"tiny\" $one.parts");
  }
}

TEST_F(Farm, AnotherNumberOfPartsBeginsAnew) {
  std::filesystem::create_directory(directory / "bin");
  put_file(directory / "bin/sbatch", kStandIn);
  std::filesystem::permissions(directory / "bin/sbatch", std::filesystem::perms::owner_all);
  const std::string call = "mkdir -p run && cp tiny.dsc run && cd run && PATH=../bin:$PATH sh ../farm.sh > said";
  for (const char* parts : {"2", "3"}) {
    write_job({"--parts", parts, "--iterations", "6", "--float", "-o", "../it's.exr"});
    ASSERT_EQ(shell(directory, call), 0);
    expect_images({"--iterations", "6"}, 6);
  }
}

TEST_F(Farm, JobsWhosePartsWouldFailAreRefused) {
  const auto refused = [&](const Arguments& arguments, int code, const std::string& message) {
    const Outcome outcome = run(directory, arguments + Arguments{"--farm", "slurm"});
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  refused({"tiny.dsc", "--parts", "9", "--iterations", "8"}, 2,
          "--parts 9: 8 iterations cannot make so many parts; ask for fewer, or for more --iterations");
  refused({"tiny.dsc", "--iterations", "0"}, 2, "of how many iterations? Give --iterations or --time-limit");
  refused({"missing.dsc"}, 1, "missing.dsc");
  put_file(directory / "wrong.dsc", "Shape \"spere\"\n");
  refused({"wrong.dsc"}, 1, "wrong.dsc:1");
  put_file(directory / "tiny.dsc", tiny_scene("\"dsppm\"", "\"dsppm\" \"string estimator\" \"hj09\""));
  refused({"tiny.dsc"}, 2, "cannot be rendered in parts: the radii of hj09 depend on the photons");
}

}  // namespace
}  // namespace dspm::test
