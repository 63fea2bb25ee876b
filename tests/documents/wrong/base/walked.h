// A file of the walk, with a header that is not in it.
#include "dspm/base/params/not_counted.h"
#include "dspm/base/two.h"
