// The words of a GPU's SDK that clang does without; a .cu file includes this first.
#pragma once

#ifdef __clang__
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
#endif
#include <cstdlib>  // before clang's wrapper of <new>
