// Sections are found in real libraries, and files that are none are told.
#include "dspm/session/modules/elf_section.h"

#include <gtest/gtest.h>

#include "dspm/session/modules/stamp.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace elf_section_test {

const std::filesystem::path kModule = std::filesystem::path(DSPM_TEST_MODULES) / "libidle.so";

std::string error_of(const std::filesystem::path& file) {
  try {
    elf_section(file, ".note.dspm");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(ElfSection, HoldsWhatWasWritten) {
  const ModuleStamp stamp = current_stamp();
  const auto section = elf_section(kModule, ".note.dspm");
  ASSERT_TRUE(section);
  EXPECT_EQ(section->substr(0, sizeof(stamp)), std::string(reinterpret_cast<const char*>(&stamp), sizeof(stamp)));
}

TEST(ElfSection, NothingWhereThereIsNone) { EXPECT_FALSE(elf_section(kModule, ".note.dsp")); }

TEST(ElfSection, OtherFilesAreNoLibraries) {
  const TemporaryDirectory directory;
  put_file(directory / "text", "Shape \"sphere\"");
  put_file(directory / "empty", "");
  put_file(directory / "zeros", std::string(4096, '\0'));
  for (const char* name : {"text", "empty", "zeros"})
    EXPECT_EQ(error_of(directory / name), "it is not a shared library") << name;

  EXPECT_EQ(error_of(directory / "missing"), "it cannot be read");
}

TEST(ElfSection, NoBytesOfAFileLeadOutOfIt) {
  const TemporaryDirectory directory;
  const std::string whole = contents(kModule);
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    put_file(directory / "part", whole.substr(0, size));
    EXPECT_NE(error_of(directory / "part"), "") << size;
  }
  std::uint32_t state = 1;
  for (int i = 0; i < 4000; ++i) {  // the header and the section headers are where numbers lead elsewhere
    std::string damaged = whole;
    state = state * 1664525 + 1013904223;
    const std::size_t headers = 64, at = i % 2 == 0 ? state % headers : whole.size() - 1 - state % 2048;
    damaged[at] = static_cast<char>(state >> 24);
    put_file(directory / "damaged", damaged);
    error_of(directory / "damaged");  // must come back, with an error or without
  }
}

}  // namespace elf_section_test
}  // namespace dspm::test
