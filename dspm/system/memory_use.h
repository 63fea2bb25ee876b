// The memory use of this process.
#pragma once

#include <cstddef>

namespace dspm {

/// The peak so far, in bytes.
std::size_t peak_memory();
/// Likewise of the address space, which includes memory that is reserved but not used.
std::size_t peak_address_space();

}  // namespace dspm
