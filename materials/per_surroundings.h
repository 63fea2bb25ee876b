// Keeps what a boundary needs for each index of refraction around it.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <utility>

namespace dspm {

/// Keeps what make(outside_eta) returns, made once for each index (see SurfacePoint::outside_eta), for many threads.
/// Indices are few: those of the bodies that a body lies in, and 1, which is made at once.
template <class T>
class PerSurroundings {
 public:
  explicit PerSurroundings(std::function<T(float outside_eta)> make)
      : make_(std::move(make)), usual_{1, make_(1), nullptr} {}
  PerSurroundings(const PerSurroundings&) = delete;
  PerSurroundings& operator=(const PerSurroundings&) = delete;
  ~PerSurroundings() {
    for (const Made* made = others_; made != nullptr;) delete std::exchange(made, made->next);
  }

  const T& of(float outside_eta) const {
    if (outside_eta == 1) return usual_.object;
    if (const Made* made = find(outside_eta)) return made->object;
    const std::lock_guard lock(mutex_);
    if (const Made* made = find(outside_eta)) return made->object;
    others_ = new Made{outside_eta, make_(outside_eta), others_};
    return others_.load()->object;
  }

 private:
  struct Made {
    float outside_eta;
    T object;
    const Made* next;
  };

  const Made* find(float outside_eta) const {
    const Made* made = others_;
    while (made != nullptr && made->outside_eta != outside_eta) made = made->next;
    return made;
  }

  std::function<T(float)> make_;
  Made usual_;
  mutable std::mutex mutex_;
  mutable std::atomic<const Made*> others_ = nullptr;
};

}  // namespace dspm
