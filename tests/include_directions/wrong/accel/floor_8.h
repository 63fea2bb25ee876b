#pragma once

#include "dspm/accel/floor_7.h"
