// An NVIDIA card as a machine for waves, see machine.h. For nvcc.
#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include <cub/device/device_radix_sort.cuh>

#include "dspm/integrators/waves/machine.h"

namespace dspm {

template <class Fn>
__global__ void call_for_each(std::size_t count, Fn fn) {
  const std::size_t i = static_cast<std::size_t>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (i < count) fn(i);
}

struct Itself {
  std::uint32_t* numbers;
  __device__ void operator()(std::size_t i) const { numbers[i] = static_cast<std::uint32_t>(i); }
};

class CudaMachine {
 public:
  static constexpr bool kOwnMemory = true;

  /// Takes the first card.
  CudaMachine() {
    // Textures lie in one another, so the compiler does not know how deep calls go (PlainTexture::kMaxDepth).
    constexpr std::size_t kStack = 32768;
    expect(cudaDeviceSetLimit(cudaLimitStackSize, kStack));
    cudaDeviceProp card;
    expect(cudaGetDeviceProperties(&card, 0));
    name_ = card.name;
  }
  ~CudaMachine() { cudaFree(scratch_); }
  CudaMachine(const CudaMachine&) = delete;
  CudaMachine& operator=(const CudaMachine&) = delete;

  void* allocate(std::size_t bytes) {
    void* memory = nullptr;
    expect(cudaMalloc(&memory, bytes));
    return memory;
  }
  void free(void* memory) { cudaFree(memory); }
  void copy_in(void* to, const void* from, std::size_t bytes) {
    expect(cudaMemcpy(to, from, bytes, cudaMemcpyHostToDevice));
  }
  void copy_out(void* to, const void* from, std::size_t bytes) {
    expect(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost));
  }
  void copy(void* to, const void* from, std::size_t bytes) {
    expect(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToDevice));
  }
  void clear(void* to, std::size_t bytes) { expect(cudaMemset(to, 0, bytes)); }

  template <class Fn>
  void for_each(std::size_t count, const Fn& fn) {
    constexpr unsigned kBlock = 128;
    if (count == 0) return;
    call_for_each<<<static_cast<unsigned>((count + kBlock - 1) / kBlock), kBlock>>>(count, fn);
    expect(cudaGetLastError());
  }

  void sort(std::uint64_t* keys, std::uint32_t* order, std::size_t count) {
    Part<std::uint64_t> sorted;
    Part<std::uint32_t> numbers;
    std::size_t bytes = 0;
    const auto sort_pairs = [&](void* scratch) {
      expect(cub::DeviceRadixSort::SortPairs(scratch, bytes, keys, sorted.of(scratch), numbers.of(scratch), order, count));
    };
    sort_pairs(nullptr);
    const std::size_t needed = sorted.place_after(bytes, count), all = numbers.place_after(needed, count);
    reserve_scratch(all);
    for_each(count, Itself{numbers.of(scratch_)});
    sort_pairs(scratch_);
    copy(keys, sorted.of(scratch_), count * sizeof(*keys));
  }

  std::size_t paths_at_once() const { return std::size_t{1} << 20; }
  std::string name() const { return name_; }

 private:
  /// An array within the scratch memory.
  template <class T>
  struct Part {
    std::size_t begin = 0;
    T* of(void* scratch) const { return reinterpret_cast<T*>(static_cast<char*>(scratch) + begin); }
    /// Returns where it ends.
    std::size_t place_after(std::size_t end, std::size_t count) {
      begin = (end + 255) / 256 * 256;
      return begin + count * sizeof(T);
    }
  };

  void reserve_scratch(std::size_t bytes) {
    if (bytes <= scratch_bytes_) return;
    cudaFree(scratch_);
    scratch_ = nullptr, scratch_bytes_ = 0;
    scratch_ = allocate(bytes), scratch_bytes_ = bytes;
  }

  static void expect(cudaError_t result) {
    if (result == cudaSuccess) return;
    cudaGetLastError();  // forgets it
    const std::string said = cudaGetErrorString(result);
    if (result == cudaErrorMemoryAllocation) throw OutOfMachineMemory("the GPU's memory does not suffice");
    throw MachineFailure("the GPU failed: " + said);
  }

  std::string name_;
  void* scratch_ = nullptr;
  std::size_t scratch_bytes_ = 0;
};

}  // namespace dspm
