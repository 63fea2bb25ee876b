// AxisExclude and AxisOnly: which combinations of the axes' variations are left.
#include <fmt/format.h>

#include <algorithm>

#include "dspm/lang/glob.h"
#include "dspm/lang/scene_builder.h"
#include "dspm/lang/source_text.h"

namespace dspm {
namespace {

constexpr std::size_t kMostRules = 1000;

bool matches_any(const VariationAxis& axis, const Glob& glob) {
  return std::any_of(axis.variations.begin(), axis.variations.end(),
                     [&](const Variation& each) { return glob.matches(each.name); });
}

std::vector<std::string> names_of(const std::vector<VariationAxis>& axes) {
  std::vector<std::string> names;
  for (const VariationAxis& axis : axes)
    for (const Variation& each : axis.variations) names.push_back(each.name);
  return names;
}

}  // namespace

void SceneBuilder::add_rule(const Directive& directive) {
  expect_top_level(directive);
  if (scene_.rules.size() == kMostRules)
    throw SyntaxError(directive.where, fmt::format("there are more than {} of AxisExclude and AxisOnly", kMostRules));
  CombinationRule rule{directive.info->kind == DirectiveKind::axis_exclude, {}, directive.where};
  for (const Argument& word : directive.words) rule.patterns.push_back({-1, word.text, word.where});
  scene_.rules.push_back(std::move(rule));
}

void SceneBuilder::check_rules() {
  for (CombinationRule& rule : scene_.rules)
    for (CombinationRule::Pattern& pattern : rule.patterns)
      if (diagnostics_.error_count() < kErrorsShown && find_axis(pattern)) check_pattern(pattern);
}

/// Finds the axis that "legs:oak" asks for. A variation's name has no colon.
bool SceneBuilder::find_axis(CombinationRule::Pattern& pattern) {
  const std::size_t colon = pattern.text.rfind(':');
  if (colon == std::string::npos) return true;
  const std::string name = pattern.text.substr(0, colon);
  std::vector<std::string> names;
  for (const VariationAxis& each : scene_.axes) names.push_back(each.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    diagnostics_.error(pattern.where, fmt::format("there is no axis \"{}\"", name), did_you_mean(name, names));
    return false;
  }
  pattern.axis = static_cast<int>(found - names.begin());
  pattern.text.erase(0, colon + 1);
  return true;
}

void SceneBuilder::check_pattern(const CombinationRule::Pattern& pattern) {
  const Glob glob(pattern.text);
  for (std::size_t a = 0; a < scene_.axes.size(); ++a)
    if ((pattern.axis < 0 || pattern.axis == static_cast<int>(a)) && matches_any(scene_.axes[a], glob)) return;
  diagnostics_.error(pattern.where, fmt::format("no variation is named \"{}\"", pattern.text),
                     did_you_mean(pattern.text, names_of(scene_.axes)));
}

}  // namespace dspm
