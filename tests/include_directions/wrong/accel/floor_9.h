#pragma once

#include "dspm/accel/floor_8.h"
