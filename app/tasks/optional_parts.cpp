#include "dspm/app/tasks/optional_parts.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <initializer_list>

#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/child_process.h"
#include "dspm/base/system/find_program.h"
#include "dspm/base/system/version.h"
#include "dspm/image/ocio_view.h"
#include "dspm/lang/gltf/draco.h"
#include "dspm/lang/gltf/meshopt.h"
#include "dspm/media/read_nanovdb.h"
#include "dspm/media/read_openvdb.h"
#include "dspm/output/oidn.h"
#include "dspm/output/video.h"
#include "dspm/integrators/waves/devices.h"
#include "dspm/session/machines/find_link.h"

namespace dspm {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{4};  // with a program that hangs
constexpr const char* kNotBuiltIn = "not built in";

std::string unless(bool works, const std::string& fault) { return works ? "" : fault; }

std::string on_path(std::initializer_list<const char*> programs) {
  for (const char* program : programs)
    if (find_program(program).empty()) return fmt::format("{} is not on the PATH", program);
  return "";
}

/// Calls attempt(file) with a name in the folder for temporary files. Returns why it failed.
template <class Attempt>
std::string fault_of(const Attempt& attempt) {
  try {
    attempt(std::filesystem::temp_directory_path() / fmt::format("dspm-doctor-{}", getpid()));
    return "";
  } catch (const WriteError& error) {
    return error.cause();
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::string fault_of_ffmpeg() {
  if (const std::string fault = on_path({"ffmpeg"}); !fault.empty()) return fault;
  const Clock::time_point end = Clock::now() + kPatience;
  return fault_of([&](const std::filesystem::path& file) {
    const Video trial(file.string() + ".mp4", {16, 16}, [end] { return Clock::now() > end; });
  });
}

std::string fault_of_oidn() {
  if (const std::string fault = on_path({"oidnDenoise"}); !fault.empty()) return fault;
  return fault_of([](const std::filesystem::path& file) { try_oidn(file); });
}

/// The module is another build's if its version differs. The folder that the user is in holds no modules.
std::string fault_of_python() {
  if (const std::string fault = on_path({"python3"}); !fault.empty()) return fault;
  const std::string script = fmt::format(
      "import sys\n"
      "sys.path = [folder for folder in sys.path if folder]\n"
      "import dspm\n"
      "if dspm.__version__ != '{0}': sys.exit(f'ImportError: it is the module of dspm {{dspm.__version__}}')\n",
      kVersion);
  try {
    ChildProcess python({"python3", "-c", script},
                        [end = Clock::now() + kPatience](auto) { return Clock::now() > end; });
    if (python.wait() == 0) return "";
    const std::string& said = python.errors();
    return said.empty() ? "python3 fails" : said.substr(said.rfind('\n') + 1);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

std::vector<OptionalPart> built_parts() {
  const auto in_library = [](const char* name, const char* use, const char* source, bool is_built) {
    return OptionalPart{name, use, source, [is_built] { return unless(is_built, kNotBuiltIn); }, is_built};
  };
  const auto in_module = [](const char* name, const char* use, const char* source, bool is_built, auto* fault) {
    return OptionalPart{name, use, source, [=] { return is_built ? fault() : std::string(kNotBuiltIn); }, is_built};
  };
  return {
      in_library("Draco", "glTF meshes that it has compressed", "libdraco-dev, when dspm is built",
                 gltf::reads_draco()),
      in_library("meshoptimizer", "glTF buffers that it has compressed", "libmeshoptimizer-dev, when dspm is built",
                 gltf::reads_meshopt()),
      in_library("NanoVDB", "media of .nvdb files", "libnanovdb-dev, when dspm is built", reads_nanovdb()),
      in_module("OpenVDB", "media of .vdb files", "libopenvdb-dev, when dspm is built", has_openvdb_module(),
                fault_of_openvdb_module),
      in_library("OpenColorIO", "--view ocio", "libopencolorio-dev, when dspm is built with -DDSPM_OCIO=ON",
                 knows_ocio()),
      in_module("MPI", "mpirun -n 16 dspm: several machines together",
                "openmpi-bin; libopenmpi-dev, when dspm is built", has_mpi_module(), fault_of_mpi_module),
      in_module("CUDA", "--device gpu, with an NVIDIA card", "nvcc of CUDA 12 or later, when dspm is built",
                has_gpu_module(), why_no_gpu),
  };
}

std::vector<OptionalPart> other_programs() {
  return {
      {"mpirun", "starts dspm on several machines", "openmpi-bin", [] { return on_path({"mpirun"}); }},
      {"ffmpeg", "--video", "ffmpeg", fault_of_ffmpeg},
      {"oidnDenoise", "--denoise oidn", "openimagedenoise.org (no package of Debian's)", fault_of_oidn},
      {"Python module", "import dspm", "dspm's own package with python3-numpy; to build it: pybind11-dev, python3-dev",
       fault_of_python},
      {"compiler", "plugins of your own: --new-plugin", "g++, cmake, make",
       [] {
         return on_path({"c++", "cmake"});
       }},
      {"Blender", "the add-on", "blender", [] { return on_path({"blender"}); }},
  };
}

}  // namespace dspm
