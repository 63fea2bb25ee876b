// An animation changes the document in time. Every channel sets a place of the JSON, so the document of a moment is
// read like any other. [Khronos, glTF 2.0, 3.11 and appendix C; KHR_animation_pointer]
#pragma once

#include <set>
#include <string>
#include <vector>

#include "dspm/lang/gltf/document.h"

namespace dspm::gltf {

class Channel {
 public:
  /// Reads animations/i/channels/j. Throws std::runtime_error.
  Channel(const Document& document, const Value& animation, const Value& channel);

  /// The place that it sets: "/nodes/3/rotation"; empty if it sets nothing.
  const std::string& target() const { return target_; }
  double end() const { return times_.empty() ? 0 : times_.back(); }
  std::vector<double> at(double time) const;
  /// Adds frames, above 0 and before `end`, between which its values go straight on or on an arc, as far as 1/65536 of a
  /// frame allows; curves are cut into short parts.
  void add_corners(double fps, double end, std::set<double>& frames) const;

 private:
  enum class Interpolation { step, linear, spherical, cubic };
  const float* value(std::size_t key) const;

  std::string target_;
  Interpolation interpolation_ = Interpolation::linear;
  std::vector<float> times_, values_;
  std::size_t width_ = 0;  // numbers of one value
};

/// The animations that play: the one of that name or, if it is empty, the first and those that set other places.
struct Animation {
  std::vector<std::string> played, left_out;  // names
  std::vector<Channel> channels;

  double duration() const;
};
Animation choose_animation(const Document& document, const std::string& name);

/// Writes the moment's values into a copy of the document's JSON. What a channel cannot set is left as it is.
void set_moment(Json& json, const Animation& animation, double time);

}  // namespace dspm::gltf
