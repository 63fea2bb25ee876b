// A group of keys: `Keyframe 1 <transforms> Keyframe 10 <transforms> KeyframeEnd`.
#pragma once

#include <optional>
#include <vector>

#include "dspm/lang/motion.h"
#include "dspm/math/frames.h"
#include "dspm/params/errors.h"

namespace dspm {

inline constexpr int kMostFrames = 100'000;  // frames of a file; more are taken for a mistake

class KeyframeGroup {
 public:
  explicit KeyframeGroup(const SourceLocation& where) : where_(where) {}

  /// If `moment` is not after the last key: an error, and the key is put a frame after it.
  void begin_key(Moment moment, Ease ease, const SourceLocation& where, Diagnostics& diagnostics);
  /// Adds a transform to the last key.
  void multiply(const TransformOp& op);
  /// Replaces the last key's transforms so far, and those before the group.
  void replace(const TransformOp& op);

  /// The motion `before`, continued by this group.
  Motion finish(const Motion& before, Diagnostics& diagnostics);

  const SourceLocation& where() const { return where_; }

 private:
  void check_regular(const KeyedTransform& keyed, Diagnostics& diagnostics) const;

  SourceLocation where_;
  std::vector<TransformKey> keys_;
  std::vector<bool> replaces_;  // by key
};

/// The operation that sets a matrix.
TransformOp matrix_op(const Matrix4& matrix);

/// Invertible, and its numbers are finite as floats.
bool is_regular(const Matrix4& matrix);
/// Its numbers are finite as floats.
bool fits_float(const Matrix4& matrix);

}  // namespace dspm
