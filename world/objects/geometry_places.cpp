// Geometry: what a directive has made, at each of its places, and the lights that come of it.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "dspm/base/math/moments.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/world/objects/geometry_source.h"
#include "dspm/world/objects/likeness.h"
#include "dspm/world/objects/moved_mesh.h"
#include "dspm/world/objects/param_states.h"
#include "dspm/world/objects/placement.h"
#include "dspm/world/objects/placement_check.h"
#include "dspm/world/objects/texture_cutout.h"
#include "dspm/world/objects/variations.h"

namespace dspm {
namespace {

/// Returns whether pictures of holes or heights may change.
bool pictures_move(const SceneDescription& description) {
  const auto is_keyed = [](const auto& use) { return use.params.is_keyed(); };
  return !description.axes.empty() || std::ranges::any_of(description.materials, is_keyed) ||
         std::ranges::any_of(description.textures, [&](const TextureUse& texture) {
           return is_keyed(texture) || texture.world_from_texture.is_keyed();
         });
}

/// Returns whether different media lie inside and outside of the shape.
bool parts_media(const SceneDescription& description, const ShapeUse& use) {
  return use.medium_interface >= 0 &&
         description.medium_interfaces[static_cast<std::size_t>(use.medium_interface)].parts();
}

Timeline<Matrix4> placements(const ShapeUse& use, const ObjectUse* instance, const FileFrames& frames,
                             const std::vector<bool>& present) {
  return Timeline<Matrix4>::of_moments(
      frames, present, [&](Moment moment) { return matrix_at(moment, use, instance); },
      [](const Matrix4& a, const Matrix4& b) { return a == b; },
      [](const Matrix4& matrix) { return Likeness().add(matrix).number(); });
}

/// Returns its mesh file without folder and extension, else its type.
std::string name_in_file(const ShapeUse& use) {
  const Param* file = use.params.find("filename");
  const auto* texts = file != nullptr ? std::get_if<std::vector<std::string>>(&file->values) : nullptr;
  if (texts == nullptr || texts->empty()) return use.type;
  return std::filesystem::path(texts->front()).stem().string();
}

}  // namespace

/// The thing that a placed shape stands for: one shape at two places counts as two, and so do two geometries, or two
/// patterns of holes, at one place.
struct Geometry::Place {
  int geometry, matrix, alpha;  // states
  friend bool operator==(const Place&, const Place&) = default;
};

bool Geometry::is_seen(int material, FileFrame frame) const { return material < 0 || looks_.is_seen(material, frame); }

/// An instance is one object, and so are all dynamic blocks of one name; any other shape is an object of its own.
int Geometry::object_of(const ShapeUse& use, const ObjectUse* instance) {
  const auto once = [&](auto& known, const auto& key, const std::string& name) {
    const auto [at, is_new] = known.try_emplace(key);
    if (is_new) at->second = objects_.add(name);
    return at->second;
  };
  if (instance) return once(object_of_use_, static_cast<const void*>(instance), instance->name);
  if (use.name.empty() && use.dynamic_block >= 0) {
    const std::string& block = description_.dynamic_blocks[static_cast<std::size_t>(use.dynamic_block)].name;
    return once(object_of_block_, block, block);
  }
  return once(object_of_use_, static_cast<const void*>(&use), use.name.empty() ? name_in_file(use) : use.name);
}

Timeline<Geometry::Place> Geometry::places_of(const Source& source, const Timeline<Matrix4>& matrices,
                                              const std::vector<bool>& present, std::size_t made) const {
  const int alpha = source.alphas[made];
  return Timeline<Place>::of(
      static_cast<int>(present.size()),
      [&](FileFrame f) -> std::optional<Place> {
        if (!present[f.slot()]) return std::nullopt;
        return Place{source.geometry.states.at(f), matrices.at(f),
                     alpha < 0 ? 0 : looks_.states_of_number(alpha)[f.slot()]};
      },
      [](const Place& a, const Place& b) { return a == b; },
      [](const Place& p) { return Likeness().add(p.geometry).add(p.matrix).add(p.alpha).number(); });
}

/// Returns the only matrix that places each geometry in the base of the file's frames, or in all frames if it is in
/// none of these; -1 if there are several.
std::vector<int> Geometry::only_matrices(const Timeline<Place>& places, std::size_t geometries, int base) {
  constexpr int kNone = -2, kSeveral = -1;
  std::vector<int> only(geometries, kNone);
  const auto known = static_cast<std::size_t>(places.states_of_first(base));
  std::vector<bool> is_in_base(geometries);
  for (std::size_t p = 0; p < places.states.size(); ++p) {
    const auto geometry = static_cast<std::size_t>(places.states[p].geometry);
    if (p < known) is_in_base[geometry] = true;
    if (p >= known && is_in_base[geometry]) continue;
    int& matrix = only[geometry];
    matrix = matrix == kNone || matrix == places.states[p].matrix ? places.states[p].matrix : kSeveral;
  }
  return only;
}

/// The places of a directive's shapes over the frames of the file.
struct Geometry::Placement {
  struct OfMade {
    std::vector<Place> states;
    std::vector<FrameRanges> seen;        // by state
    std::vector<FrameRanges> only_parts;  // likewise, see WorldShape
    std::vector<int> only;                // by geometry, see only_matrices
  };
  std::vector<Matrix4> matrices;
  std::vector<OfMade> made;
};

Geometry::Placement Geometry::placement(const ShapeUse& use, const ObjectUse* instance, const Source& source) const {
  std::vector<bool> present(source.params.state_of.size());
  for (std::size_t f = 0; f < present.size(); ++f) present[f] = source.params.state_of[f] >= 0;
  if (instance && instance->dynamic_block >= 0) {
    const std::vector<bool> there = presence(description_, instance->dynamic_block);
    for (std::size_t f = 0; f < present.size(); ++f) present[f] = present[f] && there[f];
  }
  Timeline<Matrix4> matrices = placements(use, instance, frames_of(blurs(use, instance)), present);
  if (moves(use, instance)) {
    const std::string subject = instance ? fmt::format("object \"{}\"", instance->name) : subject_of(use);
    leave_out_unplaced(matrices, description_.frames, subject, instance ? instance->where : use.where, diagnostics_);
    for (std::size_t f = 0; f < present.size(); ++f) present[f] = matrices.state_of[f] >= 0;
  }
  Placement placement{matrices.states, {}};
  for (std::size_t i = 0; i < source.materials.size(); ++i) {
    const Timeline<Place> places = places_of(source, matrices, present, i);
    Placement::OfMade made{places.states, std::vector<FrameRanges>(places.states.size()),
                           std::vector<FrameRanges>(places.states.size()),
                           only_matrices(places, source.geometry.shapes.size(), description_.frames.base().count())};
    for (FileFrame f(0); f.slot() < present.size(); ++f) {
      if (places.at(f) < 0) continue;
      const auto state = static_cast<std::size_t>(places.at(f));
      if (is_seen(source.materials[i], f))
        made.seen[state].add(f);
      else if (parts_media(description_, use))
        made.only_parts[state].add(f);
    }
    placement.made.push_back(std::move(made));
  }
  return placement;
}

void Geometry::place(const ShapeUse& use, const ObjectUse* instance, Source& source, bool alone) {
  const bool moves = dspm::moves(use, instance);
  const int block = instance ? instance->dynamic_block : -1;
  std::shared_ptr<const Placement> placement = moves ? nullptr : source.unmoved[block];
  if (!placement) placement = std::make_shared<const Placement>(this->placement(use, instance, source));
  if (!moves) source.unmoved[block] = placement;
  std::vector<Matrix4> matrices = placement->matrices;
  if (!moves)
    for (Matrix4& only : matrices) only = matrix_at(Moment(), use, instance);
  if (!moves && !matrices.empty() && !is_sound(matrices.front()))
    return report_singular(subject_of(use), "", instance ? instance->where : use.where, diagnostics_);
  const int object = object_of(use, instance);
  const bool changes = blurs(use, instance) && (moves || use.params.is_keyed() || source.has_velocities);
  const bool shows_pictures = use.params.find("displacement") != nullptr;
  for (std::size_t i = 0; i < source.materials.size(); ++i) {
    const Placement::OfMade& made = placement->made[i];
    std::map<int, std::shared_ptr<const Shape>> in_world;  // by geometry
    Emitter emitter{source.lights[i], {}};
    ++placed_;
    for (std::size_t p = 0; p < made.states.size(); ++p) {
      const Place& place = made.states[p];
      const auto state = static_cast<std::size_t>(place.geometry);
      std::shared_ptr<const Shape> shape = source.geometry.shapes[state][i];
      Transform to_world(matrices[static_cast<std::size_t>(place.matrix)]), moved_by;
      // A mesh that stays in one place is moved into world space; one that moves rigidly or is instanced is stored
      // once.
      if (alone && made.only[state] == place.matrix && shape->triangles()) {
        std::shared_ptr<const Shape>& moved = in_world[place.geometry];
        if (!moved && to_world.is_identity()) moved = shape;
        if (!moved) moved = moved_to(to_world, shape, kept_for(source));
        shape = moved, moved_by = to_world, to_world = Transform();
      }
      WorldShape& world = shapes_.emplace_back();
      world.use = &use, world.instance = instance;
      world.present = made.seen[p], world.only_parts = made.only_parts[p];
      world.shape = shape, world.placed.shape = shape.get();
      world.placed.to_world = to_world;
      world.placed.to_world_is_identity = to_world.is_identity();
      world.placed.flip_normals = use.reverse_orientation != (instance && instance->reverse_orientation);
      world.placed.caustics = source.caustics, world.is_catcher = source.is_catcher;
      world.placed.material = source.materials[i];
      world.placed.object = object;
      world.placed.cutout_key = placed_;
      world.moves = changes || ((shows_pictures || source.alphas[i] >= 0) && pictures_move(description_));
      world.dynamic_block = instance && use.dynamic_block < 0 ? instance->dynamic_block : use.dynamic_block;
      alphas_.set(world, source.alphas[i], place.alpha);
      if (source.has_extent) {
        const auto [known, is_new] = source.unread.try_emplace(place.geometry, unread_.size());
        const auto params = static_cast<std::size_t>(source.geometry.states.states[state].first);
        if (is_new) unread_.push_back({&use, source.params.states[params], {}});
        unread_[known->second].uses.push_back({shapes_.size() - 1, moved_by});
        world.is_unread = true;
      }
      if (emitter.use) {
        world.emitter = static_cast<int>(emitters_.size());
        emitter.shapes.push_back(static_cast<int>(shapes_.size()) - 1);
      }
    }
    if (emitter.use) add_emitter(std::move(emitter));
  }
}

/// Adds an emitter: its light is made for all frames at once, and so are its holes.
void Geometry::add_emitter(Emitter emitter) {
  const auto shape = [&](int s) -> WorldShape& { return shapes_[static_cast<std::size_t>(s)]; };
  const int base = description_.frames.base().count();
  std::vector<int> decisive;
  for (const int s : emitter.shapes)
    if (is_there(shape(s), base)) decisive.push_back(s);
  if (decisive.empty()) decisive = emitter.shapes;
  emitter.is_hidden =
      !decisive.empty() && std::all_of(decisive.begin(), decisive.end(), [&](int s) { return shape(s).nowhere; });
  for (const int s : emitter.shapes) {
    if (emitter.is_hidden || shape(s).alpha < 0) continue;
    shape(s).cutout = std::make_shared<TextureCutout>(looks_.number(shape(s).alpha, shape(s).alpha_state));
    shape(s).placed.cutout = shape(s).cutout.get();
  }
  emitters_.push_back(std::move(emitter));
}

}  // namespace dspm
