// The placement of a thing over time: a product of fixed matrices and keyed transforms.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "dspm/math/frames.h"
#include "dspm/math/transform.h"

namespace dspm {

/// One transform directive with its arguments, so that keys can be interpolated argument by argument.
struct TransformOp {
  enum class Kind { translate, rotate, scale, look_at, matrix };  // matrix: 16 values, column by column
  Kind kind;
  std::array<double, 16> arguments{};

  /// All zeros if the arguments describe no transform (a zero axis, a view without direction).
  Matrix4 matrix() const;
};

enum class Ease { linear, smooth, step };

struct TransformKey {
  Moment moment;
  Ease ease = Ease::linear;  // from this key to the next
  std::vector<TransformOp> ops;
};

/// Between two keys with the same sequence of directives, the arguments are interpolated one by one (matrices as a
/// whole); between others, the products. A matrix or product is interpolated by decomposition into translation,
/// rotation (slerp) and stretch (scale and shear). The pose holds before the first key and after the last.
class KeyedTransform {
 public:
  /// At least one key, moments strictly ascending.
  explicit KeyedTransform(std::vector<TransformKey> keys) : keys_(std::move(keys)) {}
  Matrix4 at(Moment moment) const;
  const std::vector<TransformKey>& keys() const { return keys_; }

 private:
  std::vector<TransformKey> keys_;
};

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
  Matrix4 at(Moment moment) const;
  bool is_keyed() const;
  /// The number of keyed transforms in the product.
  int keyed_count() const;
  /// The motion that undoes this one at every moment.
  Motion inverse() const;
  /// The same product; equal motions that were composed differently need not be.
  friend bool operator==(const Motion&, const Motion&) = default;

 private:
  struct Factor {
    Matrix4 fixed;                                // applied to the left of `keyed`
    std::shared_ptr<const KeyedTransform> keyed;  // may be null; shared by everything in a block
    bool inverted = false;                        // means the inverse of `keyed`
    friend bool operator==(const Factor&, const Factor&) = default;
  };
  std::vector<Factor> factors_;
};

}  // namespace dspm
