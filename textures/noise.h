// Perlin's noise, and sums of its octaves: what the textures fbm, wrinkled, windy, marble and dots are made of. All of it
// compiles for devices. [Perlin 2002, Improving Noise; Perlin 1985, An Image Synthesizer]
#pragma once

#include <cmath>
#include <cstdint>

#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"

namespace dspm {

/// The parameters of a sum of octaves: each is 1.99 times as fine as the last, and has `roughness` times its strength.
struct Octaves {
  int count = 8;
  float roughness = 0.5f;
};

namespace noise_parts {

/// Returns a number of Perlin's permutation of 0 .. 255, which everybody uses, at i modulo 256. [Perlin 2002, reference
/// implementation, https://mrl.cs.nyu.edu/~perlin/noise/]
constexpr int permuted(int i) {
  // Octal, in a string: devices have those, but no other tables of the CPU's.
  constexpr const char* kPermutation =
      "\227\240\211\133\132\017\203\015\311\137\140\065\302\351\007\341\214\044\147\036\105\216\010\143\045\360"
      "\025\012\027\276\006\224\367\170\352\113\000\032\305\076\136\374\333\313\165\043\013\040\071\261\041\130"
      "\355\225\070\127\256\024\175\210\253\250\104\257\112\245\107\206\213\060\033\246\115\222\236\347\123\157"
      "\345\172\074\323\205\346\334\151\134\051\067\056\365\050\364\146\217\066\101\031\077\241\001\330\120\111"
      "\321\114\204\273\320\131\022\251\310\304\207\202\164\274\237\126\244\144\155\306\255\272\003\100\064\331"
      "\342\372\174\173\005\312\046\223\166\176\377\122\125\324\317\316\073\343\057\020\072\021\266\275\034\052"
      "\337\267\252\325\167\370\230\002\054\232\243\106\335\231\145\233\247\053\254\011\201\026\047\375\023\142"
      "\154\156\117\161\340\350\262\271\160\150\332\366\141\344\373\042\362\301\356\322\220\014\277\263\242\361"
      "\121\063\221\353\371\016\357\153\061\300\326\037\265\307\152\235\270\124\314\260\163\171\062\055\177\004"
      "\226\376\212\354\315\135\336\162\103\035\030\110\363\215\200\303\116\102\327\075\234\264";
  return static_cast<std::uint8_t>(kPermutation[i & 255]);
}

/// Returns a pseudo-random number in 0 .. 255 of a corner of the lattice, whose coordinates count modulo 256.
constexpr int hash(int x, int y, int z) { return permuted(permuted(permuted(x) + y) + z); }

/// Returns a corner's influence at the offset d from it: linear, with one of twelve gradients towards the middles of a
/// cube's edges. Sixteen numbers share them; pbrt shares out the last four in another way than Perlin, and so does
/// dspm.
constexpr float influence(int corner, const Vec3& d) {
  const int h = corner & 15;
  const bool first = h == 12 || h == 13;
  const float u = h < 8 || first ? d.x : d.y, v = h < 4 || first ? d.y : d.z;
  return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

/// Goes from 0 to 1, with two derivatives that vanish at both ends.
constexpr float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

constexpr float lerp(float t, float a, float b) { return (1 - t) * a + t * b; }

/// A place along one axis: the cell, modulo 256, and the place in it.
struct Cell {
  int index;
  float offset;

  constexpr explicit Cell(float x) {
    const float below = rounded::floor(x);
    index = static_cast<int>(below - 256 * rounded::floor(below / 256));
    offset = x - below;
  }
};

/// Calls add(place, strength) for each octave.
template <class Add>
constexpr void for_each_octave(const Vec3& p, const Octaves& octaves, Add&& add) {
  float frequency = 1, strength = 1;  // not 2 per octave: the lattices of octaves, where noise is 0, must not coincide
  for (int i = 0; i < octaves.count; ++i) {
    add(p * frequency, strength);
    frequency *= 1.99f, strength *= octaves.roughness;
  }
}

}  // namespace noise_parts

/// Returns noise that is smooth, 0 at all points with whole coordinates, in (-1, 1), and the same in dspm and pbrt. It
/// is 0 if p is not finite.
constexpr float noise(const Vec3& p) {
  using namespace noise_parts;
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

/// Sums over `octaves`. [Musgrave 1992; Pharr, Jakob, Humphreys, Physically Based Rendering, 3rd edition, 10.6.4]
constexpr float fbm(const Vec3& p, const Octaves& octaves) {
  float sum = 0;
  noise_parts::for_each_octave(p, octaves, [&](const Vec3& at, float strength) { sum += strength * noise(at); });
  return sum;
}

/// Sums |noise| over `octaves`.
constexpr float turbulence(const Vec3& p, const Octaves& octaves) {
  float sum = 0;
  noise_parts::for_each_octave(p, octaves,
                               [&](const Vec3& at, float strength) { sum += strength * std::abs(noise(at)); });
  return sum;
}

}  // namespace dspm
