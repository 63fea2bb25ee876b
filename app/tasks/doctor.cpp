#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <thread>
#include <vector>

#include "dspm/accel/embree_version.h"
#include "dspm/app/tasks/optional_parts.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/app/tasks/version_text.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/system/cpu_quota.h"
#include "dspm/base/system/graphics_cards.h"
#include "dspm/base/system/machine.h"
#include "dspm/base/system/machine_memory.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/readable.h"
#include "dspm/base/system/version.h"
#include "dspm/image/image.h"
#include "dspm/looking/terminal.h"
#include "dspm/session/joint_render.h"
#include "dspm/session/load.h"
#include "dspm/session/out_of_memory.h"

namespace dspm {
namespace {

/// A furnace: a closed box whose walls emit half of the light and reflect half of what they receive, so that its
/// radiance is L = 1/2 + L/2 = 1 everywhere. Its tree is Embree's.
constexpr const char* kFurnace = R"(
Integrator "dsppm" "integer iterations" 16 "integer photons" 2000 "string emission" "power"
Accelerator "two-level" "string static" "embree"
Camera "perspective" "float fov" 30
Film "rgb" "integer xresolution" 2 "integer yresolution" 2 "string filename" "furnace.exr"
WorldBegin
AreaLightSource "diffuse" "rgb L" [.5 .5 .5] "bool twosided" true
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "trianglemesh" "point3 P" [-1 -1 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 1 1 -1 1 1 1 1 -1 1 1]
  "integer indices" [0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 3 7 6 3 6 2 0 4 7 0 7 3 1 2 6 1 6 5]
)";
constexpr double kTolerance = 0.05;  // of the mean; the random numbers are always the same

double mean_of_furnace() {
  Diagnostics diagnostics;
  const auto scene = std::make_shared<const LoadedScene>("furnace.dsc", kFurnace, Choices{}, diagnostics);
  JointRender render(scene);
  while (render.iterations() < render.wanted()) render.iterate();
  const Image image = render.image(0);
  double sum = 0;
  for (const auto& pixel : image.pixels) sum += (pixel.r + pixel.g + pixel.b) / 3;
  return sum / static_cast<double>(image.pixels.size());
}

/// Returns what is wrong with a render, or an empty string.
std::string fault_of_rendering() {
  try {
    const double mean = mean_of_furnace();
    return std::abs(mean - 1) < kTolerance ? "" : fmt::format("pixels that should have radiance 1 have {:.3g}", mean);
  } catch (const std::exception& error) {
    return is_out_of_memory(error) ? "out of memory" : error.what();
  }
}

std::string threads_in_words() {
  const std::optional<double> quota = cpu_quota();
  return fmt::format("{} of {}{}", thread_count(), counted(std::thread::hardware_concurrency(), "processor"),
                     quota ? fmt::format("; a container's or scheduler's quota is {:.3g}", *quota) : "");
}

std::string memory_in_words() {
  const MachineMemory memory = machine_memory();
  return fmt::format("{}, of which {} available{}", readable_bytes(memory.total), readable_bytes(memory.available),
                     memory.limit ? fmt::format("; a container's or scheduler's limit is {} (--memory keeps within it)",
                                                readable_bytes(*memory.limit))
                                  : "");
}

std::string graphics_in_words() {
  const std::vector<std::string> cards = graphics_cards();
  return cards.empty() ? "none, and dspm needs none" : fmt::format("{}; dspm does not use it", fmt::join(cards, ", "));
}

std::string terminal_in_words() {
  if (isatty(STDERR_FILENO) == 0) return "standard error is none";
  const TerminalSize size = size_of_terminal(STDERR_FILENO);
  const std::string of_size = fmt::format("{} x {} characters", size.columns, size.rows);
  switch (graphics_of_standard_error().kind) {
    case Graphics::kitty: return of_size + "; shows images (kitty's protocol), as --preview needs";
    case Graphics::sixel: return of_size + "; shows images (sixels), as --preview needs";
    case Graphics::none: break;
  }
  return of_size + "; shows no images (neither kitty's nor sixels), so --preview shows nothing";
}

std::string table_of(const std::vector<OptionalPart>& parts) {
  std::size_t names = 0, uses = 0;
  for (const OptionalPart& part : parts)
    names = std::max(names, part.name.size()), uses = std::max(uses, part.use.size());
  std::string found, missing;
  for (const OptionalPart& part : parts) {
    const std::string fault = part.fault();
    (fault.empty() ? found : missing) +=
        fmt::format("  {:<{}}  {:<{}}  {}\n", part.name, names, part.use, uses, part.source) +
        (fault.empty() ? "" : fmt::format("  {:<{}}  ({})\n", "", names, fault));
  }
  return (found.empty() ? "" : "\noptional parts found\n" + found) +
         (missing.empty() ? "" : "\noptional parts missing, and what brings them\n" + missing);
}

}  // namespace

Diagnosis examine_installation(int threads) {
  const ThreadLimit limit(threads);
  const std::string fault = fault_of_rendering();
  std::vector<OptionalPart> parts = built_parts();
  for (OptionalPart& program : other_programs()) parts.push_back(std::move(program));
  std::string text = fmt::format("dspm {}, built by {}; Embree {}\n", kVersion, build_in_words(), embree_version());
  const auto line = [&](const char* what, const std::string& words) {
    text += fmt::format("  {:<9}  {}\n", what, words);
  };
  line("rendering", fault.empty() ? "works: 2 x 2 pixels have the radiance that they must have" : "fails: " + fault);
  line("machine", machine_in_words());
  line("threads", threads_in_words());
  line("memory", memory_in_words());
  line("graphics", graphics_in_words());
  line("terminal", terminal_in_words());
  return {text + table_of(parts), fault.empty()};
}

}  // namespace dspm
