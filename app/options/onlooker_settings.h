// The settings that say who is to watch a render.
#pragma once

#include <string>

namespace dspm {

struct OnlookerSettings {
  std::string display_server;  // host:port; empty: none
  bool preview = false;        // in the terminal
};

}  // namespace dspm
