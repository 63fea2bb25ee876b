// Names the machine, on which the bits of a computation depend besides the program.
#pragma once

#include <string>

namespace dspm {

/// Returns the instruction set, as far as libm chooses its functions by it, and the C library: "x86-64 with AVX2, FMA,
/// AVX-512; glibc 2.36".
std::string machine_in_words();

}  // namespace dspm
