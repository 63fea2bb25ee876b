// Embree's interface, of the version that CMake found.
#pragma once

#if DSPM_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
