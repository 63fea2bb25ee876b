#include "dspm/world/world.h"

#include <fmt/format.h>

#include <algorithm>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/files_read.h"
#include "dspm/lang/shutter.h"
#include "dspm/lights/light_group.h"
#include "dspm/world/bodies.h"
#include "dspm/world/cameras.h"
#include "dspm/world/lighting/coverage.h"
#include "dspm/world/lighting/lighting.h"
#include "dspm/world/lighting/sharing.h"
#include "dspm/world/media_check.h"
#include "dspm/world/media_in_scene.h"
#include "dspm/world/nearby_views.h"
#include "dspm/world/objects/distinct_names.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/media.h"
#include "dspm/world/objects/nearby_changes.h"
#include "dspm/world/objects/param_key.h"
#include "dspm/world/objects/texture_cutout.h"
#include "dspm/world/objects/variations.h"
#include "dspm/world/overlap_warnings.h"

namespace dspm {
namespace {

void add_new_notes(const Diagnostics& from, Diagnostics& to) {
  std::vector<std::string> known;
  for (const Diagnostic& each : to.all()) known.push_back(each.message);
  for (const Diagnostic& each : from.all())
    if (each.severity == Severity::note && std::find(known.begin(), known.end(), each.message) == known.end())
      to.note(each.where, each.message, each.hint);
}

template <class T>
FrameStates<T> cut(const Timeline<std::shared_ptr<const T>>& line, const std::vector<FileFrame>& frames) {
  FrameStates<T> result;
  for (std::size_t s = 0; s < line.states.size(); ++s)
    if (const FrameSet set = frames_in_state(line, static_cast<int>(s), frames); !set.empty())
      result.states.push_back({set, line.states[s]});
  return result;
}

}  // namespace

/// What integrators learn from a small picture is worth fewer frames.
std::size_t size_of_sample(const WorldOptions& options) {
  constexpr std::size_t kLeast = 4, kPixelsAFrame = 1 << 10;
  const std::size_t pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  return std::clamp(pixels / kPixelsAFrame, kLeast, LightChoices::kMostChoices);
}

struct World::Impl {
  /// `sooner` is the world of the same frames at another time; null if there is none.
  Impl(const SceneDescription& text, const WorldOptions& how, Diagnostics& diagnostics, const Impl* sooner = nullptr)
      : description(text),
        options(how),
        looks(text,
              sooner != nullptr ? sooner->looks.images()
                                : std::make_shared<ImageCache>(!text.options.disable_texture_filtering),
              diagnostics),
        media(text, sooner != nullptr ? &sooner->media : nullptr, diagnostics),
        geometry(text, options.check_meshes, looks, options.kept, diagnostics),
        kept(options.kept),
        sample_size(size_of_sample(options)) {
    looks.refuse_unknown_replacements();
    const bool whole = diagnostics.error_count() == 0;
    if (whole && geometry.shapes().empty()) diagnostics.warning({}, "the scene has no shape");
    if (whole && text.lights.empty() && geometry.emitters().empty() && media.glowing().empty())
      diagnostics.warning({}, "the scene has no light: its images will be black");
    const bool fits = sooner != nullptr && is_within(geometry.bounds(), sooner->sphere);
    sphere = fits ? sooner->sphere : sphere_around(geometry.bounds());
    lights =
        make_lights(text, geometry, looks, media, sphere, sooner != nullptr ? &sooner->lights : nullptr, diagnostics);
    if (diagnostics.error_count() == 0) {
      light_choices = sooner != nullptr ? make_light_choices(lights, sooner->light_choices)
                                        : make_light_choices(lights, text.frames.base().count(), text.frames.count());
      direct_light = make_light_samples(lights, light_choices);
      const auto is_rendered = [&](FileFrame f) {
        return options.rendered == nullptr || std::binary_search(options.rendered->begin(), options.rendered->end(), f);
      };
      expect_covered(text, is_rendered, geometry, sphere, lights, light_choices, diagnostics);
    }
    if (diagnostics.error_count() == 0) read_frames();
    for (const WorldLight& light : lights) light_names.add(light.short_name);
    for (const WorldLight& light : lights)
      if (light.group != kOtherLights) light_groups.push_back(light.group);
    std::sort(light_groups.begin(), light_groups.end());
    light_groups.erase(std::unique(light_groups.begin(), light_groups.end()), light_groups.end());
    light_groups.insert(light_groups.begin(), kOtherLights);
    camera = make_cameras(text, film(), diagnostics);
    const std::string name = options.accel.empty() ? "two-level" : options.accel;
    accel = accel_plugins().find(name, text.accelerator ? text.accelerator->type_where : SourceLocation{}, diagnostics);
    if (accel == nullptr) return;
    if (text.accelerator && text.accelerator->type == name) accel_params = text.accelerator->params.at(Moment());
    ParamReader reader = accel_reader(diagnostics);
    check(*accel, reader, std::span<const PlacedShape>(), FrameSet());
    if (!options.check_meshes || diagnostics.error_count() > 0) return;
    warn_of_overlaps(diagnostics);
    if (media.are_used()) warn_of_media(diagnostics);
  }

  /// Reads the meshes of the frames of which scenes are made: those that are rendered, and those that stand for the file.
  void read_frames() {
    std::vector<FileFrame> frames;
    if (options.rendered != nullptr)
      frames = *options.rendered;
    else
      for (FileFrame f(0); f.index() < description.frames.count(); ++f) frames.push_back(f);
    geometry.read(options.nearby ? with_nearby(description.frames, frames) : frames);
    geometry.read(light_choices.sample());
    geometry.read(light_choices.sample(sample_size));
  }

  CameraContext film() const { return {{}, options.width, options.height, options.film_diagonal}; }

  ParamReader accel_reader(Diagnostics& diagnostics) const {
    return {accel_params, fmt::format("accelerator \"{}\"", accel->name),
            description.accelerator ? description.accelerator->where : SourceLocation{}, diagnostics};
  }

  int group_of(const WorldLight& light) const {
    const auto group = std::find(light_groups.begin(), light_groups.end(), light.group);
    return static_cast<int>(group - light_groups.begin());
  }

  enum class Contents { all, without_objects, bodies };

  std::vector<PlacedShape> shapes_in(const std::vector<FileFrame>& frames, Contents contents = Contents::all) const {
    std::vector<PlacedShape> shapes;
    const auto of_media =
        std::ranges::count_if(lights, [](const WorldLight& light) { return light.glow_of != kNoMedium; });
    const auto directives = static_cast<int>(lights.size() - geometry.emitters().size()) - static_cast<int>(of_media);
    for (const WorldShape* shape : shapes_there(frames, contents)) {
      PlacedShape& placed = shapes.emplace_back(shape->placed);
      placed.frames = shape->present.among(frames);
      placed.moves = options.blurs && shape->moves;
      placed.light = shape->emitter < 0 ? -1 : directives + shape->emitter;
    }
    return shapes;
  }
  std::vector<const WorldShape*> shapes_there(const std::vector<FileFrame>& frames,
                                              Contents contents = Contents::all) const {
    std::vector<const WorldShape*> there;
    for (const WorldShape& shape : geometry.shapes()) {
      if (contents == Contents::without_objects && !shape.is_catcher && shape.emitter < 0) continue;
      if (contents == Contents::bodies && !looks.bounds_a_body(shape.placed.material)) continue;
      if (!shape.nowhere && !shape.present.among(frames).empty()) there.push_back(&shape);
    }
    // What stays has the same numbers at all times, so it can have one tree for all of them.
    if (options.blurs)
      std::stable_partition(there.begin(), there.end(), [](const WorldShape* shape) { return !shape->moves; });
    return there;
  }
  bool has_catchers() const {
    const auto& shapes = geometry.shapes();
    return std::any_of(shapes.begin(), shapes.end(), [](const WorldShape& shape) { return shape.is_catcher; });
  }
  void add_shapes(Scene& scene, Contents contents) const {
    scene.shapes = shapes_in(scene.file_frames, contents);
    const std::vector<const WorldShape*> there = shapes_there(scene.file_frames, contents);
    cut_out(scene, there);
    if (has_catchers())
      for (const WorldShape* shape : there) scene.catchers.push_back(shape->is_catcher);
  }
  /// Gives the scene's shapes their holes.
  void cut_out(Scene& scene, const std::vector<const WorldShape*>& there) const {
    for (std::size_t i = 0; i < there.size(); ++i) {
      const WorldShape& shape = *there[i];
      if (shape.alpha < 0) continue;
      scene.cutouts.push_back(
          shape.cutout ? shape.cutout
                       : std::make_shared<const TextureCutout>(looks.number(shape.alpha, shape.alpha_state)));
      scene.shapes[i].cutout = scene.cutouts.back().get();
    }
  }

  std::unique_ptr<Scene> scene(std::span<const FileFrame> frames, Contents contents, const Scene* sooner) const;

  /// Warns of overlaps in the frames that stand for the file.
  void warn_of_overlaps(Diagnostics& diagnostics) const;
  /// Warns of interfaces that contradict each other in one of these frames.
  void warn_of_media(Diagnostics& diagnostics) const;

  std::unique_ptr<Accel> make_accel(const Scene& scene, Contents contents, const Scene* sooner) const {
    if (sooner != nullptr)
      if (std::unique_ptr<Accel> shared = sooner->accel->with(scene.shapes, scene.frames())) return shared;
    const auto make = [&](std::span<const PlacedShape> shapes) {
      Diagnostics ignored;
      ParamReader reader = accel_reader(ignored);
      return accel->make(reader, shapes, scene.frames());
    };
    if (kept == nullptr || own_description != nullptr || !scene.cutouts.empty()) return make(scene.shapes);
    ContentKey which(accel->name);
    add(which, accel_params);
    std::vector<std::shared_ptr<const Shape>> owners;
    for (const WorldShape* shape : shapes_there(scene.file_frames, contents)) owners.push_back(shape->shape);
    return kept->tree(which, scene.shapes, std::move(owners), scene.frames(), make);
  }

  std::unique_ptr<const SceneDescription> own_description;  // null: the caller's
  const SceneDescription& description;
  const WorldOptions options;
  Looks looks;
  Media media;
  Geometry geometry;
  KeptGeometry* kept;
  std::size_t sample_size;  // frames
  BoundingSphere sphere;
  std::vector<WorldLight> lights;
  LightChoices light_choices;
  std::vector<LightSamples> direct_light;  // by choice
  DistinctNames light_names;
  std::vector<std::string> light_groups;
  Timeline<std::shared_ptr<const Camera>> camera;
  const AccelPlugin* accel = nullptr;
  ParamList accel_params;
};

World::World(const SceneDescription& description, const WorldOptions& options, Diagnostics& diagnostics)
    : impl_(std::make_unique<Impl>(description, options, diagnostics)) {}
World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
World::~World() = default;

std::unique_ptr<World> World::after(double delay, Diagnostics* notes) const {
  WorldOptions options = impl_->options;
  options.check_meshes = false;
  auto text = std::make_unique<const SceneDescription>(dspm::after(impl_->description, delay));
  Diagnostics diagnostics(true);
  auto later = std::make_unique<Impl>(*text, options, diagnostics, impl_.get());
  diagnostics.throw_if_errors();
  if (notes != nullptr) add_new_notes(diagnostics, *notes);
  later->own_description = std::move(text);
  if (options.kept != nullptr) options.kept->scene_is_loaded();
  return std::unique_ptr<World>(new World(std::move(later)));
}

std::string World::sampling() const {
  std::string bytes;
  const auto add = [&](float number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof(number)); };
  for (const float number : {impl_->sphere.center.x, impl_->sphere.center.y, impl_->sphere.center.z}) add(number);
  add(impl_->sphere.radius);
  for (const WorldLight& light : impl_->lights) add(light.probability);
  for (const std::vector<float>& choice : impl_->light_choices.probabilities)
    for (const float probability : choice) add(probability);
  for (const WorldLight& light : impl_->lights) {
    if (impl_->lights.size() <= LightSamples::kFewLights || !light.bounds) continue;
    const auto& [box, axis, spread, reach, two_sided] = *light.bounds;
    for (const Vec3& v : {box.low, box.high, axis}) add(v.x), add(v.y), add(v.z);
    add(spread), add(reach), add(two_sided ? 1.f : 0.f);
  }
  return fmt::format("{:016x}", digest(bytes));
}

std::vector<PlacedShape> World::moving_shapes(std::span<const FileFrame> frames) const {
  std::vector<PlacedShape> shapes = impl_->shapes_in({frames.begin(), frames.end()});
  std::erase_if(shapes, [](const PlacedShape& shape) { return !shape.moves; });
  return shapes;
}

FrameStates<Camera> World::cameras(std::span<const FileFrame> frames) const {
  return cut(impl_->camera, {frames.begin(), frames.end()});
}

bool World::has_velocities() const { return impl_->geometry.has_velocities(); }

std::unique_ptr<Scene> World::scene(std::span<const FileFrame> frames, const Scene* sooner) const {
  std::unique_ptr<Scene> scene = impl_->scene(frames, Impl::Contents::all, sooner);
  if (impl_->has_catchers())
    scene->without_objects = impl_->scene(frames, Impl::Contents::without_objects,
                                          sooner != nullptr ? sooner->without_objects.get() : nullptr);
  return scene;
}

std::unique_ptr<Scene> World::Impl::scene(std::span<const FileFrame> frames, Contents contents,
                                          const Scene* sooner) const {
  auto scene = std::make_unique<Scene>();
  scene->is_without_objects = contents == Contents::without_objects;
  scene->file_frames.assign(frames.begin(), frames.end());
  scene->center = sphere.center, scene->radius = sphere.radius;
  add_shapes(*scene, contents);
  scene->object_names = geometry.object_names();
  scene->materials = looks.materials_in(scene->file_frames);
  scene->material_names = looks.material_names();
  find_bodies(*scene);
  if (contents != Contents::without_objects)  // smoke is no part of what catchers stand for
    add_media(*scene, media, geometry, shapes_there(scene->file_frames, contents),
              [&](std::span<const PlacedShape> shapes) {
                Diagnostics ignored;
                ParamReader reader = accel_reader(ignored);
                return accel->make(reader, shapes, scene->frames());
              });
  for (const WorldLight& light : lights) {
    if (light.infinite) scene->infinite_lights.push_back(static_cast<int>(scene->lights.size()));
    scene->lights.push_back({cut(light.states, scene->file_frames), light.probability,
                             alike_in(light, scene->file_frames), light.is_delta, light.controls.photons,
                             light.controls.caustics, light_choices.shares(light), group_of(light)});
  }
  add_media_of_lights(*scene, lights, media);
  scene->light_choices = light_choices.in(scene->file_frames);
  scene->direct_light = direct_light;
  scene->light_names = light_names.all();
  scene->light_groups = light_groups;
  scene->camera = cut(camera, scene->file_frames);
  for (const FileFrame frame : frames) scene->camera_to_world.push_back(camera_to_world(description, frame));
  if (options.nearby)
    scene->nearby = std::make_shared<const NearbyMoments>(
        nearby_changes(description, geometry, shapes_there(scene->file_frames, contents), frames),
        nearby_views(description, frames, film()));
  scene->accel = make_accel(*scene, contents, sooner);
  find_bodies_around_camera(*scene);
  add_media_around_camera(*scene, description, media);
  return scene;
}

void World::Impl::warn_of_overlaps(Diagnostics& diagnostics) const {
  Scene bodies;
  bodies.file_frames = light_choices.sample();
  const std::vector<const WorldShape*> there = shapes_there(bodies.file_frames, Contents::bodies);
  if (there.size() < 2) return;
  bodies.shapes = shapes_in(bodies.file_frames, Contents::bodies);
  cut_out(bodies, there);
  bodies.materials = looks.materials_in(bodies.file_frames);
  const std::vector<Neighbours> pairs = neighbours(bodies);
  if (pairs.empty()) return;
  Diagnostics ignored;
  ParamReader reader = accel_reader(ignored);
  bodies.accel = accel->make(reader, bodies.shapes, bodies.frames());
  warn_of(find_overlaps(bodies, pairs), bodies, there, looks, description.frames, diagnostics);
}

void World::Impl::warn_of_media(Diagnostics& diagnostics) const {
  const std::vector<FileFrame> frame{light_choices.sample().front()};
  const std::unique_ptr<const Scene> whole = scene(frame, Contents::all, nullptr);
  dspm::warn_of_contradictions({*whole, shapes_there(frame), boundary_shapes(media, geometry, frame), description,
                                options.width, options.height},
                               diagnostics);
}

std::vector<FileFrame> World::sample_frames() const { return impl_->light_choices.sample(impl_->sample_size); }

const PluginUse& World::use_of(const SceneElement& element, std::span<const FileFrame> frames, Frame j) const {
  switch (element.kind) {
    case SceneElement::Kind::camera: break;
    case SceneElement::Kind::material: return impl_->looks.use_of(element.index, frames[static_cast<std::size_t>(j)]);
    case SceneElement::Kind::medium: return impl_->media.use_of(element.index, frames[static_cast<std::size_t>(j)]);
    case SceneElement::Kind::light: return *impl_->lights[static_cast<std::size_t>(element.index)].use;
    case SceneElement::Kind::shape:
      return *impl_->shapes_there({frames.begin(), frames.end()})[static_cast<std::size_t>(element.index)]->use;
  }
  return camera_use(impl_->description, frames[static_cast<std::size_t>(j)]);
}

CameraMatrices World::camera_matrices(FileFrame frame) const {
  const Matrix4 placed =
      camera_use(impl_->description, frame).camera_from_world.at(impl_->description.frames.moment(frame));
  const int state = impl_->camera.at(frame);
  const auto image_from_camera = impl_->camera.states[static_cast<std::size_t>(state)]->image_from_camera();
  return {placed, image_from_camera ? std::optional(*image_from_camera * placed) : std::nullopt};
}

int World::pictures_held() const { return impl_->looks.pictures_held(); }

std::size_t World::tree_bytes_at_most(std::span<const FileFrame> frames) const {
  const auto bytes = [&](Impl::Contents contents) {
    return impl_->accel->bytes_at_most(impl_->shapes_in({frames.begin(), frames.end()}, contents),
                                       FrameSet::first(static_cast<int>(frames.size())));
  };
  return bytes(Impl::Contents::all) + (impl_->has_catchers() ? bytes(Impl::Contents::without_objects) : 0);
}

std::vector<std::string> World::explain(std::span<const FileFrame> frames) const {
  std::vector<std::string> lines =
      explain_sharing(impl_->description, impl_->geometry, impl_->looks, impl_->lights, impl_->camera, frames);
  for (std::string& line : impl_->media.explain(frames)) lines.push_back(std::move(line));
  const auto worth = photon_worth(impl_->geometry, impl_->lights, impl_->light_choices, impl_->sphere);
  for (std::string& line : explain_worth(impl_->description.frames, impl_->light_choices, worth, frames))
    lines.push_back(std::move(line));
  return lines;
}

}  // namespace dspm
