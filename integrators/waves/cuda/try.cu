// Compiles if nvcc and the host's compiler suit one another and know C++20.
#include <span>

#include <cub/device/device_radix_sort.cuh>

__global__ void first(const int* from, int* to) { *to = std::span(from, 1)[0]; }
