#pragma once

#include "dspm/accel/floor_4.h"
