// Textures out of parameters, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dspm/textures/plugins.h"

namespace dspm {

inline Param number_param(std::string name, float value) {
  return {ParamType::number, std::move(name), {}, std::vector<float>{value}, {}, {}};
}
inline Param integer_param(std::string name, int value) {
  return {ParamType::integer, std::move(name), {}, std::vector<int>{value}, {}, {}};
}
inline Param text_param(std::string name, std::string value) {
  return {ParamType::text, std::move(name), {}, std::vector<std::string>{std::move(value)}, {}, {}};
}
inline Param flag_param(std::string name, bool value) {
  return {ParamType::boolean, std::move(name), {}, std::vector<bool>{value}, {}, {}};
}
inline Param texture_param(std::string name, std::string value) {
  return {ParamType::texture, std::move(name), {}, std::vector<std::string>{std::move(value)}, {}, {}};
}
inline Param triple_param(ParamType type, std::string name, float x, float y, float z) {
  return {type, std::move(name), {}, std::vector<float>{x, y, z}, {}, {}};
}

/// A scene's textures in the making.
struct Workshop {
  explicit Workshop(bool lenient = false) : diagnostics(lenient) {}

  template <class T>
  TexturePtr<T> make(const std::string& type, std::vector<Param> params, const Transform& placement = {}) {
    const ParamList list{std::move(params)};
    ParamReader reader(list, "texture \"" + type + "\"", {}, diagnostics);
    return make_texture<T>(type, reader, {textures, placement, images});
  }
  std::string message() const { return diagnostics.all().empty() ? "" : diagnostics.all().front().message; }

  TextureSet textures;
  ImageCache images;
  Diagnostics diagnostics;
};

inline TexturePoint at_uv(float u, float v) { return {{}, {u, v}}; }
inline TexturePoint at_point(float x, float y, float z) { return {{x, y, z}, {}}; }

}  // namespace dspm
