#include "dspm/integrators/surface_outputs.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/integrators/camera_path.h"
#include "dspm/integrators/make_beside.h"
#include "dspm/integrators/tiles.h"
#include "dspm/math/frames.h"
#include "dspm/math/vec.h"
#include "dspm/scene/scene.h"
#include "dspm/system/parallel.h"

namespace dspm {
namespace {

/// In the order of surface_outputs().
enum Kind { kNormal, kPosition, kDepth, kAlbedo, kTextureUv, kObject, kMaterial, kKinds };

constexpr int kTileSide = 16;
constexpr int kNone = -1;          // no object, no material
constexpr float kNoDepth = 1e10f;  // where no surface is, as in Blender

bool is_id(Kind kind) { return kind == kObject || kind == kMaterial; }

/// The directional-hemispherical reflectance (and transmittance), or an estimate of it.
Rgb albedo(const Bsdf& bsdf, const Vertex& vertex, const CameraPath& path) {
  if (const auto f = bsdf.lambertian(bsdf.all_lobes())) return *f * kPi;
  constexpr int kSamples = 4;
  Rgb sum;
  for (int i = 0; i < kSamples; ++i) {
    PathState other = path;
    other.bounces = i;  // other random numbers
    const auto sample = sample_bsdf(bsdf, other, vertex.wo, Transport::radiance, bsdf.all_lobes());
    if (sample && is_finite(sample->weight)) sum += sample->weight / sample->eta_scale;
  }
  return sum / kSamples;
}

/// The majority of a row of votes, if there is one, in constant memory. [Boyer and Moore 1981]
struct Majority {
  int choice = kNone;
  std::uint32_t lead = 0;

  void vote(int candidate) {
    if (lead == 0) choice = candidate;
    choice == candidate ? ++lead : --lead;
  }
};

/// The sums of an output, or its votes, by pixel and frame.
struct Layer {
  Kind kind;
  OutputInfo info;
  std::vector<Rgb> sums;
  std::vector<Majority> votes;
};

/// Bytes of a layer, a pixel and frame.
std::size_t bytes_of(Kind kind) { return is_id(kind) ? sizeof(Majority) : sizeof(Rgb); }

class SurfaceOutputs final : public Integrator {
 public:
  SurfaceOutputs(std::unique_ptr<Integrator> inner, const std::vector<Kind>& kinds, const Scene& scene,
                 const RenderSettings& render)
      : inner_(std::move(inner)),
        render_(render),
        frames_(static_cast<std::size_t>(scene.frame_count())),
        bytes_(bytes(kinds, render.crop.count(), scene.frame_count())) {
    const std::size_t size = static_cast<std::size_t>(render.crop.count()) * frames_;
    met_.resize(size);
    for (const Kind kind : kinds) {
      Layer& layer = layers_.emplace_back(Layer{kind, surface_outputs()[kind], {}, {}});
      is_id(kind) ? layer.votes.resize(size) : layer.sums.resize(size);
      if (kind == kObject) layer.info.names = scene.object_names;
      if (kind == kMaterial) layer.info.names = scene.material_names;
    }
  }
  static std::size_t bytes(const std::vector<Kind>& kinds, int pixels, int frames) {
    std::size_t each = sizeof(std::uint32_t);
    for (const Kind kind : kinds) each += bytes_of(kind);
    return each * static_cast<std::size_t>(pixels) * static_cast<std::size_t>(frames);
  }

  int iterations() const override { return inner_->iterations(); }
  std::string settings() const override { return inner_->settings(); }

  void iterate(int iteration, const Scene& scene) override {
    inner_->iterate(iteration, scene);
    const StepTimer timer(step_);
    parallel_for(tile_count(render_.crop, kTileSide), 1, [&](std::int64_t t) {
      for_each_pixel_of_tile(render_.crop, kTileSide, static_cast<int>(t),
                             [&](int x, int y) { look(scene, x, y, static_cast<std::uint64_t>(iteration)); });
    });
  }

  std::vector<OutputInfo> outputs() const override {
    std::vector<OutputInfo> all = inner_->outputs();
    for (const Layer& layer : layers_) all.push_back(layer.info);
    return all;
  }

  Image estimate(Frame frame, const std::string& output) const override {
    for (const Layer& layer : layers_)
      if (layer.info.name == output) return is_id(layer.kind) ? ids(layer, frame) : means(layer, frame);
    return inner_->estimate(frame, output);
  }

  Statistics statistics() const override {
    Statistics statistics = inner_->statistics();
    statistics.steps.push_back(step_);
    statistics.bytes += bytes_;
    return statistics;
  }

  bool persist(StateStream& state) override {
    if (!inner_->persist(state)) return false;
    state.value(step_.seconds);
    state.value(met_);
    for (Layer& layer : layers_) state.value(layer.sums), state.value(layer.votes);
    return true;
  }

 private:
  /// Follows one camera ray in all frames.
  void look(const Scene& scene, int x, int y, std::uint64_t iteration) {
    const auto meet = [&](const CameraPath& path) {
      for (const FrameHit& part : scene.accel->partition(path.ray, path.frames)) {
        if (part.hit.missed()) {
          vote(path.pixel, part.frames, [](Kind) { return kNone; });
          continue;
        }
        const Vertex met(scene, path.ray, part, path.diameter(part.hit.t));
        if (is_finite(met.point)) for_each_relief(met, [&](const Vertex& vertex) { add(scene, path, vertex); });
      }
    };
    start_camera_paths(scene, render_, x, y, iteration, meet, [](const CameraPath&) {});
  }

  void add(const Scene& scene, const CameraPath& path, const Vertex& vertex) {
    vertex.frames.for_each([&](Frame f) { ++met_[index(path.pixel, f)]; });
    for (Layer& layer : layers_) {
      const auto sum = [&](FrameSet frames, const Rgb& value) {
        if (is_finite(value)) frames.for_each([&](Frame f) { layer.sums[index(path.pixel, f)] += value; });
      };
      switch (layer.kind) {
        case kNormal: sum(vertex.frames, normal(scene, vertex)); break;
        case kPosition: sum(vertex.frames, position(scene, vertex)); break;
        case kDepth: sum(vertex.frames, Rgb(depth(scene, vertex))); break;
        case kTextureUv: sum(vertex.frames, Rgb(vertex.point.uv.x, vertex.point.uv.y, 0)); break;
        case kAlbedo:
          for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) { sum(frames, albedo(bsdf, vertex, path)); });
          break;
        default: break;
      }
    }
    vote(path.pixel, vertex.frames,
         [&](Kind kind) { return kind == kObject ? vertex.shape.object : vertex.shape.material; });
  }

  /// Counts candidate(Kind) of the layers of ids.
  template <class Candidate>
  void vote(int pixel, FrameSet frames, Candidate&& candidate) {
    for (Layer& layer : layers_)
      if (is_id(layer.kind))
        frames.for_each([&](Frame f) { layer.votes[index(pixel, f)].vote(candidate(layer.kind)); });
  }

  /// The same for all frames of a vertex, since a path has one camera.
  static const Transform& camera_to_world(const Scene& scene, const Vertex& vertex) {
    return scene.camera_to_world[static_cast<std::size_t>(vertex.frames.lowest())];
  }

  /// On the side that is seen.
  Rgb normal(const Scene& scene, const Vertex& vertex) const {
    const SurfacePoint& point = vertex.point;
    Vec3 n = dot(vertex.wo, point.ng) < 0 ? -point.ns : point.ns;
    if (render_.in_camera_space) n = normalize(camera_to_world(scene, vertex).inverse_normal(n));
    return {n.x, n.y, n.z};
  }

  Rgb position(const Scene& scene, const Vertex& vertex) const {
    Vec3 p = vertex.point.p;
    if (render_.in_camera_space) p = camera_to_world(scene, vertex).inverse_point(p);
    return {p.x, p.y, p.z};
  }

  static float depth(const Scene& scene, const Vertex& vertex) {
    const Transform& to_world = camera_to_world(scene, vertex);
    return dot(vertex.point.p - to_world.point({}), normalize(to_world.vector({0, 0, 1})));
  }

  Image means(const Layer& layer, Frame frame) const {
    Image image(render_.crop.width(), render_.crop.height());
    for (int pixel = 0; pixel < render_.crop.count(); ++pixel) {
      const std::size_t at = index(pixel, frame);
      const Rgb none = layer.kind == kDepth ? Rgb(kNoDepth) : Rgb();
      image.pixels[static_cast<std::size_t>(pixel)] =
          met_[at] == 0 ? none : layer.sums[at] / static_cast<float>(met_[at]);
    }
    return image;
  }

  Image ids(const Layer& layer, Frame frame) const {
    std::vector<float> id;
    for (const std::string& name : layer.info.names) id.push_back(id_of(name));
    Image image(render_.crop.width(), render_.crop.height());
    for (int pixel = 0; pixel < render_.crop.count(); ++pixel)
      if (const auto choice = static_cast<std::size_t>(layer.votes[index(pixel, frame)].choice); choice < id.size())
        image.pixels[static_cast<std::size_t>(pixel)] = Rgb(id[choice]);
    return image;
  }

  std::size_t index(int pixel, Frame frame) const {
    return static_cast<std::size_t>(pixel) * frames_ + static_cast<std::size_t>(frame);
  }

  std::unique_ptr<Integrator> inner_;
  RenderSettings render_;
  std::size_t frames_, bytes_;
  std::vector<std::uint32_t> met_;  // camera paths that met a surface, by pixel and frame
  std::vector<Layer> layers_;
  StepTime step_{"surface outputs"};
};

std::vector<Kind> kinds_in(const std::vector<std::string>& names) {
  std::vector<Kind> kinds;
  for (int kind = 0; kind < kKinds; ++kind)
    if (std::find(names.begin(), names.end(), surface_outputs()[static_cast<std::size_t>(kind)].name) != names.end())
      kinds.push_back(static_cast<Kind>(kind));
  return kinds;
}

}  // namespace

const std::vector<OutputInfo>& surface_outputs() {
  static const std::vector<OutputInfo> all = {
      {"N", {"N.X", "N.Y", "N.Z"}, "shading normal of the first surface, on the side that is seen"},
      {"P", {"P.X", "P.Y", "P.Z"}, "its position", true},
      {"Z", {"Z"}, "its depth along the camera's axis, in world units; 1e10: no surface", true},
      {"albedo", {"Albedo.R", "Albedo.G", "Albedo.B"}, "the share of light that it scatters"},
      {"uv", {"u", "v"}, "its texture coordinates", true},
      {"object", {"object.X"}, "the id of the object that most of the pixel shows", true, true},
      {"material", {"material.X"}, "the id of the material that most of the pixel shows", true, true},
  };
  return all;
}

// A bound on memory has room for a copy of the outputs: iterations that are cancelled are reverted to one.
std::unique_ptr<Integrator> with_surface_outputs(const MakeWithin& make, const Scene& scene,
                                                 const RenderSettings& render, std::size_t memory) {
  const std::vector<Kind> asked = kinds_in(render.outputs);
  if (asked.empty()) return make(memory);
  const std::size_t bytes = SurfaceOutputs::bytes(asked, render.crop.count(), scene.frame_count());
  std::unique_ptr<Integrator> inner = make_beside(2 * bytes, make, memory);
  if (inner == nullptr) return nullptr;
  std::vector<Kind> kinds;
  const std::vector<OutputInfo> own = inner->outputs();
  for (const Kind kind : asked)
    if (std::none_of(own.begin(), own.end(), [&](const auto& o) { return o.name == surface_outputs()[kind].name; }))
      kinds.push_back(kind);
  if (kinds.empty()) return inner;
  return std::make_unique<SurfaceOutputs>(std::move(inner), kinds, scene, render);
}

}  // namespace dspm
