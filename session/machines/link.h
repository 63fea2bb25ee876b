// A link carries letters between machines; only one thread uses it. Optional libraries implement it in a module that
// the program loads if it was started by their tools: see mpi/mpi_link.cpp.
#pragma once

#include <optional>
#include <string>

#include "dspm/session/machines/letter.h"

namespace dspm {

class Link {
 public:
  virtual ~Link() = default;
  /// The number of machines; they count from 0, which leads.
  virtual int machines() const = 0;
  virtual int me() const = 0;
  /// Begins to send; the letter is on its way until is_quiet().
  virtual void send(Letter letter) = 0;
  /// Returns whether nothing is on its way from here, nor half received.
  virtual bool is_quiet() = 0;
  /// Returns a letter that has come, or nullopt.
  virtual std::optional<Letter> receive() = 0;
  /// Called if some machine does not answer: the end of this link then waits for none of them, and ends all of them.
  virtual void abandon() = 0;
};

}  // namespace dspm
