#include <dspm/accel/brute_force.h>
#include <dspm/integrators/integrator.h>
#include <dspm/session/modules/module.h>

namespace dspm {

MakeMaterial make_dielectric;
MakeShape make_sphere;
MakeLight make_spot;
MakeCamera make_perspective;
MakeIntegrator make_dsppm;
template <class T>
TexturePtr<T> make_checkerboard(ParamReader& reader, const TextureContext& context);

}  // namespace dspm

DSPM_MODULE(registry) {
  using namespace dspm;
  registry.add(material_plugins(), {"moved", "dielectric", make_dielectric});
  registry.add(shape_plugins(), {"moved", "sphere", make_sphere});
  registry.add(texture_plugins<float>(), {"moved", "checkerboard", make_checkerboard<float>});
  registry.add(texture_plugins<Rgb>(), {"moved", "checkerboard", make_checkerboard<Rgb>});
  registry.add(light_plugins(), {"moved", "spot", make_spot});
  registry.add(camera_plugins(), {"moved", "perspective", make_perspective});
  registry.add(accel_plugins(), {{"moved", "bruteforce", make_brute_force}, brute_force_bytes});
  registry.add(integrator_plugins(), {{"moved", "dsppm", make_dsppm}});
}
