#include "dspm/world/objects/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <unordered_map>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/params/flag.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/parallel.h"
#include "dspm/shapes/mesh_check.h"
#include "dspm/shapes/mesh_params.h"
#include "dspm/shapes/mesh_repair.h"
#include "dspm/shapes/placed_bounds.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/world/objects/geometry_source.h"
#include "dspm/world/objects/param_states.h"
#include "dspm/world/objects/shape_maker.h"

namespace dspm {
namespace {

/// Returns the union of box_of(primitive).
template <class BoxOf>
Bounds3 union_of(int primitives, const BoxOf& box_of) {
  constexpr int kGrain = 4096;
  std::vector<Bounds3> parts(static_cast<std::size_t>(chunk_count(primitives, kGrain)));
  parallel_for(primitives, kGrain,
               [&](std::int64_t i) { parts[static_cast<std::size_t>(i / kGrain)].add(box_of(static_cast<int>(i))); });
  Bounds3 all;
  for (const Bounds3& part : parts) all.add(part);
  return all;
}

}  // namespace

Geometry::Geometry(const SceneDescription& description, bool check_meshes, Looks& looks, KeptGeometry* kept,
                   Diagnostics& diagnostics)
    : description_(description),
      whole_frames_(description.frames.after(0)),
      looks_(looks),
      alphas_(description, looks, diagnostics),
      diagnostics_(diagnostics),
      kept_(kept),
      check_meshes_(check_meshes) {
  add_sources(description.shapes, {});
  std::map<std::string, std::vector<const ObjectUse*>> uses;
  for (const ObjectUse& use : description.instances) uses[use.name].push_back(&use);
  refuse_unknown_objects();
  for (const ObjectDefinition& object : description.objects)
    if (const auto found = uses.find(object.name); found != uses.end()) add_sources(object.shapes, found->second);
  find_bounds();
}

/// Finds the bounds. What lies within the box so far cannot widen it, so only few of a million trees are looked at leaf
/// by leaf.
void Geometry::find_bounds() {
  std::unordered_map<const Shape*, Bounds3> boxes;  // in their own spaces
  for (const WorldShape& shape : shapes_) {
    if (!is_there(shape, description_.frames.base().count())) continue;
    const Shape& own = *shape.placed.shape;
    const auto [box, is_new] = boxes.try_emplace(&own);
    if (is_new) box->second = union_of(own.primitive_count(), [&](int i) { return own.bounds(i); });
    Bounds3 wider = bounds_;
    wider.add(bounds_of(shape.placed, box->second));
    if (wider.low == bounds_.low && wider.high == bounds_.high) continue;
    if (shape.placed.in_object_space())
      bounds_.add(union_of(own.primitive_count(), [&](int i) { return shape.placed.bounds(i); }));
    else
      bounds_ = wider;
  }
}

void Geometry::refuse_unknown_objects() {
  std::vector<std::string> names;
  for (const ObjectDefinition& object : description_.objects) names.push_back(object.name);
  for (const ObjectUse& use : description_.instances)
    if (std::find(names.begin(), names.end(), use.name) == names.end())
      diagnostics_.error(use.where, fmt::format("there is no object named \"{}\"", use.name),
                         did_you_mean(use.name, names));
}

/// Takes shapes from the scene before, if they are what they were: those without a file that may absorb others have
/// been made again.
void Geometry::share_kept(Source& source) const {
  if (kept_ == nullptr) return;
  for (std::size_t s = 0; s < source.keys.size(); ++s) {
    if (are_meshes(source.made[s])) continue;
    ContentKey settled = source.keys[s];
    settled.add("settled");
    if (auto known = kept_->find(settled))
      source.made[s] = *std::move(known);
    else
      kept_->keep(settled, source.made[s], {}, KeptGeometry::Clock::now());
  }
}

/// Returns where to keep what is made of the source's shapes: nowhere if these will not come again.
KeptGeometry* Geometry::kept_for(const Source& source) const { return source.keys.empty() ? nullptr : kept_; }

/// Says once of a sequence that it does not deform between some of its files.
void Geometry::note_unlike(const ShapeUse& use, const std::optional<UnlikeFiles>& files) {
  if (!files || !unlike_.insert(&use).second) return;
  const Param* const file = use.params.find("filename");
  diagnostics_.note(file != nullptr ? file->values_where : use.where,
                    fmt::format("\"{}\" and \"{}\" differ in their vertices or faces: in such frames the mesh stays as "
                                "it is while the shutter is open",
                                files->own, files->other),
                    "files with velocities of vertices (vx, vy, vz) need no like vertices");
}

void Geometry::add_source(const ShapeUse& use, const std::vector<const ObjectUse*>& instances, Source& source) {
  const int errors = diagnostics_.error_count();
  if (source.has_extent && (use.area_light >= 0 || looks_.emits(looks_.find(use.material)))) {
    std::optional<Source> whole = make_source(use, diagnostics_, false);  // its power in all frames matters
    if (!whole) return;
    source = *std::move(whole);
  }
  has_velocities_ = has_velocities_ || source.has_velocities;
  note_unlike(use, source.unlike);
  for (MadeShapes& made : source.made)
    for (SourceShape& each : made) each.shape->settle();
  share_kept(source);
  const int alpha = alphas_.of(use);
  for (const SourceShape& shape : source.made.front()) {
    source.materials.push_back(shape.material ? looks_.add(*shape.material, use.where) : looks_.find(use.material));
    const int material = source.materials.back();
    source.lights.push_back(emission(use, *shape.shape, material));
    source.alphas.push_back(looks_.opacity(material, alpha));
  }
  if (diagnostics_.error_count() > errors) return;
  leave_out_lights_of_unseen(use, source);
  warn_of_relief(use, source);
  for (const MadeShapes& made : source.made)
    if (made.size() != source.materials.size())
      return diagnostics_.error(use.where, "the files of this sequence hold different numbers of groups or materials");
  check(use, source);
  source.geometry = displaced(use, source.params.state_of, std::move(source.made), description_, looks_, diagnostics_);
  if (diagnostics_.error_count() > errors) return;
  if (instances.empty()) return place(use, nullptr, source, true);
  for (const ObjectUse* instance : instances) place(use, instance, source, instances.size() == 1);
}

/// Leaves out the lights of surfaces that are not there: as in pbrt, they emit nothing.
void Geometry::leave_out_lights_of_unseen(const ShapeUse& use, Source& source) {
  for (std::size_t i = 0; i < source.materials.size(); ++i) {
    if (source.lights[i].use == nullptr) continue;
    bool seen = false;
    for (FileFrame f(0); f.index() < description_.frames.count(); ++f) seen |= is_seen(source.materials[i], f);
    if (seen) continue;
    source.lights[i] = {};
    diagnostics_.warning(use.where, fmt::format("{} is an interface, so its area light is left out", subject_of(use)));
  }
}

/// Warns of relief on curves, whose normals are those of the ray.
void Geometry::warn_of_relief(const ShapeUse& use, const Source& source) {
  for (std::size_t i = 0; i < source.materials.size(); ++i)
    if (source.made.front()[i].shape->turns() && source.materials[i] >= 0 && looks_.bends_normals(source.materials[i]))
      diagnostics_.warning(use.where, fmt::format("{} does not show the relief of {}", subject_of(use),
                                                  looks_.name_of(source.materials[i])));
}

/// A mesh that bounds a body should be closed. Faults are reported once for the whole sequence, and repaired in all of
/// its frames alike if the scene asks for it.
void Geometry::check(const ShapeUse& use, Source& source) {
  for (std::size_t p = 0; p < source.materials.size(); ++p) {
    SourceShape& first = source.has_extent ? source.first[p] : source.made.front()[p];
    const TriangleMesh* mesh = first.shape->triangles();
    const int material = source.materials[p];
    if (!mesh || material < 0) continue;
    const bool body = looks_.bounds_a_body(material);
    if (first.repair) {
      const std::shared_ptr<const Shape> model = first.shape;
      std::once_flag planned;
      RepairPlan plan;
      const auto repaired = [&](const TriangleMesh& other) {
        if (other.faces() != model->triangles()->faces()) return apply(plan_repair(other), other);
        std::call_once(planned, [&] { plan = plan_repair(*model->triangles()); });
        return apply(plan, other);
      };
      parallel_for(static_cast<std::int64_t>(source.made.size()), 1, [&](std::int64_t i) {
        auto& shape = source.made[static_cast<std::size_t>(i)][p].shape;
        if (const TriangleMesh* other = shape->triangles())
          shape = derived<TriangleMesh>(kept_for(source), {shape, model}, ContentKey("repaired"),
                                        [&] { return repaired(*other); });
      });
      mesh = source.made.front()[p].shape->triangles();
    }
    if (!body || !check_meshes_) continue;
    MeshReport report =
        *derived<MeshReport>(kept_, {first.shape}, ContentKey("report"), [&] { return check_mesh(*mesh); });
    if (is_true(source.params.states.front().params, kOpenParam)) report.open_edges = {};
    for (const std::string& fault : describe(report))
      diagnostics_.warning(
          use.where, fmt::format("{} with {}: {}", subject_of(use), looks_.name_of(material), fault),
          first.repair ? ""
                       : "\"bool repair\" true repairs orientation, duplicate vertices and small holes; \"bool open\" "
                         "true says that it is meant to be open");
  }
}

}  // namespace dspm
