// The paper's first scene on every device that traces its paths, all frames together and one by one: milliseconds an
// iteration, and whether the images are the same. The cathedral is grey: its own materials have relief, which has no plain form.
#include <cstring>

#include "bench/measure/rounds.h"
#include "bench/report/progress.h"
#include "bench/report/table.h"
#include "bench/sections/sections.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/image/image.h"
#include "dspm/integrators/waves/devices.h"
#include "dspm/integrators/waves/machine.h"

namespace dspm {
namespace {

struct Tracing {
  Device device;
  const char* name;
};
constexpr Tracing kOnCpu = {Device::cpu, "CPU"}, kInWaves = {Device::waves, "waves on the CPU"},
                  kOnGpu = {Device::gpu, "GPU"};

struct TracingEffort {
  int iterations;        // the first, in which buffers grow, does not count
  std::size_t separate;  // at most this many frames are rendered one by one; all others count as their mean
};

struct Traced {
  Tracing by;
  Rounds together, one_by_one;
  std::size_t pixels = 0, differ = 0;  // from those of the first device
};

/// How many pixels of the runs' images there are, and how many differ in a bit.
void compare_pixels(const Group& runs, const Group& others, Traced& traced) {
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (Frame f = 0; f < runs[run].scene->frame_count(); ++f) {
      const Image a = runs[run].integrator->estimate(f), b = others[run].integrator->estimate(f);
      traced.pixels += a.pixels.size();
      for (std::size_t i = 0; i < a.pixels.size(); ++i)
        traced.differ += std::memcmp(&a.pixels[i], &b.pixels[i], sizeof(Rgb)) != 0;
    }
  }
}

Rounds times(Rounds rounds, double factor) {
  for (StepSeconds& round : rounds)
    for (double& seconds : round) seconds *= factor;
  return rounds;
}

Job on(Job job, Device device) {
  job.settings.device = device;
  return job;
}

/// If a GPU cannot be taken any more, integrators render on the CPU instead.
void expect_gpu(const std::vector<Tracing>& devices) {
  if (devices.back().device == Device::gpu && tracer_on(Device::gpu) == nullptr)
    throw MachineFailure("the GPU cannot be used any more");
}

/// All of them take turns. Throws MachineFailure.
std::vector<Traced> trace_in_turns(const LoadedScene& loaded, const Job& job, const std::vector<Tracing>& devices,
                                   const TracingEffort& effort) {
  std::vector<Group> groups;
  for (const Tracing& by : devices) {
    groups.emplace_back().push_back(start(loaded, on(job, by.device), "dsppm", job.frames));
    groups.push_back(start_each(loaded, on(job, by.device), "sppm", spread_frames(job.frames, effort.separate)));
  }
  expect_gpu(devices);
  const std::vector<Rounds> seconds = in_turns(groups, effort.iterations);
  std::vector<Traced> all;
  for (std::size_t d = 0; d < devices.size(); ++d) {
    const auto frames = static_cast<double>(job.frames.size());
    all.push_back({devices[d], seconds[2 * d], times(seconds[2 * d + 1], frames)});
    compare_pixels(groups[2 * d], groups[0], all.back());
    compare_pixels(groups[2 * d + 1], groups[1], all.back());
  }
  return all;
}

std::string milliseconds_cell(double seconds) { return fmt::format("{:.2f}", 1e3 * seconds); }

std::string devices_table(const std::vector<Traced>& all, std::size_t frames) {
  Table table({"ms an iteration", fmt::format("{} frames together", frames), "one by one", "sharing",
               "together, times as fast as the CPU", "one by one, times as fast", "pixels that differ from the CPU's"});
  for (const Traced& t : all)
    table.row(
        {t.by.name, milliseconds_cell(medians(t.together).back()), milliseconds_cell(medians(t.one_by_one).back()),
         ratio_cell(ratios(t.one_by_one, t.together).back()), ratio_cell(ratios(all[0].together, t.together).back()),
         ratio_cell(ratios(all[0].one_by_one, t.one_by_one).back()), fmt::format("{} of {}", t.differ, t.pixels)});
  return table.text();
}

std::string steps_table(const std::vector<Traced>& all) {
  std::vector<std::string> head = {"ms an iteration"};
  for (const Traced& t : all) head.push_back(fmt::format("{}, together", t.by.name)), head.push_back("one by one");
  Table table(head);
  for (std::size_t s = 0; s < kStepNames.size(); ++s) {
    std::vector<std::string> cells = {kStepNames[s]};
    for (const Traced& t : all)
      for (const Rounds& rounds : {t.together, t.one_by_one}) cells.push_back(milliseconds_cell(medians(rounds)[s]));
    table.row(cells);
  }
  return table.text();
}

/// If the GPU fails, it is left out, and the others are measured nevertheless.
std::string compare_devices(const LoadedScene& loaded, const Job& job, std::vector<Tracing>& devices,
                            const TracingEffort& effort) {
  std::string failed;
  for (;;) {
    try {
      const std::vector<Traced> all = trace_in_turns(loaded, job, devices, effort);
      return failed + devices_table(all, job.frames.size()) + "\n" + steps_table(all);
    } catch (const MachineFailure& failure) {
      if (devices.back().device != Device::gpu) throw;
      failed = fmt::format("No figures of a GPU: {}.\n\n", failure.what());
      say("{}", failure.what());
      devices.pop_back();
    }
  }
}

/// By the GPU alone, all frames together.
std::string photons_table(const LoadedScene& loaded, const Job& job, const TracingEffort& effort) {
  std::vector<std::string> head = {"photons an iteration"};
  for (const char* step : kStepNames) head.push_back(fmt::format("{}, ms", step));
  Table table(head);
  for (const int photons : {300'000, 3'000'000, 30'000'000}) {
    say("GPU, {} photons", photons);
    std::vector<std::string> cells = {std::to_string(photons)};
    try {
      std::vector<Group> groups(1);
      groups[0].push_back(start(loaded, with_integer(on(job, Device::gpu), "photons", photons), "dsppm", job.frames));
      expect_gpu({kOnGpu});
      for (const double seconds : medians(in_turns(groups, 1 + effort.iterations / 2)[0]))
        cells.push_back(milliseconds_cell(seconds));
    } catch (const MachineFailure& failure) {
      cells.emplace_back(failure.what());
    }
    cells.resize(head.size());
    table.row(cells);
  }
  return table.text();
}

}  // namespace

Findings measure_device(const Setup& setup) {
  const LoadedScene loaded = load_sibenik_horse({"materials=false"});
  const TracingEffort effort = setup.quick ? TracingEffort{3, 2} : TracingEffort{6, 64};
  std::vector<Tracing> devices = {kOnCpu, kInWaves};
  const std::string no_gpu = why_no_gpu();
  if (no_gpu.empty()) devices.push_back(kOnGpu);
  std::string text = no_gpu.empty() ? fmt::format("The GPU: {}.\n", tracer_on(Device::gpu)->name())
                                    : fmt::format("No figures of a GPU: {}.\n", no_gpu);
  const Job job = with_text(with_text(loaded.job, "estimator", "kz11"), "indirect", "photons");
  for (const char* direct : {"photons", "both"}) {
    say("direct light: {}", direct);
    const Job lit = with_text(job, "direct", direct);
    text += fmt::format("\n`\"string direct\" \"{}\"`:\n\n", direct) + compare_devices(loaded, lit, devices, effort);
  }
  if (devices.back().device == Device::gpu)
    text += "\nMore photons, by the GPU, all frames together, `\"string direct\" \"photons\"`:\n\n" +
            photons_table(loaded, with_text(job, "direct", "photons"), effort);
  return {text, {}};
}

}  // namespace dspm
