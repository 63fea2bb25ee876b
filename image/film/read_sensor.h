// The sensor of a film: what becomes of light of each wavelength in a spectral render.
#pragma once

#include "dspm/base/params/params.h"
#include "dspm/image/film/film.h"

namespace dspm {

/// Reads "sensor" and "sensorfile". Call it after reading "whitebalance", whose default depends on the sensor.
void read_sensor(ParamReader& reader, FilmSettings& film);

}  // namespace dspm
