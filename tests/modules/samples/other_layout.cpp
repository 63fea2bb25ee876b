// Of the same version, but with another idea of a type's size.
#include <dspm/session/modules/module.h>

namespace {

constexpr dspm::ModuleStamp other_stamp() {
  dspm::ModuleStamp stamp = dspm::current_stamp();
  stamp.sizes[6] += 8;
  return stamp;
}

}  // namespace

extern "C" {
__attribute__((section(".note.dspm"), used, aligned(4))) extern constexpr dspm::ModuleStamp dspm_module_stamp =
    other_stamp();
void dspm_module(dspm::ModuleRegistry&) {}
}
