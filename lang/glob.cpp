#include "dspm/lang/glob.h"

namespace dspm {

void Glob::skip_stars(State& state) const {
  for (std::size_t i = 0; i < pattern_.size(); ++i)
    if (state[i] && pattern_[i] == '*') state[i + 1] = true;
}

Glob::State Glob::at(std::size_t place) const {
  State state(places(), false);
  state[place] = true;
  skip_stars(state);
  return state;
}

Glob::State Glob::after(const State& state, std::string_view text) const {
  State now = state;
  for (const char c : text) {
    State next(places(), false);
    for (std::size_t i = 0; i < pattern_.size(); ++i) {
      if (!now[i]) continue;
      if (pattern_[i] == '*') next[i] = true;
      if (pattern_[i] == c || pattern_[i] == '?') next[i + 1] = true;
    }
    skip_stars(next);
    now = std::move(next);
  }
  return now;
}

}  // namespace dspm
