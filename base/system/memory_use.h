// The memory use of this process.
#pragma once

#include <cstddef>

namespace dspm {

/// Returns the peak so far, in bytes.
std::size_t peak_memory();
/// Returns the peak of the address space, in bytes, which includes memory that is reserved but not used.
std::size_t peak_address_space();

}  // namespace dspm
