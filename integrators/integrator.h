// A light transport algorithm that improves with every iteration, for all frames of an interval at once. The session
// (session/session.h) owns the stop rule and asks for iterations; its observer shows progress and writes images.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dspm/base/math/frames.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/image/film/pixel_filter.h"
#include "dspm/image/film/pixel_rect.h"
#include "dspm/image/image.h"
#include "dspm/integrators/iteration.h"
#include "dspm/integrators/output_info.h"
#include "dspm/integrators/statistics.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

class FileSample;

/// What traces paths. On all but the CPU photons are traced in waves, or the integrator reports why they are not; so are camera
/// paths if photons bring all light to their hit points. Images are the same.
enum class Device {
  cpu,
  waves,     // the CPU as if it were a GPU
  gpu,       // or it is an error
  automatic  // a GPU if there is one and if the scene and the integrator suit it
};

/// The settings of the job that do not depend on the integrator.
struct RenderSettings {
  int width = 0, height = 0;  // of the full image
  PixelRect crop;             // the rendered area
  std::shared_ptr<const PixelFilter> filter;
  bool jitter = true;                // false: every camera path through the pixel's centre
  bool filter_textures = true;       // false: lookups of camera paths do not average over a footprint
  bool noise_per_frame = false;      // camera paths draw other numbers where the camera is in another state
  bool independent_numbers = false;  // of all other paths; else even among them
  Device device = Device::cpu;
  bool spectral = false;  // each iteration has wavelengths, and a palette of its own
  std::uint64_t seed = 0;
  int default_iterations = 256;      // if the integrator's parameters set none
  std::size_t memory = 0;            // bytes that the integrator may hold, or it throws NotEnoughMemory; 0: no bound
  std::vector<std::string> outputs;  // to be written next to radiance
  bool transparent = false;          // no camera path sees lights infinitely far away before it meets a surface
  bool in_camera_space = false;      // outputs that are positions or normals; else in world space
  std::shared_ptr<FileSample> file;  // for what an integrator learns; may be null
  bool count_found =
      false;  // count for Statistics::emission which photon paths are found, even if none are learned from
  bool learn_at_once = false;  // not before the first iteration: Statistics::emission is wanted now
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// The number of iterations that the scene asks for; 0 if it runs until it is stopped.
  virtual int iterations() const = 0;
  /// The settings that matter to the user, in words, for the log: "300000 photons, ...".
  virtual std::string settings() const = 0;
  /// Advances all frames by one iteration; iterations count from 0 and come in order, without gaps except for those
  /// that other machines do (why_not_in_parts). What an integrator makes once, such as photonmap's maps, it makes from
  /// the first iteration's scene. May throw; persist() can then load the state saved before, which is also how a session
  /// undoes a cancelled iteration.
  virtual void iterate(const Iteration& iteration) = 0;
  /// The images that it gives of every frame, radiance first.
  virtual std::vector<OutputInfo> outputs() const { return {radiance_output()}; }
  /// Returns one of its outputs over the crop, in one frame of the interval, after the completed iterations. Outputs
  /// other than radiance are only asked for if RenderSettings::outputs names them.
  virtual Image estimate(Frame frame, const std::string& output = kRadiance) const = 0;
  /// Work and time so far.
  virtual Statistics statistics() const = 0;
  /// Counts, saves or loads the state between iterations, so that another integrator of the same scene and settings
  /// continues from there, bit for bit. Returns false if it does not support checkpoints.
  virtual bool persist(StateStream&) { return false; }
  /// Returns an empty string if machines can share out its iterations: if each is a function of its number and not of
  /// what others left, and persist() names what adds up over them (StateStream::sum). Otherwise returns the reason.
  virtual std::string why_not_in_parts() const {
    return "it does not say that they add up (Integrator::why_not_in_parts)";
  }
};

/// `scene` outlives the integrator.
using MakeIntegrator = std::unique_ptr<Integrator>(ParamReader&, const Scene&, const RenderSettings&);
struct IntegratorPlugin : Plugin<MakeIntegrator> {
  int frames_together = kMaxFrames;  // in one scene; 1 for an integrator that does not share work
  bool sees_media = false;           // else scenes with media are refused
  bool sees_moments = false;         // of one iteration: Iteration::moments
  bool traces_waves = false;         // it heeds RenderSettings::device; else that is cpu
};
PluginTable<IntegratorPlugin>& integrator_plugins();

}  // namespace dspm
