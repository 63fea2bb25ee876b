// The images that an integrator gives of every frame, by name.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dspm {

inline constexpr const char* kRadiance = "radiance";

struct OutputInfo {
  std::string name;                         // as in --aov
  std::vector<std::string> channels;        // one to three, for EXR files: "name.X"; the r, g and b of the image
  std::string sentence;                     // what the values are, and their unit
  bool single = false;                      // in single precision even if the film says half
  bool is_id = false;                       // a value is id_of() one of the names, or 0
  std::span<const std::string> names = {};  // in memory as long as the integrator
  bool is_radiance = false;                 // a part of it: exposed and balanced likewise
  std::string cryptomatte = {};             // it holds ids and shares of this Cryptomatte; empty: of none
};

inline OutputInfo radiance_output() { return {kRadiance, {"R", "G", "B"}, "radiance in W/(m^2 sr)"}; }
/// Puts radiance before the others.
inline std::vector<OutputInfo> with_radiance(std::vector<OutputInfo> others) {
  others.insert(others.begin(), radiance_output());
  return others;
}

/// The name of the output of a group of lights.
inline std::string light_group_output(const std::string& group) { return "light_" + group; }

/// MurmurHash3_x86_32 with seed 0. [Austin Appleby, public domain]
std::uint32_t name_hash(const std::string& name);
/// A name's id in images: a hash as the bits of a float, never 0, infinite or NaN. [Cryptomatte specification 1.2.0]
float id_of(const std::string& name);

}  // namespace dspm
