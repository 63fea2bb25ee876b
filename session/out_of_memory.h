// The message when memory runs out: who needed it, how much was taken, and what helps.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace dspm {

/// Returns whether an allocation failed, or was for so much that it was not even tried.
bool is_out_of_memory(const std::exception& error);

/// Returns the message for a step ("iteration 3"); call it in a catch clause.
std::string out_of_memory(const std::string& step);

/// Returns task(). If it runs out of memory, throws a std::runtime_error that names step().
template <class Step, class Task>
auto naming_memory_step(const Step& step, const Task& task) {
  try {
    return task();
  } catch (const std::exception& error) {
    if (!is_out_of_memory(error)) throw;
    throw std::runtime_error(out_of_memory(step()));
  }
}

}  // namespace dspm
