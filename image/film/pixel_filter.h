// A filter says how a pixel averages the image plane around its centre. Filters are importance-sampled: camera paths
// are distributed around the centre like the filter, and all count equally. Plugins: box, triangle, gaussian, mitchell,
// sinc (pixel_filter.cpp).
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"

namespace dspm {

/// An even density on [-radius, radius], linear between equidistant nodes, sampled by inversion.
class FilterProfile {
 public:
  /// Takes the `weights` at the nodes from -radius to radius: at least two, none of them negative and not all 0.
  FilterProfile(float radius, std::vector<float> weights);
  float sample(float u) const;
  /// The density with which sample() returns this offset.
  float density(float offset) const;
  float radius() const { return radius_; }

 private:
  float radius_;
  std::vector<float> weights_;
  std::vector<float> cumulative_;  // fraction of the mass below each node
};

class PixelFilter {
 public:
  PixelFilter(FilterProfile x, FilterProfile y) : x_(std::move(x)), y_(std::move(y)) {}
  /// The offset from the pixel's centre, in pixels, for two numbers in [0, 1).
  Vec2 sample(Vec2 u) const { return {x_.sample(u.x), y_.sample(u.y)}; }
  /// The density with which sample() returns this offset, by area in pixels.
  float density(Vec2 offset) const { return x_.density(offset.x) * y_.density(offset.y); }
  Vec2 radius() const { return {x_.radius(), y_.radius()}; }

 private:
  FilterProfile x_, y_;
};

using MakePixelFilter = std::unique_ptr<PixelFilter>(ParamReader&);
PluginTable<Plugin<MakePixelFilter>>& pixel_filter_plugins();

}  // namespace dspm
