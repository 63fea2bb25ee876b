#pragma once

#include "dspm/accel/floor_1.h"
