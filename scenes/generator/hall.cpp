// The cathedral: hall_floor.ply. Metres; the nave runs along x, y is up.
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/subjects.h"

namespace dspm {

void make_hall(const std::filesystem::path& directory) {
  MeshData floor{{{-18, 0, -9}, {18, 0, -9}, {18, 0, 9}, {-18, 0, 9}}, {}, {{0, 0}, {36, 0}, {36, 18}, {0, 18}}, {}};
  floor.faces = {{0, 2, 1}, {0, 3, 2}};
  write_ply(directory / "hall_floor.ply", floor);
}

}  // namespace dspm
