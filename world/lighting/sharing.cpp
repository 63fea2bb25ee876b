#include "dspm/world/lighting/sharing.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

std::string counted(std::size_t n, const char* word) { return fmt::format("{} {}{}", n, word, n == 1 ? "" : "s"); }

/// Returns how many of a thing's states occur in the frames; "not there" is one of them.
std::size_t states_in(const std::vector<int>& state_of, std::span<const FileFrame> frames) {
  std::set<int> seen;
  for (const FileFrame f : frames) seen.insert(state_of[f.slot()]);
  return seen.size();
}

/// The shapes of a dynamic block (or all static ones) in these frames.
struct Summary {
  std::size_t states = 0;          // distinct sets of placed shapes over the frames
  std::size_t frames_present = 0;  // with any of them
  std::size_t places = 0, primitives = 0;
  std::set<const Shape*> geometries;
};

/// The frames in which the shape is there, or parts media.
FrameSet there_in(const WorldShape& shape, std::span<const FileFrame> frames) {
  return shape.present.among(frames) | shape.only_parts.among(frames);
}

Summary summary(const std::vector<const WorldShape*>& shapes, std::span<const FileFrame> frames) {
  Summary s;
  std::set<std::vector<const WorldShape*>> states;
  std::set<const WorldShape*> places;
  for (const FileFrame f : frames) {
    std::vector<const WorldShape*> there;
    for (const WorldShape* shape : shapes)
      if (!there_in(*shape, {&f, 1}).empty()) there.push_back(shape);
    s.frames_present += !there.empty();
    places.insert(there.begin(), there.end());
    states.insert(std::move(there));
  }
  s.states = states.size(), s.places = places.size();
  for (const WorldShape* shape : places)
    if (s.geometries.insert(shape->placed.shape).second)
      s.primitives += static_cast<std::size_t>(shape->placed.shape->primitive_count());
  return s;
}

/// As the scene names it, else by its type or its shape.
std::string name_of(const WorldLight& light) {
  const std::string kind = light.name.substr(0, light.name.find(" \""));
  return fmt::format("{} \"{}\"", kind, light.short_name);
}

/// The lights of a Dynamic block without shapes.
std::string explain_lights(const DynamicBlock& block, const std::vector<const WorldLight*>& lights,
                           std::span<const FileFrame> frames) {
  std::vector<std::string> names;
  std::size_t most = 0, there = 0;
  for (const WorldLight* light : lights) {
    names.push_back(name_of(*light));
    most = std::max(most, states_in(light->states.state_of, frames));
    there += std::any_of(frames.begin(), frames.end(), [&](FileFrame f) { return light->states.at(f) >= 0; });
  }
  if (there == 0) return fmt::format("dynamic \"{}\": absent from these frames.", block.name);
  return fmt::format("dynamic \"{}\": no shapes, but {}{}.", block.name, fmt::join(names, ", "),
                     most == 1 ? ", the same in all frames" : "");
}

std::string explain_block(const DynamicBlock& block, const Summary& s, std::size_t frames) {
  const std::string stored = fmt::format("{} stored", counted(s.primitives, "primitive"));
  if (s.frames_present == 0) return fmt::format("dynamic \"{}\": absent from these frames.", block.name);
  if (s.states == 1)
    return fmt::format("dynamic \"{}\": the same in all frames, so it is static here: fully shared ({}).", block.name,
                       stored);
  const std::string where =
      s.frames_present < frames ? fmt::format("present in {} of {} frames, ", s.frames_present, frames) : "";
  const std::string how =
      s.geometries.size() < s.places
          ? fmt::format("moves rigidly, {}; its geometry is stored once", counted(s.states, "state"))
          : fmt::format("{} of its geometry over the frames", counted(s.states, "state"));
  return fmt::format("dynamic \"{}\": {}{} ({}). Paths that meet it split.", block.name, where, how, stored);
}

/// -1: none, as of lights that shapes emit.
int block_of(const WorldLight& light, const SceneDescription& description) {
  const auto use = std::find_if(description.lights.begin(), description.lights.end(), [&](const LightUse& each) {
    return &each == light.use || (!each.name.empty() && each.name == light.short_name);  // of a variation in its place
  });
  return use == description.lights.end() ? -1 : use->dynamic_block;
}

bool has_inner_blocks(const SceneDescription& description, int block) {
  return std::any_of(description.dynamic_blocks.begin(), description.dynamic_blocks.end(),
                     [&](const DynamicBlock& inner) { return inner.outer == block; });
}

/// Returns the names of what these shapes are parts of: all of them, or the first few.
std::string named(const std::vector<const WorldShape*>& shapes, const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> list;
  std::set<int> known;
  for (const WorldShape* shape : shapes)
    if (const int object = shape->placed.object; object >= 0 && known.insert(object).second && known.size() <= kMost)
      list.push_back(names[static_cast<std::size_t>(object)]);
  if (known.size() > kMost) list.push_back(fmt::format("and {} more", known.size() - kMost));
  return list.empty() ? "" : fmt::format(" ({})", fmt::join(list, ", "));
}

}  // namespace

std::vector<std::string> explain_sharing(const SceneDescription& description, const Geometry& geometry,
                                         const Looks& looks, const std::vector<WorldLight>& lights,
                                         const Timeline<std::shared_ptr<const Camera>>& camera,
                                         std::span<const FileFrame> frames) {
  std::vector<std::string> lines;
  const FileFrames& file = description.frames;
  const std::string names =
      frames.empty() || (description.axes.empty() && frames.size() == static_cast<std::size_t>(file.count()))
          ? ""
          : fmt::format(": {} to {}", file.label(frames.front()), file.label(frames.back()));
  lines.push_back(fmt::format("{} rendered together{}.", counted(frames.size(), "frame"), names));

  std::vector<const WorldShape*> still;
  std::vector<std::vector<const WorldShape*>> moving(description.dynamic_blocks.size());
  for (const WorldShape& shape : geometry.shapes())
    (shape.dynamic_block < 0 ? still : moving[static_cast<std::size_t>(shape.dynamic_block)]).push_back(&shape);
  // Outside of blocks, textures of holes and displacement may differ.
  const auto first_changing = std::stable_partition(still.begin(), still.end(), [&](const WorldShape* shape) {
    return there_in(*shape, frames) == FrameSet::first(static_cast<int>(frames.size()));
  });
  const Summary changing = summary({first_changing, still.end()}, frames);
  still.erase(first_changing, still.end());
  const Summary fixed = summary(still, frames);
  lines.push_back(fmt::format("static: {} in {}{}: shared by all frames. Paths that meet nothing else are traced once.",
                              counted(fixed.primitives, "primitive"), counted(fixed.geometries.size(), "shape"),
                              named(still, geometry.object_names())));
  if (changing.states > 1)
    lines.push_back(fmt::format("shapes whose holes or displacement differ: {}. Paths that meet them split.",
                                counted(changing.states, "state")));
  for (std::size_t b = 0; b < moving.size(); ++b) {
    const DynamicBlock& block = description.dynamic_blocks[b];
    std::vector<const WorldLight*> own;
    for (const WorldLight& light : lights)
      if (block_of(light, description) == static_cast<int>(b)) own.push_back(&light);
    if (!moving[b].empty())
      lines.push_back(explain_block(block, summary(moving[b], frames), frames.size()));
    else if (!own.empty())
      lines.push_back(explain_lights(block, own, frames));
    else if (has_inner_blocks(description, static_cast<int>(b)))
      lines.push_back(fmt::format("dynamic \"{}\": nothing but the Dynamic blocks in it.", block.name));
    else
      lines.push_back(explain_block(block, {}, frames.size()));
  }

  for (int m = 0; m < looks.material_count(); ++m)
    if (const std::size_t n = states_in(looks.states_of(m), frames); n > 1)
      lines.push_back(fmt::format(
          "{}: {} over the frames. Paths that meet it stay together if its states scatter them the same way, as "
          "different colours and textures do; others split.",
          looks.name_of(m), counted(n, "state")));
  for (const WorldLight& light : lights) {
    const std::size_t n = states_in(light.states.state_of, frames);
    if (n > 1)
      lines.push_back(
          fmt::format("{}: {} over the frames. Photon paths are traced once for states that differ in strength or "
                      "colour only, else "
                      "once per state; those of other lights once.",
                      name_of(light), counted(n, "state")));
  }
  const std::size_t camera_states = states_in(camera.state_of, frames);
  lines.push_back(camera_states > 1
                      ? fmt::format("camera: {}. Hit points are traced once per state; photons are still shared.",
                                    counted(camera_states, "state"))
                      : "camera: the same in all frames: hit points are shared where nothing dynamic is seen.");
  return lines;
}

std::vector<std::string> explain_worth(const FileFrames& file, const LightChoices& choices,
                                       const std::vector<PhotonWorth>& worth, std::span<const FileFrame> frames) {
  constexpr double kWorthTelling = 0.9;
  const auto of = [&](FileFrame f, double PhotonWorth::*share) { return worth[f.slot()].*share; };
  const auto worst = [&](double PhotonWorth::*share) -> std::optional<FileFrame> {
    const auto least = std::min_element(frames.begin(), frames.end(),
                                        [&](FileFrame a, FileFrame b) { return of(a, share) < of(b, share); });
    return least != frames.end() && of(*least, share) < kWorthTelling ? std::optional(*least) : std::nullopt;
  };
  const std::string all = counted(static_cast<std::size_t>(file.count()), "frame");
  std::vector<std::string> lines;
  const std::size_t groups = choices.probabilities.size();
  if (groups > 1)
    lines.push_back(fmt::format(
        "lights: they differ so much between the {} of the file that these are {} groups, each of which chooses lights "
        "for its photons by its own mean power. Photons are shared within a group.",
        all, groups));
  if (const auto frame = worst(&PhotonWorth::by_choice))
    lines.push_back(
        fmt::format("lights: photon paths choose them by their mean power over the {}. Frame {} fares worst: "
                    "the flux of its lights is as noisy as with {:.2g}% of the photons in a file of its own.",
                    groups > 1 ? "group's frames" : all + " of the file", file.label(*frame),
                    100 * of(*frame, &PhotonWorth::by_choice)));
  if (const auto frame = worst(&PhotonWorth::by_reach))
    lines.push_back(
        fmt::format("distant and infinite lights: their photons start on a disk that covers what is in any "
                    "of the {} of the file. Frame {} fares worst: {:.2g}% of them would be enough in a file "
                    "of its own.",
                    all, file.label(*frame), 100 * of(*frame, &PhotonWorth::by_reach)));
  return lines;
}

}  // namespace dspm
