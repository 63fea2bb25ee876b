// The things around the coffee pot of material.dsc, each on the origin: tumbler.ply, of glass and with a thick bottom,
// and cup.ply, of china. The unit is 10 cm.
#include "dspm/base/math/vec.h"
#include "scenes/generator/mesh_file.h"
#include "scenes/generator/modelling.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr int kSides = 128;

std::vector<Vec2> tumbler() {
  return {{0, 0},        {.3f, 0},       {.325f, .008f}, {.335f, .03f}, {.36f, .35f}, {.39f, .7f},
          {.42f, 1.05f}, {.416f, 1.06f}, {.406f, 1.06f}, {.4f, 1.05f},  {.37f, .7f},  {.34f, .35f},
          {.318f, .17f}, {.3f, .14f},    {.26f, .125f},  {0, .12f}};
}

std::vector<Vec2> cup() {
  return {{0, .02f},     {.2f, .02f},   {.22f, 0},     {.25f, 0},    {.262f, .02f},  {.255f, .05f},  {.3f, .1f},
          {.36f, .2f},   {.41f, .36f},  {.44f, .55f},  {.45f, .66f}, {.445f, .672f}, {.432f, .672f}, {.425f, .66f},
          {.415f, .55f}, {.385f, .37f}, {.335f, .22f}, {.26f, .13f}, {.15f, .1f},    {0, .095f}};
}

}  // namespace

void make_tableware(const std::filesystem::path& directory) {
  write_ply(directory / "tumbler.ply", with_normals(lathe(tumbler(), kSides), 50));
  write_ply(directory / "cup.ply", with_normals(lathe(cup(), kSides), 60));
}

}  // namespace dspm
