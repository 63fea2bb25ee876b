// A transform with keys: poses at moments, and how it goes from one to the next.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/transform.h"
#include "dspm/base/params/errors.h"
#include "dspm/lang/cubic_way.h"

namespace dspm {

class Motion;

/// What a LookAt names instead of three numbers; the same for all that name it at one place of the text.
struct NamedPlace {
  std::string name;
  SourceLocation where;
  /// Its origin is the place. Null until the whole scene has been read.
  std::shared_ptr<const Motion> world_from_place = nullptr;
};

/// One transform directive with its arguments, so that keys can be interpolated argument by argument.
struct TransformOp {
  enum class Kind { translate, rotate, scale, look_at, matrix };  // matrix: 16 values, column by column
  Kind kind;
  std::array<double, 16> arguments{};
  /// Where eye and target of a LookAt are; null: as its arguments say.
  std::array<std::shared_ptr<NamedPlace>, 2> places = {};
  bool places_things = false;  // a LookAt that maps to the world from what stands at the eye and faces the target

  bool is_aimed() const { return places[0] || places[1]; }
  /// All zeros if the arguments describe no transform (a zero axis, a view without direction).
  Matrix4 matrix() const;
};

/// Returns how many arguments a directive of that kind has.
std::size_t argument_count(TransformOp::Kind kind);

enum class Ease { linear, smooth, step, cubic };
enum class After { hold, repeat, offset };  // of the last key

struct TransformKey {
  Moment moment;
  std::optional<Ease> ease;  // from this key to the next; none: as is usual
  std::vector<TransformOp> ops;
  int turns = 0;  // full turns more on the way to the next
  /// How the arguments of all ops change per frame, before and after this key; empty: as the keys around it say.
  std::vector<double> tangent_in = {}, tangent_out = {};
};

/// The operation that sets a matrix.
TransformOp matrix_op(const Matrix4& matrix);
bool same_sequence(const std::vector<TransformOp>& a, const std::vector<TransformOp>& b);

/// Between two keys with the same sequence of directives, the arguments are interpolated one by one (matrices as a
/// whole); between others, the products. A matrix or product is interpolated by decomposition into translation,
/// rotation and stretch. Cubic ways through keys go by arguments if all keys have the same sequence. The pose holds
/// before the first key.
class KeyedTransform {
 public:
  /// At least one key, moments strictly ascending; with a LookAt that names something, all of the same sequence.
  explicit KeyedTransform(std::vector<TransformKey> keys, After after = After::hold, Ease usual = Ease::linear);

  /// `from_world`: to the space in which its LookAts stand; only matters if they name something.
  Matrix4 at(Moment moment, const Matrix4& from_world = {}) const;
  const std::vector<TransformKey>& keys() const { return keys_; }
  After after() const { return after_; }
  /// How the key is left.
  Ease ease(std::size_t key) const { return keys_[key].ease.value_or(usual_); }
  /// The same for a camera: it does not stop at each of three and more keys, and a LookAt maps from the world.
  KeyedTransform of_camera() const;
  bool goes_by_arguments() const { return goes_by_arguments_; }
  bool is_aimed() const { return is_aimed_; }
  bool places_things() const { return places_things_; }

 private:
  struct Place {  // between two keys, or at one
    std::size_t key;
    double t;  // from 0 at this key to 1 at the next
    std::uint64_t cycles;
  };

  Place place_of(Moment moment) const;
  Matrix4 at_by_arguments(const Place& place, Moment moment, Matrix4 from_world) const;
  Matrix4 at_by_products(const Place& place) const;
  /// Of the ops at that place in all keys, as `op_of` gives them by key.
  template <class OpOf>
  TransformOp between(const Place& place, std::size_t op, OpOf&& op_of) const;
  template <class OpOf>
  TransformOp on_cubic(const Place& place, std::size_t op, OpOf&& op_of) const;
  Matrix4 on_cubic_poses(const Place& place, const std::vector<Numbers>& poses) const;
  CubicRun run_around(std::size_t key) const;
  std::optional<double> tangent(std::size_t key, std::size_t op, std::size_t argument, bool leaves) const;

  std::vector<TransformKey> keys_;
  After after_;
  Ease usual_;
  bool goes_by_arguments_;  // all keys have the same sequence
  bool is_cubic_;           // all the way
  bool is_aimed_ = false, places_things_ = false;
  std::vector<std::vector<Numbers>> poses_;  // of cubic ways, by op and key: of matrices; by products, of one op
};

}  // namespace dspm
