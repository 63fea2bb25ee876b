// An exception that nobody can catch, as where a thread of a library finds no memory, still ends in a message.
#pragma once

namespace dspm {

/// From now on such an end is told on standard error, leaves no temporary file, and has exit code 1.
void prepare_last_words();

}  // namespace dspm
