// 24 hours in miniature: many iterations, with images written now and then, take no more memory than a few.
// DSPM_LONG_RUN is the number of iterations; ./dev soak has 10,000.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>

#include "dspm/image/image.h"
#include "tests/support/process.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DSPM_MEMORY_OF_ITS_OWN 1  // a sanitizer keeps what is freed
#endif

namespace dspm::test {
namespace {

// Buffers settle within a few hundred iterations.
double flat(int iterations) { return iterations < 1000 ? 1.03 : 1.01; }

std::string iterations() {
  const char* const given = std::getenv("DSPM_LONG_RUN");
  return given != nullptr ? given : "400";
}

/// What the process holds from time to time, until it ends.
std::vector<std::size_t> resident_bytes(const Process& process) {
  std::vector<std::size_t> bytes;
  while (const std::size_t now = process.resident_bytes()) {
    bytes.push_back(now);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return bytes;
}

class LongRun : public ::testing::TestWithParam<const char*> {};

TEST_P(LongRun, TakesNoMoreMemoryThanAShortOne) {
#ifdef DSPM_MEMORY_OF_ITS_OWN
  GTEST_SKIP();
#endif
  const TinyDirectory directory;
  std::string scene =
      tiny_scene(R"("dsppm" "string indirect" "photons" "integer iterations" 2 "integer photons" 200)", GetParam());
  const std::string size = "12 \"integer yresolution\" 8";
  put_file(directory / "tiny.dsc", scene.replace(scene.find(size), size.size(), "48 \"integer yresolution\" 32"));
  const Process process(directory, {"tiny.dsc", "--iterations", iterations(), "--write-every", "20", "--png",
                                    "--contact-sheet", "sheet.png", "--nthreads", "2", "--stats=s.json"});
  const std::vector<std::size_t> bytes = resident_bytes(process);
  const Outcome outcome = process.wait();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_GT(bytes.size(), 40u) << "too short a run to tell";
  const auto warm = bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 4);
  const auto most = static_cast<double>(*std::max_element(warm, bytes.end()));
  const auto before = static_cast<double>(*std::max_element(bytes.begin(), warm));
  std::cout << GetParam() << ": " << iterations() << " iterations, " << before / 1e6 << " MB in the first quarter, "
            << most / 1e6 << " MB after it\n";
  EXPECT_LE(most, flat(std::stoi(iterations())) * before);
}

INSTANTIATE_TEST_SUITE_P(Integrators, LongRun,
                         ::testing::Values(R"("dsppm" "integer photons" 5000)",
                                           R"("dsppm" "string estimator" "hj09" "integer photons" 5000)",
                                           R"("photonmap" "integer photons" 2000 "integer causticphotons" 2000)",
                                           R"("photonmap" "integer photons" 2000 "integer finalgather" 2)",
                                           R"("path")"));

}  // namespace
}  // namespace dspm::test
