// Standard output, which is for data, and standard error, which is for messages.
#pragma once

#include <string_view>

namespace dspm {

/// First of all: streams that are closed stay unusable, whatever file is opened next; a reader that goes away and a
/// limit on the size of files are errors of writing, where they would end the program.
void prepare_standard_streams();

/// To standard output. Throws WriteError where not all of it can be written.
void print_data(std::string_view text);
/// To standard error. What cannot be shown ends nothing: a render is worth more than its messages.
void print_message(std::string_view text);

}  // namespace dspm
