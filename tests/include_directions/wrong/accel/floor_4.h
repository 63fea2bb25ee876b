#pragma once

#include "dspm/accel/floor_3.h"
