// A sample of the whole file, for what integrators learn before their first iteration: whichever frames are rendered,
// they learn the same.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/integrators/emission_report.h"
#include "dspm/integrators/guiding/learn_direct.h"
#include "dspm/integrators/photons/emission_guide.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// The guides and figures that integrators with the same settings learn and share.
struct LearnedEmission {
  EmissionGuides guides;
  LearnedDirect direct;
  PhotonsBring bring = PhotonsBring::all;
  std::int64_t traced = 0;  // photon paths in an iteration, if they do not bring all light
  std::size_t bytes_while_learning = 0;
  std::int32_t lights = 0;
  EmissionReport report;
};

class FileSample {
 public:
  using MakeScene = std::function<std::unique_ptr<Scene>()>;
  using Learned = std::map<std::string, std::shared_ptr<const LearnedEmission>>;  // by names of settings
  /// Takes a few frames, spread over the file; `make` returns their scene.
  FileSample(std::vector<FileFrame> frames, MakeScene make) : frames_(std::move(frames)), make_(std::move(make)) {}
  /// Learns nothing: `known` comes from an earlier state of the file.
  explicit FileSample(Learned known) : known_(std::move(known)) {}

  /// Returns the scene of these frames, whole: `given`, if it is that. All who hold it at the same time share one. It is one
  /// in RGB: what is learned may not depend on the iteration in which it is.
  std::shared_ptr<const Scene> scene(const Scene& given) const {
    if (!learns()) return {std::shared_ptr<const Scene>(), &given};
    if (given.file_frames == frames_ && !given.is_without_objects && given.palette->is_rgb())
      return {std::shared_ptr<const Scene>(), &given};
    std::shared_ptr<const Scene> scene = made_.lock();
    if (scene == nullptr) made_ = scene = make_();
    return scene;
  }
  /// Returns what learn() returns, for settings of that name: the integrators of later frame intervals need not learn
  /// again.
  template <class Learn>
  std::shared_ptr<const LearnedEmission> emission(const std::string& settings, Learn&& learn) {
    if (const auto found = known_.find(settings); found != known_.end()) return found->second;
    auto learned = std::make_shared<const LearnedEmission>(learn());  // may be cancelled
    return known_[settings] = std::move(learned);
  }
  bool learns() const { return make_ != nullptr; }
  /// Returns what was learned of an earlier state that had as many lights, else null.
  std::shared_ptr<const LearnedEmission> earlier(const std::string& settings, const Scene& scene) const;
  const Learned& learned() const { return known_; }
  /// The bytes of all that was learned.
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& [settings, known] : known_) sum += known->guides.bytes();
    return sum;
  }
  bool has_learned() const;
  /// Saves or loads guides and their reports, but not what was only counted.
  void persist(StateStream& state);
  /// From now on, no other guide may be learned. `digest` is that of what was loaded.
  void take_as_given(std::uint64_t digest) { given_ = digest; }
  std::optional<std::uint64_t> given() const { return given_; }
  /// Throws UsageError if guides are given, but none for these settings and lights.
  void expect_known(const std::string& settings, std::size_t lights);
  /// Returns whether anyone asked for a guide that is given.
  bool is_used() const { return is_used_; }
  /// Forgets all that was learned, to measure a run with all that it takes.
  void forget() { known_.clear(); }

 private:
  std::vector<FileFrame> frames_;
  MakeScene make_;
  mutable std::weak_ptr<const Scene> made_;
  Learned known_;
  std::optional<std::uint64_t> given_;
  bool is_used_ = false;
};

}  // namespace dspm
