// NanoVDB files, to a grid that has a value everywhere.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <string>

#include "dspm/media/read_nanovdb.h"
#include "tests/fuzz/target.h"

namespace {

/// A file in memory, which the reader asks for by its path.
class File {
 public:
  File(const std::uint8_t* data, std::size_t size) : descriptor_(memfd_create("volume", 0)) {
    dspm::fuzz::require(write(descriptor_, data, size) == static_cast<ssize_t>(size), "no file in memory");
  }
  ~File() { close(descriptor_); }
  File(const File&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  const File file(data, size);
  try {
    const std::optional<SparseGrid> grid = read_nanovdb(file.path(), "density");
    if (!grid) return 0;
    const Bounds3 box = grid->extent();
    const float most = grid->largest_in(box);
    for (const float share : {0.f, 0.3f, 1.f}) {
      const float value = grid->at(box.low + (box.high - box.low) * share);
      fuzz::require(!(std::isfinite(value) && value > most * 1.001f + 1e-6f), "a value above the largest one");
    }
  } catch (const std::runtime_error&) {}
  return 0;
}
