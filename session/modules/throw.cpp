// Takes the place of the C++ library's __cxa_throw, which every `throw` calls: exceptions do not know where they come
// from, so the thrower is recorded first.
#include <dlfcn.h>

#include <cstdlib>

#include "dspm/session/modules/blame.h"

extern "C" {
// Under another name, because compilers declare __cxa_throw themselves.
[[noreturn]] void dspm_note_and_throw(void* object, void* type, void (*destroy)(void*)) __asm__("__cxa_throw");

void dspm_note_and_throw(void* object, void* type, void (*destroy)(void*)) {
  dspm::note_throw(object);
  using Throw = void(void*, void*, void (*)(void*));
  static auto* const real = reinterpret_cast<Throw*>(dlsym(RTLD_NEXT, "__cxa_throw"));
  real(object, type, destroy);
  std::abort();
}
}
