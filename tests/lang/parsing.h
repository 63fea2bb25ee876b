// Scenes from text, and what was said about them.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "dspm/lang/parse.h"

namespace dspm::test {

struct Parsed {
  SceneDescription scene;
  Diagnostics diagnostics;

  std::string messages() const {
    std::string text;
    for (const Diagnostic& each : diagnostics.all()) text += to_string(each);
    return text;
  }
};

inline Parsed parse(const std::string& text, const Defines& defines = {}, const std::string& name = "scene.dsc",
                    bool lenient = false) {
  Parsed parsed{{}, Diagnostics(lenient)};
  parsed.scene = parse_text(name, text, {defines}, parsed.diagnostics);
  return parsed;
}

/// A scene without anything to complain about.
inline SceneDescription good(const std::string& text, const Defines& defines = {}) {
  Parsed parsed = parse(text, defines);
  EXPECT_EQ(parsed.messages(), "") << text;
  return std::move(parsed.scene);
}

inline const std::vector<float>& floats(const ParamList& params, const std::string& name) {
  const Param* param = params.find(name);
  if (param == nullptr) throw std::runtime_error("no parameter " + name);
  return std::get<std::vector<float>>(param->values);
}

inline void expect_near(const Matrix4& a, const Matrix4& b, double tolerance = 1e-12) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(a.m[i][j], b.m[i][j], tolerance) << "row " << i << " column " << j;
}

}  // namespace dspm::test
