// Adds nothing.
#include <dspm/modules/module.h>

DSPM_MODULE(registry) {}
