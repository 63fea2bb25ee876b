// Claims a name of dspm's own.
#include <dspm/session/modules/module.h>

DSPM_MODULE(registry) {
  using namespace dspm;
  registry.add(material_plugins(), {"diffuse", "a better one", material_plugins().find("diffuse")->make});
}
