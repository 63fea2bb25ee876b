// Standard output, which is for data, and standard error, which is for messages.
#pragma once

#include <string_view>

namespace dspm {

/// Call this first. Closed streams stay unusable, whatever file is opened next; a vanished reader or a limit on file
/// sizes becomes a write error instead of ending the program.
void prepare_standard_streams();

/// Prints to standard output. Throws WriteError if not all of it can be written.
void print_data(std::string_view text);
/// Prints to standard error. Failures are ignored: a render is worth more than its messages.
void print_message(std::string_view text);

}  // namespace dspm
