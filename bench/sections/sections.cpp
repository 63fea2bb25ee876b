#include "bench/sections/sections.h"

#include <fmt/format.h>

#include "bench/report/machine.h"

namespace dspm {

Findings measure_machine(const Setup&) { return {machine_and_build_in_words() + ".\n", {}}; }

std::string plot_link(const std::string& name, const std::string& sentence) {
  return fmt::format("![{}](plots/{}.svg)\n", sentence, name);
}

std::span<const Section> sections() {
  static constexpr Section kSections[] = {
      {"machine", "the machine of the measurements", measure_machine},
      {"horse", "WG12 table 1: the speedup over the number of frames", measure_horse},
      {"sibenik", "the same with the paper's own models, if they are there", measure_sibenik},
      {"scenes", "WG12 table 3: disco, water and material", measure_scenes},
      {"figure9", "WG12 figure 9: the speedup over the shares of dynamic photons and hit points", measure_figure9},
      {"looks", "variations of a product against one of them, and their noise", measure_looks},
      {"own", "the error of frames among others and in files of their own", measure_own},
      {"fabrics", "time and memory of up to 500 fabrics", measure_fabrics},
      {"lamp", "a lamp that dims, a camera that moves", measure_lamp},
      {"memory", "WG12 table 2: peak memory over the number of frames", measure_memory},
      {"frames", "time and memory of up to 256 frames", measure_frames},
      {"threads", "from one thread to all", measure_threads},
      {"error", "time to equal error of the integrators and estimators", measure_error},
      {"light", "scenes whose light hardly reaches what the camera sees", measure_light},
      {"seen", "after equal time, apart: what path finds, and what it does not", measure_seen},
      {"open", "a sun and a sky over a wide ground: what is found, and when its caustic is there", measure_open},
      {"table", "every integrator on scenes of every kind", measure_table},
      {"queries", "partition queries against other ways to the same answer", measure_queries},
      {"rays", "the same rays in dspm's trees and in Embree", measure_rays},
      {"sppm", "one frame, against other renderers", measure_sppm},
      {"reading", "scenes' text and meshes in bytes per second", measure_reading},
      {"denoise", "error and flicker after 16 iterations, with --denoise and without", measure_denoise},
      {"white", "what white principled materials give back in a white furnace", measure_white},
      {"dispersion", "prisms: frames together against one by one, and how far from white", measure_dispersion},
      {"colours", "spectral renders against RGB: cost, noise, and how soon colours are right", measure_colours},
      {"device", "the CPU, the CPU in waves and a GPU: frames together and one by one", measure_device},
  };
  return kSections;
}

std::span<const Section> scene_sections() {
  static constexpr Section kSections[] = {
      {"turns", "dsppm on all frames against sppm on each", measure_turns},
      {"looks", "all frames against one of them, and their noise", measure_looks},
      {"threads", "from one thread to all", measure_threads},
      {"error", "time to equal error of the integrators and estimators", measure_error},
      {"seen", "after equal time, apart: what path finds, and what it does not", measure_seen},
  };
  return kSections;
}

}  // namespace dspm
