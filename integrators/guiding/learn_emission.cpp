#include "dspm/integrators/guiding/learn_emission.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "dspm/base/grid/buffer.h"
#include "dspm/base/grid/counting_sort.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/system/activity.h"
#include "dspm/base/system/parallel.h"
#include "dspm/integrators/guiding/emission_tree.h"
#include "dspm/integrators/guiding/pilot_pixels.h"
#include "dspm/integrators/guiding/visible_beams.h"
#include "dspm/integrators/guiding/visible_points.h"
#include "dspm/world/scene/scene.h"

namespace dspm {
namespace {

// A round has a path for every other pixel, within bounds, and enough for every light to be seen. If many rounds are to
// come, half of the most will do.
constexpr std::int64_t kLeastPaths = 1 << 12, kMostPaths = 1 << 14, kPathsOfALight = 1 << 6, kPathsPerTrace = 1 << 4;
constexpr std::int64_t kLeastLightPaths = 10'000;  // a picture may be small, and what light has to pass smaller
constexpr std::int64_t kFoundAtOnce = 1 << 8;      // by one thread
constexpr std::size_t kTreeBytes = 256 * EmissionGuide::kMostCells;  // while it grows
constexpr double kLeastPilotPixels = 1 << 11, kMostPilotPixels = 1 << 14, kPixelsAPilot = 4, kHitPointsOfAPath = 6;

// If too few paths are found, the search radius begins far larger, and shrinks once enough are.
constexpr float kWidest = 1024, kShrink = 4;
constexpr float kMostRadius = 0.1f;        // of the scene's radius
constexpr std::size_t kLeastPoints = 256;  // that search, however wide
constexpr double kEnough = 0.3, kFew = 0.1;
constexpr std::uint64_t kRoundsOfAView = 4;  // by the same camera paths, each in another frame
constexpr int kWideRounds = 4;               // at most, at each radius

constexpr std::size_t kTrialRounds = 2, kFewRounds = 8, kMostRounds = 16;  // at the final radius
constexpr double kLeastGain = 1.25;    // in time to the same variance, or the guide is off
constexpr double kLeastGrowth = 1.05;  // in paths found, over as many rounds as before
constexpr double kMostOfOne = 0.05;    // of the variance, or the tail is not known yet

class Learner {
 public:
  Learner(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
          const HitPointSettings& hit_point)
      : scene_(sample),
        photon_(photon),
        camera_(hit_point),
        kinds_(photon.kinds),
        pixels_(render, pilot_pixels(static_cast<double>(pixels_of(render)), hit_point.go_on)),
        paths_(paths_of_a_round(render)) {
    photon_.stream = Stream::pilot, photon_.keep_ends = true, photon_.share_paths = true;
    photon_.paths_per_trace = kPathsPerTrace;
    photon_.direct = nullptr;
    photon_.rays_tell = false;  // a light's own photons lead to its caustics, which may be far rarer
    for (const LightChoice& choice : sample.light_choices) choices_ += !choice.frames.empty();
    camera_.sample_direct = camera_.light_media = false, camera_.direct = nullptr, camera_.share_paths = true;
  }

  EmissionGuides learn(PilotPaths& pilot) {
    const PilotRound first = trace_first(pilot);
    EmissionGuides guides = fine(first.found_share() < kFew ? coarse() : EmissionGuides(), first, pilot);
    pilot.rounds = rounds_, pilot.bytes = bytes_;
    return guides;
  }

  /// Traces the first round, without guides.
  PilotRound trace_first(PilotPaths& pilot) {
    PilotRound first = trace({}, 1);
    pilot.rounds = 1, pilot.of_a_round = first.all_paths(), pilot.found_first = first.found.size();
    pilot.count(first, scene_, photon_);
    return first;
  }

 private:
  static std::int64_t pixels_of(const RenderSettings& render) {
    return static_cast<std::int64_t>(render.width) * render.height;
  }

  std::int64_t paths_of_a_round(const RenderSettings& render) const {
    const std::int64_t least = photon_.are_light_paths ? kLeastLightPaths : kLeastPaths,
                       wanted = std::max(pixels_of(render) / 2,
                                         kPathsOfALight * static_cast<std::int64_t>(scene_.lights.size()));
    return std::clamp(wanted, least,
                      std::max(least, rounds_of_all_frames() > kFewRounds ? kMostPaths / 2 : kMostPaths));
  }
  /// Camera paths that go on leave several hit points each.
  static double pilot_pixels(double pixels, bool go_on) {
    return std::clamp(pixels / kPixelsAPilot, kLeastPilotPixels, kMostPilotPixels) / (go_on ? kHitPointsOfAPath : 1);
  }

  // All photons count, even if the integrator stores some kinds only: those that arrive first lead to the others.
  EmissionGuides coarse() {
    const bool rays_light_media = std::exchange(photon_.rays_light_media, false);
    photon_.kinds = kAllPhotons;
    EmissionGuides guides;
    for (float scale = kWidest; scale >= 1; scale /= kShrink) {
      std::vector<PilotRound> rounds;
      for (int i = 0; i < kWideRounds && (i == 0 || rounds.back().found_share() < kEnough); ++i) {
        rounds.push_back(trace(guides, scale));
        guides = guides_after(rounds, 1);
      }
    }
    photon_.kinds = kinds_, photon_.rays_light_media = rays_light_media;
    return guides;
  }

  EmissionGuides fine(EmissionGuides guides, const PilotRound& first, PilotPaths& pilot) {
    const std::size_t least = std::clamp(rounds_of_all_frames(), kFewRounds, kMostRounds);
    std::vector<PilotRound> rounds;
    for (std::size_t fresh = 1; fresh > 0; fresh = std::min(rounds.size(), kMostRounds - rounds.size())) {
      for (std::size_t i = 0; i < fresh; ++i) {
        rounds.push_back(trace(guides, 1));
        if (rounds.size() == kTrialRounds + 1) pilot.gain = gain(rounds.back(), first);
        if (rounds.size() == kTrialRounds + 1 && !(pilot.gain > kLeastGain)) return {};
      }
      guides = guides_after(rounds, fresh);
      if (rounds.size() >= least && rounds.back().share_of_one() < kMostOfOne &&
          rounds.back().found_share() < kLeastGrowth * rounds[rounds.size() - fresh - 1].found_share())
        break;
    }
    pilot.gain = gain(rounds.back(), first);
    pilot.count(rounds.back(), scene_, photon_);
    return guides;
  }

  /// Traces a round. `scale` multiplies the search radius.
  PilotRound trace(const EmissionGuides& guides, float scale) {
    Activity::goes_on();
    look(scale);
    PilotRound round{guides, {}, {}, rounds_, static_cast<std::uint64_t>(paths_), choices_};
    photon_.guides = &guides, photon_.frames = searched_->frames;
    traces_ = trace_photons(scene_, photon_, rounds_, 0, paths_, std::move(traces_));
    find(*searched_, round);
    ++rounds_;
    return round;
  }

  /// The hit points that a round searches.
  struct Searched {
    float scale;
    FrameSet frames;
    VisiblePoints matte, glossy;
  };

  void look(float scale) {
    if (rounds_ % kRoundsOfAView == 0) {
      searched_ = nullptr;
      camera_.frames = {};
      for (std::uint64_t i = 0; i < kRoundsOfAView; ++i) camera_.frames |= frames_of_round(rounds_ + i);
      tiles_ = pixels_.trace(scene_, camera_, kPilotIteration + rounds_);
    }
    const FrameSet frames = frames_of_round(rounds_);
    if (searched_ == nullptr || searched_->scale != scale || searched_->frames != frames)
      searched_ =
          std::make_unique<const Searched>(Searched{scale, frames, visible(&HitPointTile::hit_points, scale, frames),
                                                    visible(&HitPointTile::glossy, scale, frames)});
  }

  /// One of each choice, in turns: those of a view are far apart.
  FrameSet frames_of_round(std::uint64_t round) const {
    FrameSet frames;
    for (const LightChoice& choice : scene_.light_choices) {
      const auto count = static_cast<std::uint64_t>(choice.frames.count());
      if (count == 0) continue;
      const std::uint64_t views = (count + kRoundsOfAView - 1) / kRoundsOfAView;
      const std::uint64_t turn = (round % kRoundsOfAView * views + round / kRoundsOfAView % views) % count;
      std::uint64_t number = 0;
      choice.frames.for_each([&](Frame f) {
        if (number++ == turn) frames |= FrameSet::single(f);
      });
    }
    return frames;
  }
  /// Until each of the sample's frames has had its turn.
  std::size_t rounds_of_all_frames() const {
    int most = 0;
    for (const LightChoice& choice : scene_.light_choices) most = std::max(most, choice.frames.count());
    return static_cast<std::size_t>(most);
  }

  /// Returns the points that can gather photons. Their radii are wider than in a render, because pilot pixels are
  /// further apart than pixels; wide circles need fewer points.
  VisiblePoints visible(std::vector<HitPoint> HitPointTile::*which, float scale, FrameSet frames) const {
    std::size_t count = 0;
    for (const HitPointTile& tile : tiles_) count += (tile.*which).size();
    const std::size_t most = std::max<std::size_t>(count / kLeastPoints, 1);
    return VisiblePoints(tiles_, which, std::max(1.f, 0.5f * static_cast<float>(pixels_.stride)) * scale,
                         kMostRadius * scene_.radius,
                         std::clamp(static_cast<std::size_t>(scale * scale / 4), std::size_t{1}, most), frames);
  }

  void find(const Searched& visible, PilotRound& round) const {
    const std::size_t choices = scene_.light_choices.size();
    const float widened = std::max(1.f, 0.5f * static_cast<float>(pixels_.stride)) * visible.scale;
    const std::vector<double> in_beams =
        squares_in_beams(tiles_, traces_, widened, kMostRadius * scene_.radius, visible.frames);
    std::vector<std::uint64_t> first_path(traces_.size()), first_in_media(traces_.size());
    std::uint64_t paths = 0, in_media = 0;
    for (std::size_t t = 0; t < traces_.size(); ++t) {
      first_path[t] = std::exchange(paths, paths + traces_[t].ends.size());
      first_in_media[t] = std::exchange(in_media, in_media + traces_[t].in_media.size());
    }
    std::vector<std::vector<FoundPath>> found(traces_.size());
    parallel_for(static_cast<std::int64_t>(traces_.size()), 1, [&](std::int64_t t) {
      const PhotonTrace& trace = traces_[static_cast<std::size_t>(t)];
      std::vector<double> squares;  // by path and choice
      std::size_t photon = 0, hidden = 0, curve = 0, medium = 0;
      for (const PhotonTrace::End& end : trace.ends) {
        squares.resize(squares.size() + choices);
        double* const sums = &squares.back() + 1 - choices;
        const auto add = [&](float radiance, FrameSet frames, const HitPoint&) {
          sums[choice_of(frames)] += frames.count() * static_cast<double>(radiance) * static_cast<double>(radiance);
        };
        for (; photon < end.photons; ++photon) visible.matte.for_each_gathering(trace.photons[photon], add);
        for (; hidden < end.hidden; ++hidden) visible.glossy.for_each_gathering(trace.hidden[hidden], add);
        for (; curve < end.on_curves; ++curve) visible.glossy.for_each_gathering(trace.on_curves[curve], add);
        for (; medium < end.in_media; ++medium)
          sums[choice_of(trace.in_media[medium].frames)] +=
              in_beams[first_in_media[static_cast<std::size_t>(t)] + medium];
      }
      for (std::size_t i = 0; i < squares.size(); ++i) {
        const std::size_t choice = i % choices;
        const PathRandom random = numbers_of(photon_, first_path[static_cast<std::size_t>(t)] + i / choices, rounds_);
        if (const double sum = squares[i]; sum > 0 && std::isfinite(sum))
          found[static_cast<std::size_t>(t)].push_back({choice, start_of(&round.guides, scene_, choice, random), sum});
      }
    });
    round.found_of.resize(choices * scene_.lights.size());
    std::vector<std::size_t> first_found(traces_.size());
    std::size_t count = 0;
    for (std::size_t t = 0; t < traces_.size(); ++t) {
      round.work += traces_[t].paths.segments.done + traces_[t].photons.size() + traces_[t].in_media.size();
      first_found[t] = std::exchange(count, count + found[t].size());
    }
    round.found.refit(count);
    parallel_for(static_cast<std::int64_t>(traces_.size()), 1, [&](std::int64_t t) {
      const std::vector<FoundPath>& of_trace = found[static_cast<std::size_t>(t)];
      std::copy(of_trace.begin(), of_trace.end(), round.found.begin() + first_found[static_cast<std::size_t>(t)]);
    });
    for (FoundPath& path : round.found) path.place = round.found_of[kind(path)]++;
  }

  /// Numbers the path's choice and light.
  std::size_t kind(const FoundPath& path) const {
    return path.choice * scene_.lights.size() + static_cast<std::size_t>(path.start.light);
  }

  /// Returns the choice of a photon's frames; all of them have the same.
  std::size_t choice_of(FrameSet frames) const {
    std::size_t choice = 0;
    while ((scene_.light_choices[choice].frames & frames).empty()) ++choice;
    return choice;
  }

  double usual(const FoundPath& path) const {
    return static_cast<double>(
        scene_.light_choices[path.choice].probability()[static_cast<std::size_t>(path.start.light)]);
  }
  /// The scene's factor to a light's share of the paths. Boxes get paths by the square root of the sum of their
  /// records.
  double favour(int light) const { return static_cast<double>(scene_.lights[static_cast<std::size_t>(light)].photons); }
  double density(const EmissionGuides& guides, const FoundPath& path) const {
    return guides.are_off()
               ? usual(path)
               : static_cast<double>(guides.of_choice[path.choice].density(path.start.light, path.start.numbers));
  }

  /// Makes the guides after rounds of which the last `fresh` had the same. A path counts as drawn from the mixture of all
  /// rounds; otherwise paths that were unlikely in their own round would outweigh all others. [Veach 1997, 9.2]
  EmissionGuides guides_after(std::vector<PilotRound>& rounds, std::size_t fresh) {
    std::vector<std::vector<std::uint32_t>> first_of;  // by round and kind: its first record
    for (const PilotRound& round : rounds) first_of.push_back(round.found_of);
    std::vector<std::uint32_t> first_of_kind(rounds.front().found_of.size() + 1);
    turn_into_places(first_of, first_of_kind);
    const std::size_t count = first_of_kind.back(), first_fresh = rounds.size() - fresh;
    rounds[first_fresh].alike = fresh;
    records_.refit(count);
    parallel_for(static_cast<std::int64_t>(rounds.size()), 1, [&](std::int64_t number) {
      const auto r = static_cast<std::size_t>(number);
      parallel_chunks(
          static_cast<std::int64_t>(rounds[r].found.size()), kFoundAtOnce, [&](std::int64_t begin, std::int64_t end) {
            const std::span<FoundPath> some(rounds[r].found.begin() + begin, rounds[r].found.begin() + end);
            for (std::size_t other = r < first_fresh ? first_fresh : 0; other <= first_fresh;
                 other += rounds[other].alike)
              for (FoundPath& path : some)  // inside: a guide stays in the cache
                path.mixture += static_cast<double>(rounds[other].alike) * density(rounds[other].guides, path);
            for (const FoundPath& path : some) {
              const auto own = static_cast<double>(path.start.density), wanted = favour(path.start.light);
              records_[first_of[r][kind(path)] + path.place] = {
                  path.start.light, path.start.numbers, path.squares * own * own / path.mixture * wanted * wanted};
            }
          });
    });
    // The paths, the records, those and others beside them, twice while trees grow, with a box for every four at most.
    bytes_ = std::max(bytes_, bytes_of(tiles_) + bytes_of(traces_) + scene_.accel->memory() +
                                  count * (2 * sizeof(FoundPath) + 7 * sizeof(EmissionRecord)) +
                                  scene_.light_choices.size() * kTreeBytes);
    EmissionGuides guides;
    guides.of_choice.resize(scene_.light_choices.size()), rooms_.resize(guides.of_choice.size());
    parallel_for(static_cast<std::int64_t>(guides.of_choice.size()), 1, [&](std::int64_t i) {
      const std::size_t choice = static_cast<std::size_t>(i), lights = scene_.lights.size(),
                        first = first_of_kind[choice * lights], end = first_of_kind[(choice + 1) * lights];
      guides.of_choice[choice] = guide_from(std::span<EmissionRecord>(records_).subspan(first, end - first),
                                            scene_.light_choices[choice].probability(), rooms_[choice]);
    });
    return guides;
  }

  /// Returns the time to the same variance without a guide, over the time with the round's guide.
  double gain(const PilotRound& round, const PilotRound& without) const {
    double variance = 0, usual_variance = 0;
    for (const FoundPath& path : round.found) {
      variance += path.squares;
      usual_variance += path.squares * static_cast<double>(path.start.density) / usual(path);
    }
    return usual_variance * without.cost() / (variance * round.cost());
  }

  const Scene& scene_;
  PhotonSettings photon_;
  HitPointSettings camera_;
  unsigned kinds_;
  PilotPixels pixels_;
  std::int64_t paths_;         // of a round and choice
  std::uint64_t choices_ = 0;  // of frames of the sample
  std::vector<HitPointTile> tiles_;
  std::unique_ptr<const Searched> searched_;
  std::vector<PhotonTrace> traces_;
  Buffer<EmissionRecord> records_;
  std::vector<GuideRoom> rooms_;  // by choice
  std::uint64_t rounds_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace

EmissionGuides learn_emission(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                              const HitPointSettings& hit_point, PilotPaths& pilot) {
  return Learner(sample, render, photon, hit_point).learn(pilot);
}

void count_found(const Scene& sample, const RenderSettings& render, const PhotonSettings& photon,
                 const HitPointSettings& hit_point, PilotPaths& pilot) {
  Learner(sample, render, photon, hit_point).trace_first(pilot);
}

}  // namespace dspm
