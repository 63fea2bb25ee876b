#include "dspm/integrators/beside/surface_outputs.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/parallel.h"
#include "dspm/image/image.h"
#include "dspm/integrators/beside/coverage_ranks.h"
#include "dspm/integrators/beside/majority.h"
#include "dspm/integrators/beside/make_beside.h"
#include "dspm/integrators/beside/wrapping_integrator.h"
#include "dspm/integrators/pixel_frames.h"
#include "dspm/integrators/possible_state.h"
#include "dspm/integrators/tiles.h"
#include "dspm/integrators/transport/camera_path.h"
#include "dspm/integrators/transport/clear_sight.h"
#include "dspm/integrators/transport/left_in_media.h"
#include "dspm/world/scene/nearby_moments.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

using Kind = SurfaceKind;

constexpr int kTileSide = 16;
constexpr int kNone = Majority::kNone;  // no object, no material
constexpr float kNoDepth = 1e10f;       // where no surface is, as in Blender

bool is_of_objects(Kind kind) { return kind == Kind::object || kind == Kind::crypto_object; }
bool is_mean(Kind kind) { return !is_id(kind) && !is_crypto(kind) && kind != Kind::alpha; }

/// The directional-hemispherical reflectance (and transmittance), or an estimate of it.
Spectrum albedo(const Bsdf& bsdf, const Vertex& vertex, const CameraPath& path) {
  if (const auto f = bsdf.lambertian(bsdf.all_lobes())) return *f * kPi;
  constexpr int kSamples = 4;
  Spectrum sum;
  for (int i = 0; i < kSamples; ++i) {
    PathState other = path;
    other.bounces = i;  // other random numbers
    const auto sample = sample_bsdf(bsdf, other, vertex.wo, Transport::radiance, bsdf.all_lobes());
    if (sample && is_finite(sample->weight)) sum += sample->weight / sample->eta_scale;
  }
  return sum / kSamples;
}

/// The values of a kind: sums, votes or ranks.
struct Layer {
  Kind kind;
  std::vector<OutputInfo> outputs;
  std::vector<float> ids;  // of things
  PixelFrames<Rgb> sums;
  PixelFrames<Rgb> far_sums;  // of motion where no surface is
  PixelFrames<Majority> votes;
  PixelFrames<CoverageRanks> ranks;

  /// Returns its position among the outputs, or outputs.size() if there is none of that name.
  std::size_t find(const std::string& name) const {
    const auto at = std::find_if(outputs.begin(), outputs.end(), [&](const auto& o) { return o.name == name; });
    return static_cast<std::size_t>(at - outputs.begin());
  }
};

/// Media hide what is behind them in part.
bool has_sums(Kind kind, const Scene& scene) { return is_mean(kind) || (kind == Kind::alpha && !scene.media.empty()); }

/// Returns the bytes of a layer per pixel and frame.
std::size_t bytes_of(Kind kind, const Scene& scene) {
  if (has_sums(kind, scene)) return is_motion(kind) ? 2 * sizeof(Rgb) : sizeof(Rgb);
  return is_id(kind) ? sizeof(Majority) : is_crypto(kind) ? sizeof(CoverageRanks) : 0;
}

class SurfaceOutputs final : public WrappingIntegrator {
 public:
  SurfaceOutputs(std::unique_ptr<Integrator> inner, const std::vector<Kind>& kinds, const Scene& scene,
                 const RenderSettings& render)
      : WrappingIntegrator(std::move(inner)),
        render_(render),
        bytes_(bytes(kinds, scene, render)),
        met_(render.crop.count(), scene.frame_count()) {
    const int pixels = render.crop.count(), frames = scene.frame_count();
    looks_on_ = std::any_of(kinds.begin(), kinds.end(), is_for_denoising);
    for (const Kind kind : kinds) {
      Layer& layer = layers_.emplace_back(Layer{kind, outputs_of(kind), {}, {}, {}, {}, {}});
      if (has_sums(kind, scene)) layer.sums = {pixels, frames};
      if (is_motion(kind)) layer.far_sums = {pixels, frames};
      if (is_id(kind)) layer.votes = {pixels, frames};
      if (is_crypto(kind)) layer.ranks = {pixels, frames};
      if (is_id(kind) || is_crypto(kind)) name(layer, is_of_objects(kind) ? scene.object_names : scene.material_names);
    }
  }
  static std::size_t bytes(const std::vector<Kind>& kinds, const Scene& scene, const RenderSettings& render) {
    std::size_t each = sizeof(std::uint32_t);
    for (const Kind kind : kinds) each += bytes_of(kind, scene);
    return each * static_cast<std::size_t>(render.crop.count()) * static_cast<std::size_t>(scene.frame_count());
  }

  void iterate(const Iteration& iteration) override {
    inner_->iterate(iteration);
    ++iterations_;
    const StepTimer timer(step_);
    iteration.for_each_moment([&](const Scene& scene, const MomentPixels& pixels) {
      parallel_for(tile_count(render_.crop, kTileSide), 1, [&](std::int64_t t) {
        ClearSight sight(scene);
        for_each_pixel_of_tile(render_.crop, kTileSide, static_cast<int>(t), [&](int x, int y) {
          if (pixels.contain(x, y)) look(scene, static_cast<std::uint64_t>(iteration.number), sight, x, y);
        });
      });
    });
  }

  std::vector<OutputInfo> outputs() const override {
    std::vector<OutputInfo> all = inner_->outputs();
    for (const Layer& layer : layers_) all.insert(all.end(), layer.outputs.begin(), layer.outputs.end());
    return all;
  }

  Image estimate(Frame frame, const std::string& output) const override {
    for (const Layer& layer : layers_) {
      const std::size_t number = layer.find(output);
      if (number == layer.outputs.size()) continue;
      return image_of([&](int pixel) { return value(layer, number, pixel, frame); });
    }
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
    state.sum(step_.seconds);
    state.sum(met_.values());
    for (Layer& layer : layers_)
      state.sum(layer.sums.values()), state.sum(layer.far_sums.values()), state.sum(layer.votes.values()),
          state.sum(layer.ranks.values());
    state.sum(iterations_);
    expect_iterations(iterations_);
    return true;
  }

 private:
  static void name(Layer& layer, std::span<const std::string> names) {
    for (OutputInfo& output : layer.outputs) output.names = names;
    for (const std::string& name : names) layer.ids.push_back(id_of(name));
  }

  /// Follows one camera ray in all frames.
  void look(const Scene& scene, std::uint64_t iteration, ClearSight& sight, int x, int y) {
    const auto meet = [&](const CameraPath& path) {
      for (const FrameHit& part : scene.accel->partition(path.ray, path.frames)) {
        if (part.hit.missed()) {
          vote(path.pixel, part.frames, [](Kind) { return kNone; });
          if (!scene.media.empty()) add_veil(scene, path, part.frames);
          add_far_motion(scene, path, part.frames);
          if (looks_on_) add_nothing(path.pixel, part.frames, Rgb(1));
          continue;
        }
        const Vertex met(scene, path.ray, part, path.diameter(part.hit.t));
        if (is_finite(met.point))
          for_each_relief(met, [&](const Vertex& vertex) {
            add(scene, path, vertex);
            if (looks_on_) look_on(scene, sight, path, vertex);
          });
      }
    };
    start_camera_paths(scene, render_, x, y, iteration, meet, [](const CameraPath&) {});
  }

  /// A share of light: its three components count alike, whatever colours they are.
  static Rgb taken(const Spectrum& share) { return {share[0], share[1], share[2]}; }
  /// Adds the share of the light from beyond that media take.
  void add_veil(const Scene& scene, const CameraPath& path, FrameSet frames) {
    for (Layer& layer : layers_) {
      if (layer.kind != Kind::alpha) continue;
      frames.for_each([&](Frame f) { layer.sums.at(path.pixel, f) += Rgb(1); });
      for (const FrameFactor& left :
           left_in_media(scene, path.ray, path.inside.medium, frames, {path.random, path.bounces}))
        left.frames.for_each([&](Frame f) { layer.sums.at(path.pixel, f) += taken(left.factor) * -1.f; });
    }
  }

  void look_on(const Scene& scene, ClearSight& sight, const CameraPath& start, const Vertex& first) {
    sight.follow(
        start, first,
        [&](const CameraPath& path, const Vertex& vertex, const Bsdf& bsdf) {
          const bool shines = vertex.shape.light >= 0;  // regardless of what it scatters
          add_for_denoising(
              path.pixel, path.frames, normal(scene, vertex), depth(scene, vertex, start.ray.at(path.length)),
              scene.palette->seen(shines ? path.throughput : path.throughput * albedo(bsdf, vertex, path)));
        },
        [&](const CameraPath& path, FrameSet frames) {
          add_nothing(path.pixel, frames, scene.palette->seen(path.throughput));
        });
  }

  void add_nothing(int pixel, FrameSet frames, const Rgb& left) {
    add_for_denoising(pixel, frames, Rgb(), std::nullopt, left);
  }

  void add_for_denoising(int pixel, FrameSet frames, const Rgb& normal, std::optional<float> depth, const Rgb& albedo) {
    for (Layer& layer : layers_) {
      const auto sum = [&](const Rgb& value) {
        if (is_finite(value)) frames.for_each([&](Frame f) { layer.sums.at(pixel, f) += value; });
      };
      switch (layer.kind) {
        case Kind::denoising_normal: sum(normal); break;
        case Kind::denoising_depth:
          if (depth) sum(Rgb(*depth, 1, 0));
          break;
        case Kind::denoising_albedo: sum(albedo); break;
        default: break;
      }
    }
  }

  void add(const Scene& scene, const CameraPath& path, const Vertex& vertex) {
    vertex.frames.for_each([&](Frame f) { ++met_.at(path.pixel, f); });
    for (Layer& layer : layers_) {
      const auto sum = [&](FrameSet frames, const Rgb& value) {
        if (is_finite(value)) frames.for_each([&](Frame f) { layer.sums.at(path.pixel, f) += value; });
      };
      switch (layer.kind) {
        case Kind::normal: sum(vertex.frames, normal(scene, vertex)); break;
        case Kind::position: sum(vertex.frames, position(scene, vertex)); break;
        case Kind::depth: sum(vertex.frames, Rgb(depth(scene, vertex, vertex.point.p))); break;
        case Kind::catcher: sum(vertex.frames, Rgb(scene.is_catcher(vertex.hit.shape) ? 1.f : 0.f)); break;
        case Kind::motion_forward:
        case Kind::motion_backward:
          add_motion(layer.kind, layer.sums, path.pixel, vertex.frames,
                     [&](Frame f, Nearby when) { return scene.nearby->of_point(vertex.hit, vertex.point.p, f, when); });
          break;
        case Kind::uv: sum(vertex.frames, Rgb(vertex.point.uv.x, vertex.point.uv.y, 0)); break;
        case Kind::albedo:
          for_each_surface(vertex, [&](FrameSet frames, const Bsdf& bsdf) {
            sum(frames, scene.palette->seen(albedo(bsdf, vertex, path)));
          });
          break;
        default: break;
      }
    }
    vote(path.pixel, vertex.frames,
         [&](Kind kind) { return is_of_objects(kind) ? vertex.shape.object : vertex.shape.material; });
  }

  /// Adds vector_of(Frame, Nearby) and the number of such vectors.
  template <class VectorOf>
  static void add_motion(Kind kind, PixelFrames<Rgb>& sums, int pixel, FrameSet frames, const VectorOf& vector_of) {
    const Nearby when = kind == Kind::motion_forward ? Nearby::later : Nearby::earlier;
    frames.for_each([&](Frame f) {
      if (const NearbyMoments::Vector v = vector_of(f, when)) sums.at(pixel, f) += Rgb(v->x, v->y, 1);
    });
  }

  void add_far_motion(const Scene& scene, const CameraPath& path, FrameSet frames) {
    for (Layer& layer : layers_)
      if (is_motion(layer.kind))
        add_motion(layer.kind, layer.far_sums, path.pixel, frames,
                   [&](Frame f, Nearby when) { return scene.nearby->of_direction(path.ray.direction, f, when); });
  }

  /// Counts candidate(Kind) of the layers of ids.
  template <class Candidate>
  void vote(int pixel, FrameSet frames, Candidate&& candidate) {
    for (Layer& layer : layers_) {
      if (is_id(layer.kind)) frames.for_each([&](Frame f) { layer.votes.at(pixel, f).vote(candidate(layer.kind)); });
      if (!is_crypto(layer.kind)) continue;
      if (const int thing = candidate(layer.kind); thing != kNone)
        frames.for_each([&](Frame f) { layer.ranks.at(pixel, f).add(thing); });
    }
  }

  /// Returns the matrix of the vertex's frames; they have the same one, since a path has one camera.
  static const Transform& camera_to_world(const Scene& scene, const Vertex& vertex) {
    return scene.camera_to_world[static_cast<std::size_t>(vertex.frames.lowest())];
  }

  /// Returns the normal on the side that is seen.
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

  /// Returns the depth of a point that the vertex's camera sees.
  static float depth(const Scene& scene, const Vertex& vertex, const Vec3& p) {
    const Transform& to_world = camera_to_world(scene, vertex);
    return dot(p - to_world.point({}), normalize(to_world.vector({0, 0, 1})));
  }

  /// Returns the value of an output of the layer.
  Rgb value(const Layer& layer, std::size_t number, int pixel, Frame frame) const {
    if (layer.kind == Kind::alpha) {
      const Rgb veil = layer.sums.empty() ? Rgb() : layer.sums.at(pixel, frame) / static_cast<float>(iterations_);
      return Rgb(std::clamp(share(met_.at(pixel, frame)) + (veil.r + veil.g + veil.b) / 3, 0.f, 1.f));
    }
    if (layer.kind == Kind::denoising_depth) return depth_for_denoising(layer.sums.at(pixel, frame));
    if (is_motion(layer.kind))
      return mean_vector(met_.at(pixel, frame) > 0 ? layer.sums.at(pixel, frame) : layer.far_sums.at(pixel, frame));
    if (layer.kind == Kind::catcher || is_for_denoising(layer.kind))
      return layer.sums.at(pixel, frame) / static_cast<float>(iterations_);
    if (is_crypto(layer.kind)) {
      const CoverageRanks::Share of = layer.ranks.at(pixel, frame).sorted()[number];
      return of.paths == 0 ? Rgb() : Rgb(layer.ids[static_cast<std::size_t>(of.thing)], share(of.paths), 0);
    }
    if (is_id(layer.kind)) {
      const auto choice = static_cast<std::size_t>(layer.votes.at(pixel, frame).choice);
      return choice < layer.ids.size() ? Rgb(layer.ids[choice]) : Rgb();
    }
    if (met_.at(pixel, frame) == 0) return layer.kind == Kind::depth ? Rgb(kNoDepth) : Rgb();
    return layer.sums.at(pixel, frame) / static_cast<float>(met_.at(pixel, frame));
  }
  /// Takes the sum of depths, and their number.
  static Rgb depth_for_denoising(const Rgb& sum) { return Rgb(sum.g > 0 ? sum.r / sum.g : kNoDepth); }
  /// Takes the sum of vectors, and their number.
  static Rgb mean_vector(const Rgb& sum) { return sum.b > 0 ? sum / sum.b : Rgb(); }
  /// Returns a share of the pixel's camera paths.
  float share(std::uint32_t paths) const { return static_cast<float>(paths) / static_cast<float>(iterations_); }

  template <class Value>
  Image image_of(Value&& value) const {
    Image image(render_.crop.width(), render_.crop.height());
    for (int pixel = 0; pixel < render_.crop.count(); ++pixel)
      image.pixels[static_cast<std::size_t>(pixel)] = value(pixel);
    return image;
  }

  RenderSettings render_;
  std::size_t bytes_;
  bool looks_on_;                   // for surfaces behind smooth ones
  PixelFrames<std::uint32_t> met_;  // camera paths that met a surface
  std::vector<Layer> layers_;
  int iterations_ = 0;
  StepTime step_{"surface outputs"};
};

/// Returns the kinds that have an output of such a name.
std::vector<Kind> kinds_in(const std::vector<std::string>& names) {
  std::vector<Kind> kinds;
  for (int number = 0; number < kSurfaceKinds; ++number) {
    const auto kind = static_cast<Kind>(number);
    const bool asked = std::any_of(outputs_of(kind).begin(), outputs_of(kind).end(), [&](const OutputInfo& output) {
      return std::find(names.begin(), names.end(), output.name) != names.end();
    });
    if (asked) kinds.push_back(kind);
  }
  return kinds;
}

}  // namespace

// A bound on memory has room for a copy of the outputs: iterations that are cancelled are reverted to one.
std::unique_ptr<Integrator> with_surface_outputs(const MakeWithin& make, const Scene& scene,
                                                 const RenderSettings& render, std::size_t memory) {
  const std::vector<Kind> asked = kinds_in(render.outputs);
  if (asked.empty()) return make(memory);
  const std::size_t bytes = SurfaceOutputs::bytes(asked, scene, render);
  std::unique_ptr<Integrator> inner = make_beside(2 * bytes, make, memory);
  if (inner == nullptr) return nullptr;
  std::vector<Kind> kinds;
  const std::vector<OutputInfo> own = inner->outputs();
  for (const Kind kind : asked)
    if (std::none_of(own.begin(), own.end(), [&](const auto& o) { return o.name == outputs_of(kind).front().name; }))
      kinds.push_back(kind);
  if (kinds.empty()) return inner;
  return std::make_unique<SurfaceOutputs>(std::move(inner), kinds, scene, render);
}

}  // namespace dspm
