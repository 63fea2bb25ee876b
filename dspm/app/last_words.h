// An exception that cannot be caught, as when a library's thread runs out of memory, still ends in a message.
#pragma once

namespace dspm {

/// From now on such an end is reported on standard error, leaves no temporary file, and has exit code 1.
void prepare_last_words();

}  // namespace dspm
