// What waves need of a machine, such as the CPU's threads (threads_machine.h) or a card, and its arrays. A machine is a class
// with
//   static constexpr bool kOwnMemory                 the host cannot read its memory, nor it the host's
//   void* allocate(std::size_t bytes)                aligned to 256 bytes
//   void free(void*)
//   void copy_in(void* to, const void* from, std::size_t bytes)    from the host
//   void copy_out(void* to, const void* from, std::size_t bytes)   to the host
//   void copy(void* to, const void* from, std::size_t bytes)       within its memory
//   void clear(void* to, std::size_t bytes)          to zeros
//   void for_each(std::size_t count, fn)             calls fn(i) for all numbers below, in any order
//   void sort(std::uint64_t* keys, std::uint32_t* order, std::size_t count)
//                                                    sorts the keys; order[i] is where the i-th was; no two are equal
//   std::size_t paths_at_once() const                as many as keep it busy
//   std::string name() const
// All but free() and name() may throw MachineFailure; allocate() throws OutOfMachineMemory if there is no room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>

namespace dspm {

/// The machine does not work any more.
class MachineFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
/// The machine has no room for something.
class OutOfMachineMemory : public MachineFailure {
 public:
  using MachineFailure::MachineFailure;
};

/// So many consecutive calls of a for_each() share a place for sums. On the CPU one thread does them all.
inline constexpr std::size_t kSharers = 1024;

/// An array in a machine's memory that only grows.
template <class T, class Machine>
class MachineArray {
 public:
  explicit MachineArray(Machine& machine) : machine_(&machine) {}
  ~MachineArray() { machine_->free(data_); }
  MachineArray(const MachineArray&) = delete;
  MachineArray& operator=(const MachineArray&) = delete;

  T* data() { return data_; }
  std::size_t room() const { return room_; }

  /// Makes room for `count` elements, and keeps the first `kept`.
  void reserve(std::size_t count, std::size_t kept = 0) {
    if (count <= room_) return;
    if (kept == 0) machine_->free(std::exchange(data_, nullptr)), room_ = 0;
    T* const larger = static_cast<T*>(machine_->allocate(count * sizeof(T)));
    if (kept > 0) machine_->copy(larger, data_, kept * sizeof(T));
    machine_->free(std::exchange(data_, larger));
    room_ = count;
  }
  void copy_in(std::span<const T> from) {
    reserve(from.size());
    if (!from.empty()) machine_->copy_in(data_, from.data(), from.size_bytes());
  }
  void copy_out(std::span<T> to) {
    if (!to.empty()) machine_->copy_out(to.data(), data_, to.size_bytes());
  }
  /// Gives the memory back.
  void release() { machine_->free(std::exchange(data_, nullptr)), room_ = 0; }
  void swap(MachineArray& other) { std::swap(data_, other.data_), std::swap(room_, other.room_); }

 private:
  Machine* machine_;
  T* data_ = nullptr;
  std::size_t room_ = 0;
};

}  // namespace dspm
