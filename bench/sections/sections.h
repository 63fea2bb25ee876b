// The functions behind the sections' table in sections.cpp, each in the file of its name.
#pragma once

#include "bench/sections/section.h"

namespace dspm {

Findings measure_machine(const Setup& setup);
Findings measure_horse(const Setup& setup);
Findings measure_sibenik(const Setup& setup);
Findings measure_turns(const Setup& setup);
Findings measure_scenes(const Setup& setup);
Findings measure_figure9(const Setup& setup);
Findings measure_looks(const Setup& setup);
Findings measure_own(const Setup& setup);
Findings measure_fabrics(const Setup& setup);
Findings measure_lamp(const Setup& setup);
Findings measure_memory(const Setup& setup);
Findings measure_frames(const Setup& setup);
Findings measure_threads(const Setup& setup);
Findings measure_device(const Setup& setup);
Findings measure_error(const Setup& setup);
Findings measure_light(const Setup& setup);
Findings measure_seen(const Setup& setup);
Findings measure_open(const Setup& setup);
Findings measure_table(const Setup& setup);
Findings measure_queries(const Setup& setup);
Findings measure_rays(const Setup& setup);
Findings measure_sppm(const Setup& setup);
Findings measure_reading(const Setup& setup);
Findings measure_denoise(const Setup& setup);
Findings measure_white(const Setup& setup);
Findings measure_dispersion(const Setup& setup);
Findings measure_colours(const Setup& setup);

}  // namespace dspm
