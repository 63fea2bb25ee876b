#include "dspm/lang/motion.h"

#include <algorithm>
#include <utility>

#include "dspm/base/math/vanishing.h"

namespace dspm {

void Motion::multiply(const Matrix4& matrix) {
  if (factors_.empty() || factors_.back().keyed)
    factors_.push_back({matrix, {}, false});
  else
    factors_.back().fixed = factors_.back().fixed * matrix;
}

void Motion::multiply(KeyedTransform keyed) {
  if (factors_.empty() || factors_.back().keyed) factors_.emplace_back();
  factors_.back().keyed = std::make_shared<const KeyedTransform>(std::move(keyed));
}

Matrix4 Motion::product(std::size_t first, const Matrix4& before, Moment moment) const {
  Matrix4 r;
  for (std::size_t i = first; i < factors_.size(); ++i) {
    r = r * factors_[i].fixed;
    if (factors_[i].keyed) r = r * keyed_at(i, before * r, moment);
  }
  return r;
}

/// What a LookAt names is in the world. Where the world is, as the LookAt sees it, either the factors before it say, or
/// those after it.
Matrix4 Motion::keyed_at(std::size_t factor, const Matrix4& before, Moment moment) const {
  const KeyedTransform& keyed = *factors_[factor].keyed;
  const bool inverted = factors_[factor].inverted;
  Matrix4 from_world;
  if (keyed.is_aimed())
    from_world =
        keyed.places_things() != inverted ? before.inverse().value_or(kZeroMatrix) : product(factor + 1, {}, moment);
  const Matrix4 matrix = keyed.at(moment, from_world);
  return inverted ? matrix.inverse().value_or(kZeroMatrix) : matrix;
}

bool Motion::is_keyed() const { return keyed_count() > 0; }

int Motion::keyed_count() const {
  return static_cast<int>(
      std::count_if(factors_.begin(), factors_.end(), [](const Factor& factor) { return factor.keyed != nullptr; }));
}

std::vector<std::shared_ptr<NamedPlace>> Motion::named_places() const {
  std::vector<std::shared_ptr<NamedPlace>> places;
  for (const Factor& factor : factors_)
    if (factor.keyed && factor.keyed->is_aimed())
      for (const TransformKey& key : factor.keyed->keys())
        for (const TransformOp& op : key.ops)
          for (const std::shared_ptr<NamedPlace>& place : op.places)
            if (place) places.push_back(place);
  return places;
}

Motion Motion::of_camera() const {
  Motion result = *this;
  for (Factor& factor : result.factors_)
    if (factor.keyed) factor.keyed = std::make_shared<const KeyedTransform>(factor.keyed->of_camera());
  return result;
}

Motion Motion::inverse() const {
  Motion result;
  for (auto factor = factors_.rbegin(); factor != factors_.rend(); ++factor) {
    if (factor->keyed) result.factors_.push_back({Matrix4{}, factor->keyed, !factor->inverted});
    result.multiply(factor->fixed.inverse().value_or(kZeroMatrix));
  }
  return result;
}

}  // namespace dspm
