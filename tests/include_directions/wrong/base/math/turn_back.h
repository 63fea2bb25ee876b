#pragma once

#include "dspm/base/math/turn.h"
