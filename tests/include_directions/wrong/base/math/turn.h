// Both include one another.
#pragma once

#include "dspm/base/math/turn_back.h"
