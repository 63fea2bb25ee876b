// The bodies and the medium that a point or a segment of a path lies in.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <span>

namespace dspm {

inline constexpr int kNoBody = -1, kNoMedium = -1;

/// A list of bodies, by their materials, in the order in which a path has entered them, and one medium. It is a value. A
/// path that enters too many bodies forgets the outermost, and learns of it again when it arrives at its surface from
/// within.
class Inside {
 public:
  static constexpr int kMost = 6;

  int medium = kNoMedium;  // into Scene::media

  /// Returns whether it lies in no body.
  constexpr bool is_empty() const { return count_ == 0; }
  constexpr std::span<const int> bodies() const { return {bodies_.data(), static_cast<std::size_t>(count_)}; }
  constexpr bool contains(int body) const { return std::find(begin(), end(), body) != end(); }

  constexpr void enter(int body) {
    leave(body);
    if (count_ == kMost) leave(bodies_[0]);
    bodies_[static_cast<std::size_t>(count_++)] = body;
  }
  constexpr void leave(int body) {
    leave_if([&](int each) { return each == body; });
  }
  template <class Predicate>
  constexpr void leave_if(Predicate&& predicate) {
    count_ = static_cast<int>(std::remove_if(begin(), end(), predicate) - begin());
  }

  friend constexpr bool operator==(const Inside& a, const Inside& b) {
    return a.medium == b.medium && std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  friend auto operator<=>(const Inside& a, const Inside& b) {
    if (const auto order = a.medium <=> b.medium; order != 0) return order;
    return std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  constexpr int* begin() { return bodies_.data(); }
  constexpr int* end() { return bodies_.data() + count_; }
  constexpr const int* begin() const { return bodies_.data(); }
  constexpr const int* end() const { return bodies_.data() + count_; }

  std::array<int, kMost> bodies_{};
  int count_ = 0;
};

}  // namespace dspm
