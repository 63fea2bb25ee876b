// Parameters as a scene would give them, and objects of a plugin table made from them, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"

namespace dspm::test {

inline Param number(std::string name, float value) {
  return {ParamType::number, std::move(name), {}, std::vector<float>{value}, {}, {}};
}
inline Param numbers(std::string name, std::vector<float> values) {
  return {ParamType::number, std::move(name), {}, std::move(values), {}, {}};
}
inline Param rgb(std::string name, const Rgb& c) {
  return {ParamType::rgb, std::move(name), {}, std::vector<float>{c.r, c.g, c.b}, {}, {}};
}
inline Param point(std::string name, const Vec3& p) {
  return {ParamType::point3, std::move(name), {}, std::vector<float>{p.x, p.y, p.z}, {}, {}};
}
inline Param text(std::string name, std::string value) {
  return {ParamType::text, std::move(name), {}, std::vector<std::string>{std::move(value)}, {}, {}};
}
inline Param flag(std::string name, bool value) {
  return {ParamType::boolean, std::move(name), {}, std::vector<bool>{value}, {}, {}};
}

/// What a plugin makes of parameters; `diagnostics` gets its errors.
template <class Make, class Context>
auto make(const PluginTable<Plugin<Make>>& plugins, const std::string& name, std::vector<Param> params,
          const Context& context, Diagnostics& diagnostics) {
  const Plugin<Make>* plugin = plugins.find(name, {}, diagnostics);
  const ParamList list{std::move(params)};
  ParamReader reader(list, "plugin \"" + name + "\"", {}, diagnostics);
  return plugin->make(reader, context);
}

/// The same, where errors fail the test.
template <class Make, class Context>
auto make(const PluginTable<Plugin<Make>>& plugins, const std::string& name, std::vector<Param> params,
          const Context& context) {
  Diagnostics diagnostics;
  auto made = make(plugins, name, std::move(params), context, diagnostics);
  for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << to_string(d);
  return made;
}

/// The messages of the errors that parameters make.
template <class Make, class Context>
std::string errors_of(const PluginTable<Plugin<Make>>& plugins, const std::string& name, std::vector<Param> params,
                      const Context& context) {
  Diagnostics diagnostics;
  const auto made = make(plugins, name, std::move(params), context, diagnostics);
  EXPECT_TRUE(made);
  std::string messages;
  for (const Diagnostic& d : diagnostics.all()) messages += d.message + "\n";
  return messages;
}

}  // namespace dspm::test
