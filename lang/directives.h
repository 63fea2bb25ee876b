// The words of the language: one visible table of directives, with the arguments that each takes and where it is
// allowed.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dspm {

// clang-format off
enum class DirectiveKind {
  accelerator, active_transform, area_light_source, attribute, attribute_begin, attribute_end, camera, color_space,
  concat_transform, coordinate_system, coord_sys_transform, film, identity, import, include, integrator, light_source,
  look_at, make_named_material, make_named_medium, material, medium_interface, named_material, object_begin, object_end,
  object_instance, option, pixel_filter, reverse_orientation, rotate, sampler, scale, shape, texture, transform,
  transform_begin, transform_end, transform_times, translate, world_begin,
  plugin, default_value, frames, dynamic_begin, dynamic_end, keyframe, keyframe_end,  // dspm's additions to pbrt
  variation_begin, variation_end, axis_begin, axis_end, axis_exclude, axis_only, show, hide, light,
};
// clang-format on

enum class Section { options, world, any };  // before WorldBegin, after it, anywhere

struct DirectiveInfo {
  std::string_view name;
  DirectiveKind kind;
  Section section;
  /// One letter per argument: s quoted string, S optional string, w bare word, v bare or quoted value, n number, k time
  /// of a key, a three numbers or the quoted name of what is there, m 16 numbers in brackets, P parameter list (always
  /// last).
  std::string_view arguments;
  int indentation = 0;  // +1: opens a block, -1: closes one
};

/// All directives, in alphabetical order; pbrt-v4 has no WorldEnd.
std::span<const DirectiveInfo> all_directives();
/// Returns null if no directive has that name.
const DirectiveInfo* find_directive(std::string_view name);
std::vector<std::string> directive_names();
/// Returns whether the directive moves what follows, or is a key or the end of such motion.
bool moves(DirectiveKind kind);

}  // namespace dspm
