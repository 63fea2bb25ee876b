#include "dspm/textures/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace dspm {
namespace {

// Perlin's permutation of 0 .. 255, which everybody uses. [Perlin 2002, reference implementation,
// https://mrl.cs.nyu.edu/~perlin/noise/]
constexpr std::array<std::uint8_t, 256> kPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142,
    8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203,
    117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165,
    71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,
    55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,
    18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250,
    124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189,
    28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,
    129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,
    242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114,
    67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

/// Returns a pseudo-random number in 0 .. 255 of a corner of the lattice, whose coordinates count modulo 256.
int hash(int x, int y, int z) {
  const auto permuted = [](int i) { return int{kPermutation[static_cast<std::size_t>(i & 255)]}; };
  return permuted(permuted(permuted(x) + y) + z);
}

/// Returns a corner's influence at the offset d from it: linear, with one of twelve gradients towards the middles of a
/// cube's edges. Sixteen numbers share them; pbrt shares out the last four in another way than Perlin, and so does
/// dspm.
float influence(int corner, const Vec3& d) {
  const int h = corner & 15;
  const bool first = h == 12 || h == 13;
  const float u = h < 8 || first ? d.x : d.y, v = h < 4 || first ? d.y : d.z;
  return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

/// Goes from 0 to 1, with two derivatives that vanish at both ends.
float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

float lerp(float t, float a, float b) { return (1 - t) * a + t * b; }

/// A place along one axis: the cell, modulo 256, and the place in it.
struct Cell {
  int index;
  float offset;

  explicit Cell(float x) {
    const float below = std::floor(x);
    index = static_cast<int>(below - 256 * std::floor(below / 256));
    offset = x - below;
  }
};

/// Calls add(place, strength) for each octave.
template <class Add>
void for_each_octave(const Vec3& p, const Octaves& octaves, Add&& add) {
  float frequency = 1, strength = 1;  // not 2 per octave: the lattices of octaves, where noise is 0, must not coincide
  for (int i = 0; i < octaves.count; ++i) {
    add(p * frequency, strength);
    frequency *= 1.99f, strength *= octaves.roughness;
  }
}

}  // namespace

float noise(const Vec3& p) {
  if (!is_finite(p)) return 0;
  const Cell x(p.x), y(p.y), z(p.z);
  const auto corner = [&](int i, int j, int k) {
    const Vec3 away{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
    return influence(hash(x.index + i, y.index + j, z.index + k), Vec3{x.offset, y.offset, z.offset} - away);
  };
  const float along_x = fade(x.offset), along_y = fade(y.offset);
  const auto face = [&](int k) {
    return lerp(along_y, lerp(along_x, corner(0, 0, k), corner(1, 0, k)),
                lerp(along_x, corner(0, 1, k), corner(1, 1, k)));
  };
  return lerp(fade(z.offset), face(0), face(1));
}

Octaves Octaves::read(ParamReader& reader) {
  constexpr int kMost = 64;
  Octaves octaves;
  octaves.count = reader.integer("octaves", 8, {}, "the number of sizes of noise that are added up");
  octaves.roughness = reader.number("roughness", 0.5f, {}, "the strength of each octave over that of the last");
  if (octaves.count < 0 || octaves.count > kMost) {
    reader.error("octaves", "the number of octaves must be from 0 to 64");
    octaves.count = 8;
  }
  return octaves;
}

float fbm(const Vec3& p, const Octaves& octaves) {
  float sum = 0;
  for_each_octave(p, octaves, [&](const Vec3& at, float strength) { sum += strength * noise(at); });
  return sum;
}

float turbulence(const Vec3& p, const Octaves& octaves) {
  float sum = 0;
  for_each_octave(p, octaves, [&](const Vec3& at, float strength) { sum += strength * std::abs(noise(at)); });
  return sum;
}

}  // namespace dspm
