// OpenVDB files, against NanoVDB's copy of the same grid. The library's own tools have made both: blocks of several values, two of
// one value, voxels that are turned and shifted; beside them an empty grid of vectors, and one of distances to a surface.
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/process.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace openvdb_test {

using test::Outcome;

const std::filesystem::path kHere = std::filesystem::path(DSPM_SOURCE_DIR) / "tests/media";

class OpenVdb : public ::testing::Test {
 protected:
  void SetUp() override {
#ifndef DSPM_HAS_OPENVDB
    GTEST_SKIP() << "libopenvdb-dev is not installed";
#endif
    std::filesystem::copy(kHere / "block.nvdb", directory_ / "block.nvdb");
    std::ofstream whole(directory_ / "block.vdb", std::ios::binary), half(directory_ / "half.vdb", std::ios::binary);
    const gzFile in = gzopen((kHere / "block.vdb.gz").c_str(), "rb");
    std::array<char, 4096> some{};
    for (int count = 0, all = 0; (count = gzread(in, some.data(), some.size())) > 0; all += count) {
      whole.write(some.data(), count);
      if (all < 1 << 13) half.write(some.data(), count);
    }
    gzclose(in);
  }

  Outcome render(const std::string& file, const std::string& grid, const std::string& image) const {
    std::ofstream(directory_ / "scene.dsc") << R"(Integrator "path" "integer maxdepth" 4
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
LookAt 1 2 -6  0 .3 0  0 1 0
Camera "perspective" "float fov" 35
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
LightSource "distant" "rgb L" [2 1 1] "point3 from" [1 1 -1]
MakeNamedMedium "smoke" "string type" "nanovdb" "string filename" ")"
                                            << file << R"(" "string gridname" ")" << grid << R"("
AttributeBegin MediumInterface "smoke" "" Material "interface" Shape "sphere" "float radius" 3 AttributeEnd
)";
    return test::run(directory_, {"scene.dsc", "--iterations", "2", "-o", image});
  }
  std::string read(const std::string& name) const { return test::contents(directory_ / name); }

  test::TemporaryDirectory directory_;
};

TEST_F(OpenVdb, HasTheValuesOfItsNanoVdb) {
  ASSERT_EQ(render("block.vdb", "density", "open.pfm").code, 0);
  ASSERT_EQ(render("block.nvdb", "density", "nano.pfm").code, 0);
  ASSERT_EQ(render("block.vdb", "none", "no.pfm").code, 1);
  const std::string open = read("open.pfm");
  EXPECT_EQ(open.size(), 24u * 24 * 3 * sizeof(float) + std::string("PF\n24 24\n-1.0\n").size());
  EXPECT_EQ(open, read("nano.pfm"));
}

TEST_F(OpenVdb, SaysWhatItDoesNotRead) {
  const auto expect = [&](const std::string& file, const std::string& grid, const std::string& words) {
    const Outcome outcome = render(file, grid, "no.pfm");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  };
  expect("block.vdb", "velocity", "its values are not plain numbers");
  expect("block.vdb", "surface", "a level set");
  expect("block.vdb", "other", "has no grid \"other\"");
  expect("half.vdb", "density", "cannot be read");
}

}  // namespace openvdb_test
}  // namespace dspm
