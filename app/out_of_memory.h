// What is said where memory ends: who needed it, how much was taken, and what helps.
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "app/watch.h"

namespace dspm {

/// Of a step ("iteration 3"); in a catch clause.
std::string out_of_memory(const std::string& step);

/// Returns task(). Where it finds no memory, the error is a std::runtime_error that names the step which the watch
/// sees.
template <class Task>
auto naming_memory_step(const Watch& watch, const Task& task) {
  try {
    return task();
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(out_of_memory(watch.step()));
  } catch (const std::length_error&) {  // so much that no allocation is even tried
    throw std::runtime_error(out_of_memory(watch.step()));
  }
}

}  // namespace dspm
