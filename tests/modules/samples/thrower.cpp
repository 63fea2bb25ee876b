// Fails while it registers.
#include <dspm/session/modules/module.h>

DSPM_MODULE(registry) { throw std::runtime_error("no licence for dspm " + std::string(registry.host_version())); }
