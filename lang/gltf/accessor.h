// The numbers of accessors: of all types of components, normalised, sparse, without a buffer.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "dspm/lang/gltf/document.h"

namespace dspm::gltf {

/// `count` elements of `width` numbers, one after the other.
struct Numbers {
  std::size_t count = 0, width = 1;
  std::vector<float> values;

  const float* operator[](std::size_t element) const { return values.data() + element * width; }
};

/// Returns the numbers of accessors/index. Integers that are normalised become 0 to 1, or -1 to 1. Throws
/// std::runtime_error, also if a value is not finite.
Numbers numbers_of(const Document& document, std::size_t index);
/// Returns the exact numbers of an accessor of whole numbers.
std::vector<std::uint32_t> indices_of(const Document& document, std::size_t index);

}  // namespace dspm::gltf
