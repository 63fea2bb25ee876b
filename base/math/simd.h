// The functions of SSE, up to SSE4.1: the compiler's own on x86-64, those of SIMDe on other processors, with the same bits.
#pragma once

#if defined(__x86_64__)
#include <smmintrin.h>
#else
#define SIMDE_ENABLE_NATIVE_ALIASES
#include <simde/x86/sse4.1.h>
#endif
