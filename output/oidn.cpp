#include "dspm/output/oidn.h"

#include <fmt/format.h>
#include <unistd.h>

#include <exception>
#include <string>
#include <system_error>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/child_process.h"
#include "dspm/base/system/read_file.h"
#include "dspm/base/system/sudden_end.h"
#include "dspm/image/decoders.h"
#include "dspm/image/write_floats.h"

namespace dspm {
namespace {

constexpr const char* kProgram = "oidnDenoise";

/// A PFM file, because oidnDenoise goes by the extension. Names differ between processes.
class PfmFile {
 public:
  PfmFile(std::filesystem::path beside, const char* what) : path_(std::move(beside)), leftover_(named(what)) {}
  ~PfmFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  PfmFile(const PfmFile&) = delete;
  PfmFile& operator=(const PfmFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  const std::filesystem::path& named(const char* what) {
    path_ += fmt::format(".{}-{}.pfm", what, getpid());
    return path_;
  }

  std::filesystem::path path_;
  Leftover leftover_;
};

void run(const std::filesystem::path& file, const std::vector<std::string>& words) {
  try {
    ChildProcess oidn(words);
    const int code = oidn.wait();
    if (code != 0)
      throw WriteError(file, fmt::format("{} failed with exit code {}, saying: {}", kProgram, code,
                                         oidn.errors().empty() ? "nothing" : oidn.errors()));
  } catch (const std::system_error& error) {
    const bool missing = error.code() == std::errc::no_such_file_or_directory;
    throw WriteError(file, missing
                               ? fmt::format("the program {} is missing; install Open Image Denoise, or use "
                                             "--denoise, which needs no other program",
                                             kProgram)
                               : fmt::format("the program {} cannot be run ({})", kProgram, error.code().message()));
  }
}

}  // namespace

Image denoised_by_oidn(const std::filesystem::path& file, const Image& radiance, const Image& albedo,
                       const Image& normal) {
  const PfmFile colours(file, "colour"), albedos(file, "albedo"), normals(file, "normal"), result(file, "denoised");
  write_pfm(colours.path(), radiance);
  write_pfm(albedos.path(), albedo);
  write_pfm(normals.path(), normal);
  run(file, {kProgram, "--hdr", colours.path().string(), "--alb", albedos.path().string(), "--nrm",
             normals.path().string(), "-o", result.path().string()});
  Image image;
  try {
    image = decode_pfm(read_other_bytes(result.path()));
  } catch (const std::exception& error) {
    throw WriteError(file, fmt::format("{} left no image: {}", kProgram, error.what()));
  }
  if (image.width != radiance.width || image.height != radiance.height)
    throw WriteError(file, fmt::format("{} left an image of {} x {} pixels instead of {} x {}", kProgram, image.width,
                                       image.height, radiance.width, radiance.height));
  return image;
}

void try_oidn(const std::filesystem::path& file) {
  constexpr int kSide = 16;
  const Image black(kSide, kSide);
  denoised_by_oidn(file, black, black, black);
}

}  // namespace dspm
