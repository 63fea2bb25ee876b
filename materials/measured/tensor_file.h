// The container of RGL's .bsdf files: named arrays of numbers.
// [Dupuy and Jakob 2018, An Adaptive Parameterization for Efficient Material Acquisition and Rendering]
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dspm {

struct Tensor {
  std::vector<std::size_t> shape;
  std::vector<float> values;  // the last dimension's lie next to each other
};

/// Returns the arrays of 32-bit floats, and of bytes; others are left out. Throws std::runtime_error with a sentence
/// that does not name the file. Takes no more than four times the memory of `bytes`.
std::map<std::string, Tensor> decode_tensors(std::string_view bytes);

}  // namespace dspm
