#include <openvdb/openvdb.h>
#include <openvdb/util/logging.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "dspm/media/openvdb/raw_grid.h"

namespace {

using dspm::RawGrid;

void expect_affine(const openvdb::math::Mat4d& m) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      if (!std::isfinite(m[row][column])) throw std::runtime_error("its placement is not finite");
}

RawGrid::Index index(const openvdb::Coord& at) { return {at.x(), at.y(), at.z()}; }

/// OpenVDB's matrices multiply rows from the right.
std::array<double, 12> placement(const openvdb::math::Transform& transform) {
  if (!transform.isLinear()) throw std::runtime_error("its voxels lie in a frustum: only boxes can be read");
  const openvdb::math::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();
  expect_affine(m);
  std::array<double, 12> rows{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) rows[static_cast<std::size_t>(4 * row + column)] = m[column][row];
  return rows;
}

std::unique_ptr<RawGrid> raw(const openvdb::FloatGrid& grid) {
  if (grid.getGridClass() == openvdb::GRID_LEVEL_SET)
    throw std::runtime_error("it holds distances to a surface (a level set), and no density");
  auto result = std::make_unique<RawGrid>();
  result->world_from_index = placement(grid.transform());
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    result->leaves.push_back(index(leaf->origin()));
    const float* const values = leaf->buffer().data();
    for (openvdb::Index i = 0; i < openvdb::FloatTree::LeafNodeType::SIZE; ++i)
      result->values.push_back(leaf->isValueOn(i) ? values[i] : 0);
  }
  auto tile = grid.cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    const openvdb::CoordBBox box = tile.getBoundingBox();
    result->tiles.push_back({index(box.min()), box.dim().x(), *tile});
  }
  return result;
}

}  // namespace

extern "C" RawGrid* dspm_read_openvdb(const std::string& file, const std::string& name);

RawGrid* dspm_read_openvdb(const std::string& file, const std::string& name) try {
  openvdb::initialize();
  openvdb::logging::setLevel(openvdb::logging::Level::Fatal);  // what is wrong is thrown, too
  openvdb::io::File in(file);
  in.open(false);  // not later, when the file may have changed
  if (!in.hasGrid(name)) return nullptr;
  const openvdb::GridBase::Ptr grid = in.readGrid(name);
  const auto numbers = openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
  if (!numbers) throw std::runtime_error("its values are not plain numbers (float)");
  return raw(*numbers).release();
} catch (const openvdb::Exception& error) {
  throw std::runtime_error(error.what());
}
