// Adds nothing.
#include <dspm/session/modules/module.h>

DSPM_MODULE(registry) {}
