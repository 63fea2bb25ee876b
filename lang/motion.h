// The placement of a thing over time: a product of fixed matrices and keyed transforms.
#pragma once

#include <memory>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/transform.h"
#include "dspm/lang/keyed_transform.h"

namespace dspm {

/// The placement of a shape, light or camera over the whole animation.
class Motion {
 public:
  Motion() = default;
  explicit Motion(const Matrix4& fixed) : factors_{{fixed, {}, false}} {}

  /// Multiplies from the right, as directives in a scene file do.
  void multiply(const Matrix4& matrix);
  void multiply(KeyedTransform keyed);
  void multiply(const Motion& next) { factors_.insert(factors_.end(), next.factors_.begin(), next.factors_.end()); }

  /// All zeros if no inverse exists at that moment.
  Matrix4 at(Moment moment) const { return product(0, {}, moment); }
  bool is_keyed() const;
  /// The number of keyed transforms in the product.
  int keyed_count() const;
  /// What its LookAts name.
  std::vector<std::shared_ptr<NamedPlace>> named_places() const;
  /// The same for a camera, see KeyedTransform.
  Motion of_camera() const;
  /// The motion that undoes this one at every moment.
  Motion inverse() const;
  /// Compares the products as they were composed: equal motions that were composed differently need not be equal.
  friend bool operator==(const Motion&, const Motion&) = default;

 private:
  struct Factor {
    Matrix4 fixed;                                // applied to the left of `keyed`
    std::shared_ptr<const KeyedTransform> keyed;  // may be null; shared by everything in a block
    bool inverted = false;                        // means the inverse of `keyed`
    friend bool operator==(const Factor&, const Factor&) = default;
  };

  /// Of the factors from `first` on; `before` is the product of the others.
  Matrix4 product(std::size_t first, const Matrix4& before, Moment moment) const;
  Matrix4 keyed_at(std::size_t factor, const Matrix4& before, Moment moment) const;

  std::vector<Factor> factors_;
};

}  // namespace dspm
