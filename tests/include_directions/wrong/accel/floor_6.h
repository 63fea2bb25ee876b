#pragma once

#include "dspm/accel/floor_5.h"
