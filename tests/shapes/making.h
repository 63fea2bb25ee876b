// Shapes made by their plugins from parameters, as a scene would.
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>

#include "dspm/shapes/shape.h"

namespace dspm::test {

inline Param param(ParamType type, std::string name, Param::Values values) {
  Param p;
  p.type = type;
  p.name = std::move(name);
  p.values = std::move(values);
  return p;
}

/// What a Shape directive makes; what is wrong goes to `diagnostics`.
inline std::vector<MadeShape> make_shapes(std::string_view plugin, ParamList list, Diagnostics& diagnostics) {
  const auto* found = shape_plugins().find(plugin, {}, diagnostics);
  if (!found) return {};
  ParamReader reader(list, "shape \"" + std::string(plugin) + "\"", {}, diagnostics);
  std::vector<MadeShape> made = found->make(reader);
  for (MadeShape& each : made) each.shape->settle();
  return made;
}

/// The one shape that takes numbers only; throws where something is wrong.
inline std::unique_ptr<Shape> make_shape(std::string_view plugin,
                                         std::initializer_list<std::pair<const char*, float>> numbers) {
  ParamList list;
  for (const auto& [name, value] : numbers)
    list.params.push_back(param(ParamType::number, name, std::vector<float>{value}));
  Diagnostics diagnostics;
  std::vector<MadeShape> made = make_shapes(plugin, std::move(list), diagnostics);
  diagnostics.throw_if_errors();
  return std::move(made.at(0).shape);
}

/// All messages, a line each.
inline std::string messages(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) text += d.message + "\n";
  return text;
}

}  // namespace dspm::test
