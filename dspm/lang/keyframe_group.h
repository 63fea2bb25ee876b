// A group of keys: `Keyframe 1 <transforms> Keyframe 10 <transforms> KeyframeEnd`.
#pragma once

#include <optional>
#include <vector>

#include "dspm/lang/motion.h"
#include "dspm/math/frames.h"
#include "dspm/params/errors.h"

namespace dspm {

inline constexpr int kMostFrames = 100'000;  // frames of a file; more is taken for a mistake

class KeyframeGroup {
 public:
  explicit KeyframeGroup(const SourceLocation& where) : where_(where) {}

  /// `frame` counts from 0. Not after the last key: an error, and the key is put behind it.
  void begin_key(Frame frame, Ease ease, const SourceLocation& where, Diagnostics& diagnostics);
  /// A transform of the key begun last.
  void multiply(const TransformOp& op);
  /// A transform that replaces what the key has so far, and what stood before the group.
  void replace(const TransformOp& op);

  /// The motion `before` carried on by this group.
  Motion finish(const Motion& before, Diagnostics& diagnostics);

  const SourceLocation& where() const { return where_; }

 private:
  void check_regular(const KeyedTransform& keyed, Diagnostics& diagnostics) const;

  SourceLocation where_;
  std::vector<TransformKey> keys_;
  std::vector<bool> replaces_;  // by key
};

/// The operation which sets a matrix.
TransformOp matrix_op(const Matrix4& matrix);

/// Can be inverted, and has finite floats.
bool is_regular(const Matrix4& matrix);
/// Its numbers are finite as floats, too.
bool fits_float(const Matrix4& matrix);

}  // namespace dspm
