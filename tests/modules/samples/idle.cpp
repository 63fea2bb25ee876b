// Adds nothing.
#include "modules/module.h"

DSPM_MODULE(registry) {}
