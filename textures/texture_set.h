// A scene's textures by name. Textures of numbers and textures of colours have separate names, as in pbrt.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/errors.h"
#include "dspm/base/params/params.h"
#include "dspm/textures/texture.h"

namespace dspm {

class TextureSet {
 public:
  /// Replaces a texture of the same name and kind; its holders keep it.
  template <class T>
  void add(std::string name, TexturePtr<T> texture) {
    textures<T>()[std::move(name)] = std::move(texture);
  }

  /// Returns null if no texture has that name.
  template <class T>
  TexturePtr<T> find(std::string_view name) const {
    const auto found = textures<T>().find(name);
    return found == textures<T>().end() ? nullptr : found->second;
  }

  template <class T>
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& [name, texture] : textures<T>()) names.push_back(name);
    return names;
  }

 private:
  template <class T>
  using ByName = std::map<std::string, TexturePtr<T>, std::less<>>;

  template <class T>
  const ByName<T>& textures() const {
    return std::get<ByName<T>>(kinds_);
  }
  template <class T>
  ByName<T>& textures() {
    return std::get<ByName<T>>(kinds_);
  }

  std::tuple<ByName<float>, ByName<Rgb>> kinds_;
};

/// Returns the texture that a parameter names, else one of its constant value; T is float or Rgb. An unknown name is an
/// error at its location; the constant then takes its place, so that the result is never null.
template <class T>
TexturePtr<T> texture_of(const ValueOrTexture<T>& parameter, const TextureSet& textures, Diagnostics& diagnostics);

}  // namespace dspm
