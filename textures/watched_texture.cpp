#include "dspm/textures/watched_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>

#include "dspm/base/colour/rgb.h"

namespace dspm {
namespace {

bool is_sound(float value) { return std::isfinite(value); }
template <Components C>
bool is_sound(const C& c) {
  return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && is_finite(c);
}

/// Collects faults, from whichever thread looks a texture up.
class Faults {
 public:
  void add(const TextureFault& fault) {
    const std::lock_guard lock(mutex_);
    if (std::find(all_.begin(), all_.end(), fault) == all_.end()) all_.push_back(fault);
  }
  std::vector<TextureFault> take() {
    const std::lock_guard lock(mutex_);
    std::vector<TextureFault> rest(all_.begin() + static_cast<std::ptrdiff_t>(taken_), all_.end());
    taken_ = all_.size();
    return rest;
  }

 private:
  std::mutex mutex_;
  std::vector<TextureFault> all_;
  std::size_t taken_ = 0;
};

Faults& faults() {
  static Faults all;
  return all;
}

template <class T>
class WatchedTexture final : public Texture<T> {
 public:
  WatchedTexture(TexturePtr<T> texture, TextureFault fault) : texture_(std::move(texture)), fault_(std::move(fault)) {}

  T evaluate(const TexturePoint& at) const override { return checked(texture_->evaluate(at)); }
  Carried<T> carried(const TexturePoint& at) const override { return checked(texture_->carried(at)); }
  std::optional<T> constant() const override {
    const std::optional<T> value = texture_->constant();
    return value ? std::optional(checked(*value)) : std::nullopt;
  }
  bool averages() const override { return texture_->averages(); }

 private:
  template <class V>
  V checked(const V& value) const {
    if (is_sound(value)) return value;
    if (!is_known_.exchange(true, std::memory_order_relaxed)) faults().add(fault_);
    return V(0);
  }

  TexturePtr<T> texture_;
  TextureFault fault_;
  mutable std::atomic<bool> is_known_ = false;
};

}  // namespace

template <class T>
TexturePtr<T> watched(TexturePtr<T> texture, const SourceLocation& where, std::string_view type) {
  if (texture == nullptr) return texture;
  std::string place = where.file != nullptr ? fmt::format("{}:{}: ", where.file->name, where.line) : "";
  return std::make_shared<WatchedTexture<T>>(std::move(texture), TextureFault{std::move(place), std::string(type)});
}

std::vector<TextureFault> take_texture_faults() { return faults().take(); }

template TexturePtr<float> watched<float>(TexturePtr<float>, const SourceLocation&, std::string_view);
template TexturePtr<Rgb> watched<Rgb>(TexturePtr<Rgb>, const SourceLocation&, std::string_view);

}  // namespace dspm
