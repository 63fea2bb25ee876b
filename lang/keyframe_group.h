// A group of keys: `Keyframe 1 <transforms> Keyframe 10 <transforms> KeyframeEnd`.
#pragma once

#include <optional>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/motion.h"

namespace dspm {

inline constexpr int kMostFrames = 100'000;  // frames of a file; more are taken for a mistake

/// A key as its directive says.
struct KeyDirective {
  Moment moment;
  SourceLocation where;
  std::optional<Ease> ease = {};
  int turns = 0;
  std::vector<double> tangent_in = {}, tangent_out = {};
  SourceLocation turns_where = {}, tangent_where = {};
};

class KeyframeGroup {
 public:
  explicit KeyframeGroup(const SourceLocation& where) : where_(where) {}

  /// If it is not after the last key: an error, and the key is put a frame after it.
  void begin_key(KeyDirective key, Diagnostics& diagnostics);
  /// Adds a transform to the last key.
  void multiply(const TransformOp& op);
  /// Replaces the last key's transforms so far, and those before the group.
  void replace(const TransformOp& op);

  /// The motion `before`, continued by this group. Checks that the transforms of these moments have inverses.
  Motion finish(const Motion& before, After after, const MomentInterval& moments, Diagnostics& diagnostics);

  const SourceLocation& where() const { return where_; }

 private:
  struct Key : KeyDirective {
    std::vector<TransformOp> ops = {};
    bool replaces = false;
  };

  void aim_all();
  std::vector<TransformKey> transform_keys() const;
  void check_tangents(const KeyedTransform& keyed, Diagnostics& diagnostics) const;
  void check_turns(const KeyedTransform& keyed, Diagnostics& diagnostics) const;
  void check_names(const KeyedTransform& keyed, Diagnostics& diagnostics) const;
  void check_cycle(const KeyedTransform& keyed, Diagnostics& diagnostics) const;
  void check_regular(const KeyedTransform& keyed, const MomentInterval& moments, Diagnostics& diagnostics) const;

  SourceLocation where_;
  std::vector<Key> keys_;
};

/// Invertible, and its numbers are finite as floats.
bool is_regular(const Matrix4& matrix);
/// Returns whether its numbers are finite as floats.
bool fits_float(const Matrix4& matrix);

}  // namespace dspm
