// Built for another version, as its stamp says; its static constructor must not run.
#include <dspm/session/modules/module.h>

#include <cstdlib>
#include <fstream>

namespace {

constexpr dspm::ModuleStamp other_stamp() {
  dspm::ModuleStamp stamp = dspm::current_stamp();
  stamp.version[0] = 7;
  return stamp;
}

const struct Trace {
  Trace() {
    if (const char* const file = std::getenv("DSPM_TEST_TRACE")) std::ofstream(file) << "loaded\n";
  }
} trace;

}  // namespace

extern "C" {
__attribute__((section(".note.dspm"), used, aligned(4))) extern constexpr dspm::ModuleStamp dspm_module_stamp =
    other_stamp();
void dspm_module(dspm::ModuleRegistry&) {}
}
