// Stands before the C++ library's own __cxa_throw, which every `throw` calls: an exception does not know where it came
// from, so that is noted first.
#include <dlfcn.h>

#include <cstdlib>

#include "dspm/modules/blame.h"

extern "C" {
// By another name, as compilers have a declaration of their own.
[[noreturn]] void dspm_note_and_throw(void* object, void* type, void (*destroy)(void*)) __asm__("__cxa_throw");

void dspm_note_and_throw(void* object, void* type, void (*destroy)(void*)) {
  dspm::note_throw(object);
  using Throw = void(void*, void*, void (*)(void*));
  static auto* const real = reinterpret_cast<Throw*>(dlsym(RTLD_NEXT, "__cxa_throw"));
  real(object, type, destroy);
  std::abort();
}
}
