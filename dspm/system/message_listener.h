// Who hears what is printed to standard error, and pictures among it.
#pragma once

#include <functional>
#include <string_view>

namespace dspm {

/// Called with every message before it is printed, in the thread that prints it; empty: none.
void listen_to_messages(std::function<void(std::string_view)> listener);
/// To standard error, like print_message, but not heard.
void print_picture(std::string_view text);

}  // namespace dspm
