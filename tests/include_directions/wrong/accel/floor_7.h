#pragma once

#include "dspm/accel/floor_6.h"
