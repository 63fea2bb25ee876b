// Patterns for names: * stands for any characters, ? for one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dspm {

class Glob {
 public:
  explicit Glob(std::string pattern) : pattern_(std::move(pattern)) {}

  /// The places in the pattern that the characters so far may lead to.
  using State = std::vector<bool>;
  State start() const { return at(0); }
  State at(std::size_t place) const;
  State after(const State& state, std::string_view text) const;
  bool accepts(const State& state) const { return state.back(); }

  std::size_t places() const { return pattern_.size() + 1; }
  bool matches(std::string_view text) const { return accepts(after(start(), text)); }
  const std::string& pattern() const { return pattern_; }

 private:
  /// Adds the places that are reached without a character: a * may stand for none.
  void skip_stars(State& state) const;

  std::string pattern_;
};

}  // namespace dspm
