#include "dspm/lang/gltf/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "dspm/lang/gltf/accessor.h"

namespace dspm::gltf {
namespace {

std::string target_of(const Value& channel) {
  const Value target = channel["target"];
  const std::string path = target["path"].text("");
  if (path == "pointer") return target.extension("KHR_animation_pointer")["pointer"].text("");
  return target["node"].exists() ? fmt::format("/nodes/{}/{}", target["node"].count(0), path) : "";
}

/// Interpolates quaternions. [appendix C.4]
std::vector<double> slerp(const float* a, const float* b, double t) {
  double cosine = 0;
  for (int c = 0; c < 4; ++c) cosine += double{a[c]} * b[c];
  const double sign = cosine < 0 ? -1 : 1, angle = std::acos(std::min(1.0, std::abs(cosine)));
  const double of_a = angle < 1e-6 ? 1 - t : std::sin((1 - t) * angle) / std::sin(angle);
  const double of_b = angle < 1e-6 ? t : std::sin(t * angle) / std::sin(angle);
  std::vector<double> result(4);
  for (std::size_t c = 0; c < 4; ++c) result[c] = of_a * a[c] + sign * of_b * b[c];
  return result;
}

/// Returns the value that a JSON pointer names, if its parent is there; null otherwise. Arrays do not grow.
Json* place_of(Json& json, const std::string& pointer) {
  Json* place = &json;
  for (std::size_t at = 0; at < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    const std::string key = pointer.substr(at + 1, end - at - 1);
    at = end;
    if (place->is_array()) {
      if (key.empty() || key.size() > 9 || key.find_first_not_of("0123456789") != key.npos) return nullptr;
      const auto index = static_cast<std::size_t>(std::stoul(key));
      if (index >= place->size()) return nullptr;
      place = &(*place)[index];
    } else if (place->is_object() || place->is_null()) {
      place = &(*place)[key];
    } else {
      return nullptr;
    }
  }
  return place;
}

}  // namespace

Channel::Channel(const Document& document, const Value& animation, const Value& channel) : target_(target_of(channel)) {
  const Value samplers = animation["samplers"];
  const Value sampler = samplers[channel["sampler"].required_index(samplers.size())];
  const std::size_t accessors = document["accessors"].size();
  times_ = numbers_of(document, sampler["input"].required_index(accessors)).values;
  values_ = numbers_of(document, sampler["output"].required_index(accessors)).values;
  const std::string how = sampler["interpolation"].text("LINEAR");
  if (how == "CUBICSPLINE")
    interpolation_ = Interpolation::cubic;
  else if (how == "STEP" || target_.ends_with("/visible"))
    interpolation_ = Interpolation::step;
  else if (how == "LINEAR")
    interpolation_ = target_.starts_with("/nodes/") && target_.ends_with("/rotation") ? Interpolation::spherical
                                                                                      : Interpolation::linear;
  else
    sampler["interpolation"].fail("no such interpolation");
  const std::size_t keys = times_.size() * (interpolation_ == Interpolation::cubic ? 3 : 1);
  if (keys == 0 || values_.size() % keys != 0 || values_.empty())
    sampler.fail(fmt::format("{} values for {} times", values_.size(), times_.size()));
  width_ = values_.size() / keys;
  if (interpolation_ == Interpolation::spherical && width_ != 4) sampler.fail("a rotation has 4 numbers");
  if (!std::is_sorted(times_.begin(), times_.end())) sampler["input"].fail("times must ascend");
}

const float* Channel::value(std::size_t key) const {
  return values_.data() + (interpolation_ == Interpolation::cubic ? 3 * key + 1 : key) * width_;
}

std::vector<double> Channel::at(double time) const {
  const auto after = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), static_cast<float>(time)) -
                                              times_.begin());
  const auto whole = [&](std::size_t key) { return std::vector<double>(value(key), value(key) + width_); };
  if (after == 0) return whole(0);
  if (after == times_.size() || interpolation_ == Interpolation::step) return whole(after - 1);
  const std::size_t before = after - 1;
  const double step = double{times_[after]} - times_[before], t = (time - times_[before]) / step;
  const float *const a = value(before), *const b = value(after);
  if (interpolation_ == Interpolation::spherical) return slerp(a, b, t);
  std::vector<double> result(width_);
  for (std::size_t c = 0; c < width_; ++c) {
    if (interpolation_ == Interpolation::linear) {
      result[c] = (1 - t) * a[c] + t * b[c];
      continue;
    }
    const double leaves = step * a[width_ + c], arrives = step * (b - width_)[c];  // tangents [appendix C.5]
    result[c] = (2 * t * t * t - 3 * t * t + 1) * a[c] + (t * t * t - 2 * t * t + t) * leaves +
                (3 * t * t - 2 * t * t * t) * b[c] + (t * t * t - t * t) * arrives;
  }
  return result;
}

void Channel::add_corners(double fps, double end, std::set<double>& frames) const {
  constexpr double kFineness = 65536, kLeeway = 1e-3;  // of the language's moments
  constexpr double kPartsOfCurves = 4;                 // of a frame
  const auto add = [&](double frame) {
    if (frame > 0 && frame < end) frames.insert(frame);
  };
  for (const float time : times_) {
    const double frame = std::ceil(double{time} * fps * kFineness - kLeeway) / kFineness;
    add(frame);
    if (interpolation_ == Interpolation::step) add(frame - 1 / kFineness);
  }
  if (interpolation_ != Interpolation::cubic) return;
  const double first = std::max(0., std::ceil(double{times_.front()} * fps * kPartsOfCurves)),
               last = std::min(end, this->end() * fps) * kPartsOfCurves;
  for (double part = first; part < last; ++part) add(part / kPartsOfCurves);
}

double Animation::duration() const {
  double duration = 0;
  for (const Channel& channel : channels) duration = std::max(duration, channel.end());
  return duration;
}

Animation choose_animation(const Document& document, const std::string& name) {
  Animation chosen;
  std::set<std::string> taken;
  const Value animations = document["animations"];
  for (std::size_t i = 0; i < animations.size(); ++i) {
    const std::string own = animations[i]["name"].text(fmt::format("animation {}", i + 1));
    std::vector<Channel> channels;
    for (std::size_t j = 0; j < animations[i]["channels"].size(); ++j)
      channels.emplace_back(document, animations[i], animations[i]["channels"][j]);
    const bool fits = name.empty() ? std::none_of(channels.begin(), channels.end(),
                                                  [&](const Channel& c) { return taken.contains(c.target()); })
                                   : name == own;
    if (!fits) {
      chosen.left_out.push_back(own);
      continue;
    }
    chosen.played.push_back(own);
    for (Channel& channel : channels) {
      if (channel.target().empty()) continue;
      taken.insert(channel.target());
      chosen.channels.push_back(std::move(channel));
    }
  }
  return chosen;
}

void set_moment(Json& json, const Animation& animation, double time) {
  for (const Channel& channel : animation.channels) {
    Json* const place = place_of(json, channel.target());
    if (place == nullptr) continue;
    const std::vector<double> value = channel.at(time);
    if (channel.target().ends_with("/visible"))
      *place = value.front() != 0;
    else if (value.size() == 1 && !channel.target().ends_with("/weights"))
      *place = value.front();
    else
      *place = value;
  }
}

}  // namespace dspm::gltf
