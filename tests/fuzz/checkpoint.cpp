// Checkpoints, to the state of an integrator. The checksum is put right, so that what lies behind it is reached.
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include "dspm/session/checkpoint/checkpoint_file.h"
#include "tests/fuzz/target.h"
#include "tests/support/idle_integrator.h"

namespace dspm::fuzz {
namespace {

/// Has sums of a few pixels.
class FewSums final : public test::IdleIntegrator {
 public:
  bool persist(StateStream& state) override {
    statistics_.persist(state);
    state.value(sums_);
    return true;
  }

 private:
  Statistics statistics_;
  std::vector<Rgb> sums_ = std::vector<Rgb>(4);
};

/// A file in memory, so that no disk is in the way.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("checkpoint", 0)) {}
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  void put(std::string_view bytes) const {
    const bool written = ftruncate(descriptor_, 0) == 0 &&
                         pwrite(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
    require(written, "no room for the input");
  }

 private:
  int descriptor_;
};

std::string checkpoint(std::string_view head_and_states) {
  const auto checksum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(head_and_states.data()), head_and_states.size()));
  std::string bytes(CheckpointFile::kMagic);
  bytes += head_and_states;
  return bytes.append(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
}

}  // namespace
}  // namespace dspm::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dspm;
  static const fuzz::MemoryFile file;
  file.put(fuzz::checkpoint(fuzz::text(data, size)));
  try {
    const CheckpointFile read(file.path());
    for (std::size_t i = 0; i < read.intervals().size(); ++i) {
      fuzz::FewSums integrator;
      read.load(i, integrator);
    }
  } catch (const std::runtime_error&) {}
  return 0;
}
