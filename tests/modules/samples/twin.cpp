// Claims a name that mischief.cpp has, too.
#include <dspm/session/modules/module.h>

DSPM_MODULE(registry) {
  using namespace dspm;
  const IntegratorPlugin* const path = integrator_plugins().find("path");
  registry.add(integrator_plugins(), {{"mischief", "another one", path->make}});
}
