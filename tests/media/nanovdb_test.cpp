// NanoVDB files that the library has written, whole and damaged.
#include <gtest/gtest.h>

#include "dspm/media/read_nanovdb.h"

#ifdef DSPM_NANOVDB
#include <nanovdb/util/IO.h>
#include <nanovdb/util/Primitives.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

#include "tests/support/temporary_directory.h"
#endif

namespace dspm {
namespace nanovdb_test {

#ifdef DSPM_NANOVDB

struct File {
  test::TemporaryDirectory directory;
  std::filesystem::path path = directory / "ball.nvdb";
  nanovdb::GridHandle<> grid;

  /// A ball of radius 3 around (1, 2, 3), of density 1 but for a rim, in voxels of 0.1.
  explicit File(nanovdb::io::Codec codec = nanovdb::io::Codec::NONE)
      : grid(nanovdb::createFogVolumeSphere<float>(3.f, nanovdb::Vec3f(1, 2, 3), 0.1, 3.0, nanovdb::Vec3d(0),
                                                   "density")) {
    nanovdb::io::writeGrid(path.string(), grid, codec);
  }
};

TEST(Nanovdb, HasTheLibrarysValues) {
  for (const auto codec : {nanovdb::io::Codec::NONE, nanovdb::io::Codec::ZIP}) {
    const File file(codec);
    const auto sparse = read_nanovdb(file.path, "density");
    ASSERT_TRUE(sparse);
    const auto* grid = file.grid.grid<float>();
    const auto values = grid->getAccessor();
    std::mt19937 random(3);
    std::uniform_int_distribution<int> voxel(-35, 70);
    int inside = 0;
    for (int i = 0; i < 20'000; ++i) {
      const nanovdb::Coord at(voxel(random), voxel(random), voxel(random));
      const nanovdb::Vec3d p = grid->indexToWorld(nanovdb::Vec3d(at[0], at[1], at[2]));
      if (!values.isActive(at)) continue;
      const float expected = values.getValue(at);
      ++inside;
      EXPECT_NEAR(sparse->at({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}), expected,
                  2e-4f);
    }
    EXPECT_GT(inside, 1000);
    EXPECT_NEAR(sparse->at({1.05f, 2.02f, 3.07f}), 1, 1e-5f);
    EXPECT_EQ(sparse->largest_in({{0, 1, 2}, {2, 3, 4}}), 1);
    EXPECT_EQ(sparse->largest_in({{8, 8, 8}, {9, 9, 9}}), 0);
    EXPECT_LT(sparse->extent().low.x, -1.9f);
    EXPECT_GT(sparse->extent().high.x, 3.9f);
  }
}

TEST(Nanovdb, SaysWhatIsNotThere) {
  const File file;
  EXPECT_FALSE(read_nanovdb(file.path, "heat"));
  EXPECT_THROW(read_nanovdb(file.directory / "none.nvdb", "density"), std::runtime_error);
}

// Each is an error or a grid, but never a crash.
TEST(Nanovdb, SurvivesDamage) {
  const File file;
  std::ifstream in(file.path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::mt19937 random(9);
  int refused = 0;
  for (int i = 0; i < 60; ++i) {
    std::string bytes = whole;
    // Places of nodes are in the first kilobytes and in tables; most of the rest is values.
    const std::size_t among = i % 2 == 0 ? std::min<std::size_t>(bytes.size(), 4096) : bytes.size();
    for (int j = 0; j < 1 + i % 7; ++j) bytes[random() % among] = static_cast<char>(random());
    if (i % 5 == 0) bytes.resize(random() % bytes.size());
    const auto path = file.directory / "damaged.nvdb";
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      const auto sparse = read_nanovdb(path, "density");
      EXPECT_TRUE(!sparse || std::isfinite(sparse->at({1, 2, 3})));
    } catch (const std::exception&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

#else

TEST(Nanovdb, IsNamedWhereItIsMissing) { EXPECT_THROW(read_nanovdb("smoke.nvdb", "density"), std::runtime_error); }

#endif

}  // namespace nanovdb_test
}  // namespace dspm
