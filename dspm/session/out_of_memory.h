// What is said where memory ends: who needed it, how much was taken, and what helps.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace dspm {

/// No allocation succeeded, or so much was asked for that none was tried.
bool is_out_of_memory(const std::exception& error);

/// Of a step ("iteration 3"); in a catch clause.
std::string out_of_memory(const std::string& step);

/// Returns task(). If it finds no memory, the error is a std::runtime_error that names step().
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
