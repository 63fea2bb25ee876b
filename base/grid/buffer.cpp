#include "dspm/base/grid/buffer.h"

#include <sys/mman.h>

#include <new>

namespace dspm::detail {
namespace {

// A gather reads all over arrays of this size, for which the processor's table of pages is too small. Smaller arrays
// would be rounded up too much.
constexpr std::size_t kLarge = std::size_t{32} << 20, kHugePage = std::size_t{2} << 20, kCacheLine = 64;

std::align_val_t alignment(std::size_t bytes) { return std::align_val_t(bytes >= kLarge ? kHugePage : kCacheLine); }

}  // namespace

void* new_array(std::size_t bytes) {
  void* const memory = ::operator new(bytes, alignment(bytes));
  if (bytes >= kLarge) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: the kernel may have none
  return memory;
}

void delete_array(void* memory, std::size_t bytes) { ::operator delete(memory, alignment(bytes)); }

}  // namespace dspm::detail
