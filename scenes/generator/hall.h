// The cathedral's measures, in metres, and the pieces that it is assembled from. The nave runs along x, y is up, and
// the middle of its floor is the origin; the apse is at the end of large x, the rose at the other.
#pragma once

#include "dspm/shapes/triangle_mesh.h"
#include "scenes/generator/masonry.h"

namespace dspm::hall {

inline constexpr int kBays = 7;
inline constexpr float kBay = 5;                    // from pier to pier
inline constexpr float kEnd = 0.5f * kBays * kBay;  // half the length
inline constexpr float kNave = 4.05f;               // half the nave's width
inline constexpr float kPierWall = 0.9f;            // thickness of the wall on the arcades
inline constexpr float kAisle = 9;                  // from the middle to the outer walls
inline constexpr float kArcadeSpring = 4.2f;        // where the arcades' arches begin, and the aisles' vaults
inline constexpr float kVaultSpring = 8.5f;
inline constexpr float kVaultRise = 5.6f, kAisleRise = 2.75f;
inline constexpr float kPointedness = 0.4f;  // of all vaults

/// By material.
struct Parts {
  MeshData floor, border;       // tiles with uv in metres; the bands on which the piers stand
  MeshData stone, trim, webs;   // walls; columns, ribs and mouldings; the vaults between the ribs
  MeshData sunny, shady, rose;  // panes of the windows: towards small z, towards large z, the western one
};

/// x of the pier `i`, from 0 to kBays.
inline float pier_x(int i) { return static_cast<float>(i) * kBay - kEnd; }

void add_floor(Parts& parts);
void add_piers(Parts& parts);
void add_walls(Parts& parts);
void add_apse(Parts& parts);
void add_vaults(Parts& parts);

}  // namespace dspm::hall
