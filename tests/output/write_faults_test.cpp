#include "dspm/output/write_faults.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "dspm/base/system/atomic_file.h"

namespace dspm {
namespace write_faults_test {

/// A file that can be written or not.
struct File {
  std::string name;
  bool broken = true;
  int written = 0;

  WriteFaults::Write write() {
    return [this] {
      if (broken) throw WriteError(name, "the disk is full");
      ++written;
    };
  }
};

class Faults : public ::testing::Test {
 protected:
  std::string told(const std::function<void()>& tell) {
    ::testing::internal::CaptureStderr();
    tell();
    return ::testing::internal::GetCapturedStderr();
  }
  std::string told() {
    return told([this] { faults.report(); });
  }

  Messages messages{false};
  WriteFaults faults{messages};
  File a{"a.exr"}, b{"b.exr"}, c{"c.exr"};
};

TEST_F(Faults, ACauseIsToldOnceWithItsFiles) {
  for (File* file : {&a, &b, &c}) EXPECT_FALSE(faults.attempt(file->name, file->write()));
  const std::string once = told();
  EXPECT_NE(once.find("cannot write a.exr to c.exr (3 files): the disk is full"), std::string::npos) << once;
  EXPECT_FALSE(faults.attempt(a.name, a.write()));
  EXPECT_EQ(told(), "");
  faults.attempt(b.name, [] { throw WriteError("b.exr", "no permission"); });
  const std::string another = told();
  EXPECT_NE(another.find("cannot write b.exr: no permission"), std::string::npos) << another;
  EXPECT_EQ(another.find("the disk is full"), std::string::npos) << another;
}

TEST_F(Faults, AreOverWhenAllFilesAreWritten) {
  for (File* file : {&a, &b}) faults.attempt(file->name, file->write());
  told();
  a.broken = b.broken = false;
  EXPECT_TRUE(faults.attempt(a.name, a.write()));
  EXPECT_TRUE(faults.any());
  EXPECT_EQ(told(), "");
  EXPECT_TRUE(faults.attempt(b.name, b.write()));
  EXPECT_FALSE(faults.any());
  EXPECT_EQ(told(), "dspm: the files that could not be written are written now\n");
  EXPECT_EQ(told(), "");
  EXPECT_EQ(told([this] { faults.report_missing(); }), "");
}

TEST_F(Faults, TheEndTellsAllThatIsMissing) {
  for (File* file : {&a, &b}) faults.attempt(file->name, file->write());
  told();
  EXPECT_EQ(told([this] { faults.report_missing(); }), "dspm: cannot write a.exr and b.exr: the disk is full\n");
}

TEST_F(Faults, WhatIsKeptIsTriedAgainUntilItIsWritten) {
  faults.attempt(a.name, a.write(), WriteFaults::Failed::kept);
  faults.attempt(b.name, b.write());
  faults.retry();
  a.broken = b.broken = false;
  faults.retry();
  faults.retry();
  EXPECT_EQ(a.written, 1);
  EXPECT_EQ(b.written, 0);
  EXPECT_TRUE(faults.any());
}

TEST_F(Faults, ALackOfMemoryIsOneAndOtherErrorsAreNot) {
  EXPECT_FALSE(faults.attempt(a.name, [] { throw std::bad_alloc(); }));
  EXPECT_NE(told().find("a.exr: there is not enough memory"), std::string::npos);
  EXPECT_THROW(faults.attempt(a.name, [] { throw std::logic_error("a bug"); }), std::logic_error);
}

}  // namespace write_faults_test
}  // namespace dspm
