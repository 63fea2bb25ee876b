// Lets a listener hear what is printed to standard error, and prints pictures among it.
#pragma once

#include <functional>
#include <string_view>

namespace dspm {

/// Sets who is called with every message before it is printed, in the thread that prints it; an empty function means
/// nobody.
void listen_to_messages(std::function<void(std::string_view)> listener);
/// Prints to standard error like print_message, but the listener does not hear it.
void print_picture(std::string_view text);

}  // namespace dspm
