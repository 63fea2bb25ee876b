#include "dspm/world/objects/nearby_changes.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <typeinfo>
#include <utility>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/transform.h"
#include "dspm/shapes/triangle_mesh.h"
#include "dspm/world/objects/placement.h"
#include "dspm/world/objects/placement_check.h"

namespace dspm {
namespace {

constexpr std::array kBoth{Nearby::later, Nearby::earlier};

/// Returns the frame of the same variation at that moment; nullopt if the file has none.
std::optional<FileFrame> frame_of(const FileFrames& file, FileFrame frame, Nearby when) {
  const int moment = file.moment_index(frame) + (when == Nearby::later ? 1 : -1);
  if (moment < 0 || moment >= file.moments()) return std::nullopt;
  return file.frame(static_cast<int>(file.combination_of(frame)), moment);
}

class Finder {
 public:
  Finder(const SceneDescription& description, std::span<const FileFrame> frames)
      : description_(description), frames_(frames) {}

  /// `states` are all states of the scene's shape `number`, which is one of them.
  void add(int number, const WorldShape& shape, std::span<const WorldShape* const> states) {
    const FileFrames& file = description_.frames;
    const bool moves = dspm::moves(*shape.use, shape.instance), deforms = differ(states);
    if (!moves && !deforms) return;
    for (Frame j = 0; j < static_cast<Frame>(frames_.size()); ++j) {
      const FileFrame f = frames_[static_cast<std::size_t>(j)];
      if (!shape.present.contains(f)) continue;
      for (const Nearby when : kBoth) {
        const std::optional<FileFrame> other = frame_of(file, f, when);
        const WorldShape* const then = deforms && other ? state_in(*other, states) : nullptr;
        if (then != nullptr && then->shape != shape.shape && have_the_same_primitives(shape, *then))
          changes_.push_back({number, j, when, {}, &then->placed});
        else if (moves)
          add_moved(number, shape, j, when);
      }
    }
  }
  /// Returns what was found, in the order that NearbyMoments expects.
  std::vector<NearbyMoments::Change> take() {
    const auto place = [](const auto& change) { return std::tuple(change.shape, change.frame, change.when); };
    std::sort(changes_.begin(), changes_.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    return std::move(changes_);
  }

 private:
  static bool differ(std::span<const WorldShape* const> states) {
    return std::any_of(states.begin(), states.end(),
                       [&](const WorldShape* state) { return state->shape != states.front()->shape; });
  }
  static const WorldShape* state_in(FileFrame frame, std::span<const WorldShape* const> states) {
    const auto found = std::find_if(states.begin(), states.end(),
                                    [&](const WorldShape* state) { return state->present.contains(frame); });
    return found == states.end() ? nullptr : *found;
  }

  bool have_the_same_primitives(const WorldShape& a, const WorldShape& b) {
    if (a.is_unread || b.is_unread) return false;
    const auto [known, is_new] = same_.try_emplace(std::minmax(a.shape.get(), b.shape.get()));
    if (!is_new) return known->second;
    const TriangleMesh *const mesh = a.shape->triangles(), *const other = b.shape->triangles();
    if (mesh != nullptr && other != nullptr) return known->second = mesh->faces() == other->faces();
    // Those that turn, curves, are numbered by their places.
    const Shape &one = *a.shape, &two = *b.shape;
    return known->second = typeid(one) == typeid(two) && !one.turns() && one.primitive_count() == two.primitive_count();
  }

  void add_moved(int number, const WorldShape& shape, Frame frame, Nearby when) {
    const Moment moment =
        description_.frames.moment(frames_[static_cast<std::size_t>(frame)], blurs(*shape.use, shape.instance));
    const Matrix4 now = matrix_at(moment, *shape.use, shape.instance);
    const Matrix4 then = matrix_at(moment_of(moment, when), *shape.use, shape.instance);
    if (now == then || !is_sound(then)) return;
    if (const auto inverse = now.inverse()) changes_.push_back({number, frame, when, then * *inverse});
  }

  const SceneDescription& description_;
  const std::span<const FileFrame> frames_;
  std::vector<NearbyMoments::Change> changes_;
  std::map<std::pair<const Shape*, const Shape*>, bool> same_;
};

}  // namespace

std::vector<NearbyMoments::Change> nearby_changes(const SceneDescription& description, const Geometry& geometry,
                                                  const std::vector<const WorldShape*>& shapes,
                                                  std::span<const FileFrame> frames) {
  Finder finder(description, frames);
  std::map<const WorldShape*, int> numbers;  // in the scene, which may list what stays first
  for (const WorldShape* shape : shapes) numbers.emplace(shape, static_cast<int>(numbers.size()));
  std::vector<const WorldShape*> states;  // of one shape: they follow one another
  const auto finish = [&] {
    for (const WorldShape* state : states)
      if (const auto found = numbers.find(state); found != numbers.end()) finder.add(found->second, *state, states);
    states.clear();
  };
  for (const WorldShape& shape : geometry.shapes()) {
    if (!states.empty() && states.front()->placed.cutout_key != shape.placed.cutout_key) finish();
    states.push_back(&shape);
  }
  finish();
  return finder.take();
}

std::vector<FileFrame> with_nearby(const FileFrames& file, std::span<const FileFrame> frames) {
  std::vector<FileFrame> all(frames.begin(), frames.end());
  for (const FileFrame frame : frames)
    for (const Nearby when : kBoth)
      if (const auto other = frame_of(file, frame, when)) all.push_back(*other);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace dspm
