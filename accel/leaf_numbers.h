// What the number of a leaf says: its 32 bits, but for Bvh::kLeaf, say what is in it, and which of its kind it is.
#pragma once

#include <cstdint>

namespace dspm {

// It is a placed object; its triangles fill two packets; it is a primitive of a crowd.
inline constexpr std::uint32_t kPlaced = 1u << 30, kTwo = 1u << 29, kOfCrowd = kPlaced | kTwo;

}  // namespace dspm
