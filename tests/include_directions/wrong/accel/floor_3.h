#pragma once

#include "dspm/accel/floor_2.h"
