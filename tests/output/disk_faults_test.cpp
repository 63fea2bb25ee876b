// Files that cannot be written, by real faults of the system: found before the first iteration, or else they cost what
// is written meanwhile and nothing more.
#include <gtest/gtest.h>

#include "dspm/image/exr.h"
#include "dspm/image/image.h"
#include "tests/support/fake_ffmpeg.h"
#include "tests/support/mounted_disk.h"
#include "tests/support/process.h"

namespace dspm::test {
namespace disk_faults_test {

namespace fs = std::filesystem;

/// The tiny scene, whose images go to the folder "out".
class Directory : public TinyDirectory {
 public:
  Directory() { fs::create_directory(*this / "out"); }
  fs::path image(int frame) const { return *this / ("out/tiny.000" + std::to_string(frame) + ".exr"); }
  std::string said() const { return contents(*this / "err.txt"); }
  /// No image, and no part of one.
  bool has_no_output() const { return !fs::exists(*this / "out") || fs::is_empty(*this / "out"); }
};

std::vector<std::string> words(std::vector<std::string> more) {
  more.insert(more.begin(), {"tiny.dsc", "--outfile", "out/tiny.exr"});
  return more;
}

int count(const std::string& text, const std::string& words) {
  int found = 0;
  for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at + 1)) ++found;
  return found;
}

// Each of these would render without an end if the fault were not found first.

void expect_refused(const Directory& directory, const std::string& message, const std::vector<std::string>& more = {},
                    const std::function<void()>& prepare = {}) {
  std::vector<std::string> all = words({"--iterations", "0"});
  all.insert(all.end(), more.begin(), more.end());
  const Outcome outcome = Process(directory, all, "out.txt", "err.txt", prepare).wait();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("dspm: cannot write "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
}

TEST(BeforeTheRender, ADirectoryIsMissing) {
  const Directory directory;
  expect_refused(directory, "x/s.json: there is no directory x", {"--stats=x/s.json"});
  fs::remove(directory / "out");
  expect_refused(directory, "out/tiny.0001.exr: there is no directory out");
}

TEST(BeforeTheRender, ATargetIsADirectory) {
  for (const char* name : {"tiny.0002.exr", "tiny.0003.png", "s.json", "sheet.png"}) {
    const Directory directory;
    fs::create_directory(directory / "out" / name);
    expect_refused(directory, std::string(name) + ": it is not a regular file",
                   {"--png", "--stats=out/s.json", "--contact-sheet", "out/sheet.png"});
  }
}

TEST(BeforeTheRender, ADiskIsFull) {
  if (!MountedDisk::obstacle().empty()) GTEST_SKIP() << MountedDisk::obstacle();
  const Directory directory;
  const MountedDisk disk(directory / "disk");
  disk.fill();
  expect_refused(directory, "s.json: No space left on device", {"--stats=disk/s.json"});
  fs::remove(directory / "out");
  fs::create_directory_symlink("disk", directory / "out");
  expect_refused(directory, "tiny.0001.exr: No space left on device");
}

TEST(BeforeTheRender, ADiskIsReadOnly) {
  if (!MountedDisk::obstacle().empty()) GTEST_SKIP() << MountedDisk::obstacle();
  const Directory directory;
  const MountedDisk disk(directory / "out");
  disk.make_read_only(true);
  expect_refused(directory, "tiny.0001.exr: Read-only file system");
}

TEST(BeforeTheRender, FilesMayNotBeLarge) {
  const Directory directory;
  expect_refused(directory, "tiny.0001.exr: File too large", {}, [] {
    const rlimit small{1000, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &small);
  });
  EXPECT_TRUE(directory.has_no_output());
}

/// Permissions do not concern root, who becomes nobody for this.
void become_nobody() {
  if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(124);
}

TEST(BeforeTheRender, NothingMayBeWritten) {
  const Directory directory;
  fs::permissions(directory / "", fs::perms::all);
  fs::permissions(directory / "out", fs::perms(0555));
  const Outcome trial = Process(directory, {"--version"}, "out.txt", "err.txt", become_nobody).wait();
  if (trial.code != 0) GTEST_SKIP() << "nobody may not run the program (" << trial.code << ")";
  expect_refused(directory, "tiny.0001.exr: Permission denied", {}, become_nobody);
  EXPECT_TRUE(directory.has_no_output());
}

TEST(BeforeTheRender, AFileIsWriteProtected) {
  const Directory directory;
  fs::permissions(directory / "", fs::perms::all);
  fs::permissions(directory / "out", fs::perms::all);
  put_file(directory.image(2), "dear to me");
  fs::permissions(directory.image(2), fs::perms(0444));
  const Outcome trial = Process(directory, {"--version"}, "out.txt", "err.txt", become_nobody).wait();
  if (trial.code != 0) GTEST_SKIP() << "nobody may not run the program (" << trial.code << ")";
  expect_refused(directory, "tiny.0002.exr: Permission denied", {}, become_nobody);
  EXPECT_EQ(contents(directory.image(2)), "dear to me");
}

TEST(BeforeTheRender, TooLittleRoomForAllIsAWarning) {
  if (!MountedDisk::obstacle().empty()) GTEST_SKIP() << MountedDisk::obstacle();
  const Directory directory;
  const MountedDisk disk(directory / "out");
  const std::string warning = "warning: the images may take ";
  // 3 frames of 100 x 80 pixels at 6 bytes are 144,000 bytes, more than the disk's 131,072.
  put_file(directory / "tiny.dsc", tiny_scene("12 \"integer yresolution\" 8", "100 \"integer yresolution\" 80"));
  const Outcome large = run(directory, words({"--check"}));
  EXPECT_EQ(large.code, 0) << large.err;
  EXPECT_NE(large.err.find(warning + "144.0 KB, but only 131.1 KB are left"), std::string::npos) << large.err;
  EXPECT_EQ(run(directory, words({"--check", "--frames", "1"})).err.find(warning), std::string::npos);
}

// A fault that comes while images are written after every iteration, and goes.

struct Fault {
  std::string name, cause;
  bool takes_mount;
  std::function<void(const Directory&, const Process&, const MountedDisk*)> begin, end;
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

constexpr rlim_t kMessages = 900;  // bytes: enough for what is said, not for an image

const Fault kFaults[] = {
    {"AFullDisk", "No space left on device", true,
     [](const Directory&, const Process&, const MountedDisk* disk) {
       // More than once: an image that was being written leaves the room of the one that it replaces.
       for (int i = 0; i < 5; ++i) {
         disk->fill();
         std::this_thread::sleep_for(std::chrono::milliseconds(20));
       }
     },
     [](const Directory&, const Process&, const MountedDisk* disk) { disk->make_room(); }},
    {"AReadOnlyDisk", "Read-only file system", true,
     [](const Directory&, const Process&, const MountedDisk* disk) { disk->make_read_only(true); },
     [](const Directory&, const Process&, const MountedDisk* disk) { disk->make_read_only(false); }},
    {"ALimitOnTheSizeOfFiles", "File too large", false,
     [](const Directory&, const Process& process, const MountedDisk*) { process.limit(RLIMIT_FSIZE, kMessages); },
     [](const Directory&, const Process& process, const MountedDisk*) { process.limit(RLIMIT_FSIZE, 1'000'000); }},
    {"AVanishedDirectory", "there is no directory out", false,
     [](const Directory& directory, const Process&, const MountedDisk*) {
       fs::rename(directory / "out", directory / "gone");
     },
     [](const Directory& directory, const Process&, const MountedDisk*) { fs::create_directory(directory / "out"); }},
    {"ADirectoryInPlaceOfAFile", "it is not a regular file", false,
     [](const Directory& directory, const Process&, const MountedDisk*) {
       std::error_code exists;
       do fs::remove(directory.image(2));
       while (!fs::create_directory(directory.image(2), exists));
     },
     [](const Directory& directory, const Process&, const MountedDisk*) { fs::remove(directory.image(2)); }}};

class DuringTheRender : public ::testing::TestWithParam<Fault> {
 protected:
  void SetUp() override {
    if (!GetParam().takes_mount) return;
    if (!MountedDisk::obstacle().empty()) GTEST_SKIP() << MountedDisk::obstacle();
    disk_.emplace(directory_ / "out");
  }
  void begin(const Process& process) { GetParam().begin(directory_, process, disk_ ? &*disk_ : nullptr); }
  void end(const Process& process) { GetParam().end(directory_, process, disk_ ? &*disk_ : nullptr); }

  Directory directory_;
  std::optional<MountedDisk> disk_;
};

/// Images of as many iterations, by a run that nothing disturbs.
void expect_equal_to_undisturbed(const Directory& directory, int iterations) {
  const Directory other;
  ASSERT_EQ(run(other, words({"--iterations", std::to_string(iterations)})).code, 0);
  for (int frame = 1; frame <= 3; ++frame) {
    EXPECT_EQ(read_exr_header(directory.image(frame)).integers.at("iterations"), iterations);
    EXPECT_TRUE(read_image(directory.image(frame)) == read_image(other.image(frame))) << "frame " << frame;
  }
}

TEST_P(DuringTheRender, AFaultIsToldOnceAndLaterImagesAreWhole) {
  const Process process(directory_, words({"--iterations", "0", "--write-every", "1"}));
  ASSERT_TRUE(appears(directory_.image(3)));
  begin(process);
  EXPECT_TRUE(says(directory_, GetParam().cause)) << directory_.said();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  for (int frame = 1; frame <= 3; ++frame) {
    if (!fs::is_regular_file(directory_.image(frame))) continue;
    EXPECT_EQ(read_image(directory_.image(frame)).width, 12);
  }
  end(process);
  EXPECT_TRUE(says(directory_, "the files that could not be written are written now")) << directory_.said();
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(count(outcome.err, GetParam().cause), 1) << outcome.err;
  expect_equal_to_undisturbed(directory_, read_exr_header(directory_.image(1)).integers.at("iterations"));
  for (const auto& entry : fs::directory_iterator(directory_ / "out"))
    EXPECT_EQ(entry.path().extension(), ".exr") << entry.path();
}

TEST_P(DuringTheRender, AFaultThatStaysIsExitCode1) {
  const Process process(directory_, words({"--iterations", "0", "--write-every", "1", "--time-limit", "4s"}));
  ASSERT_TRUE(appears(directory_.image(3)));
  begin(process);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const std::size_t end = outcome.err.rfind("dspm: cannot write out/tiny.000");
  ASSERT_NE(end, std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().cause, end), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Faults, DuringTheRender, ::testing::ValuesIn(kFaults),
                         [](const auto& fault) { return fault.param.name; });

/// sppm renders one frame after the other: who made the first image is gone when the fault ends.
TEST(AfterTheRender, TheImagesOfAnIntervalThatHasEndedAreWrittenLater) {
  const Directory directory;
  const std::vector<std::string> sppm = words({"--integrator", "sppm", "--iterations", "0", "--time-limit", "3s"});
  const Process process(directory, sppm);
  ASSERT_TRUE(says(directory, "memory before the first iteration"));
  fs::create_directory(directory.image(1));
  ASSERT_TRUE(says(directory, "not a regular file"));
  fs::remove(directory.image(1));
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const int iterations = read_exr_header(directory.image(1)).integers.at("iterations");
  const Image late = read_image(directory.image(1));
  ASSERT_EQ(
      run(directory, words({"--integrator", "sppm", "--frames", "1", "--iterations", std::to_string(iterations)})).code,
      0);
  EXPECT_TRUE(late == read_image(directory.image(1)));
}

TEST(AfterTheRender, TheStatisticsKnowTheExitCode) {
  const Directory directory;
  const Process process(directory, words({"--iterations", "0", "--time-limit", "0.5s", "--stats=s.json"}));
  ASSERT_TRUE(says(directory, "memory before the first iteration"));
  fs::create_directory(directory.image(1));
  EXPECT_EQ(process.wait().code, 1);
  EXPECT_NE(contents(directory / "s.json").find("\"exit_code\": 1"), std::string::npos);
}

TEST(AfterTheRender, StatisticsAndVideoCostNothingElse) {
  const Directory directory;
  const FakeFfmpeg ffmpeg(kKeepAll);
  const Process process(directory, words({"--iterations", "0", "--time-limit", "1s", "--write-every", "1",
                                          "--stats=s.json", "--video", "a.mp4", "--contact-sheet", "sheet.png"}));
  ASSERT_TRUE(appears(directory / "sheet.png"));
  fs::create_directory(directory / "s.json");
  fs::create_directory(directory / "a.mp4");
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("dspm: cannot write a.mp4 and s.json: it is not a regular file"), std::string::npos)
      << outcome.err;
  for (int frame = 1; frame <= 3; ++frame) EXPECT_EQ(read_image(directory.image(frame)).width, 12);
}

}  // namespace disk_faults_test
}  // namespace dspm::test
