#include "dspm/cameras/exit_pupil.h"

#include <algorithm>
#include <cmath>

#include "dspm/base/math/rounded.h"

namespace dspm {
namespace {

constexpr int kRings = 16;
constexpr int kCoarse = 32, kFine = 64, kFinest = 512;  // columns of grids
// The plane of the samples touches the rear surface, so rays through its edge cross the plane further out; as in pbrt.
constexpr float kWholeOverRear = 1.5f;

}  // namespace

void ExitPupil::Box::add(const Box& other) {
  left = std::min(left, other.left), right = std::max(right, other.right);
  half_height = std::max(half_height, other.half_height);
}

/// Returns the box of a grid's cells, in the upper half of the box, whose middles let light through, and of one more
/// around them: ends of the pupil lie between the middles.
ExitPupil::Box ExitPupil::found_within(const LensSystem& lens, float film_x, const Box& box, int columns) {
  const int rows = columns / 2;
  const Vec2 cell{(box.right - box.left) / static_cast<float>(columns), box.half_height / static_cast<float>(rows)};
  Box found;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const float x = box.left + (static_cast<float>(column) + 0.5f) * cell.x,
                  y = (static_cast<float>(row) + 0.5f) * cell.y;
      if (lens.from_film({{film_x, 0, 0}, Vec3{x, y, lens.rear_z()} - Vec3{film_x, 0, 0}}))
        found.add({x - 1.5f * cell.x, x + 1.5f * cell.x, y + 1.5f * cell.y});
    }
  return found;
}

/// Searches around the pupil of a place nearby; the result is empty if the pupil may go on beyond what was searched.
ExitPupil::Box ExitPupil::found_beside(const LensSystem& lens, float film_x, const Box& neighbour) {
  const float width = neighbour.right - neighbour.left;
  const Box box{neighbour.left - width / 4, neighbour.right + width / 4, 1.25f * neighbour.half_height};
  const Box found = found_within(lens, film_x, box, kCoarse);
  return found.left < box.left || found.right > box.right || found.half_height > box.half_height ? Box() : found;
}

ExitPupil::Box ExitPupil::found_anywhere(const LensSystem& lens, float film_x, int most_columns) {
  const float reach = kWholeOverRear * lens.rear_aperture();
  Box found;
  for (int columns = kFine; columns <= most_columns && found.empty(); columns *= 2)
    found = found_within(lens, film_x, {-reach, reach, reach}, columns);
  return found;
}

/// `neighbour` is null for the first place. Next to a place that no light reaches there is hardly one that it does.
ExitPupil::Box ExitPupil::bound(const LensSystem& lens, float film_x, const Box* neighbour) {
  const bool beside_none = neighbour != nullptr && neighbour->empty();
  Box found = neighbour != nullptr && !beside_none ? found_beside(lens, film_x, *neighbour) : Box();
  if (found.empty()) {
    found = found_anywhere(lens, film_x, beside_none ? kFine : kFinest);
    if (!found.empty()) found = found_within(lens, film_x, found, kFine);
  }
  return found.empty() ? found : found_within(lens, film_x, found, kFine);
}

ExitPupil::ExitPupil(const LensSystem& shaped, float film_radius)
    : rear_z_(shaped.rear_z()), ring_width_(film_radius / kRings) {
  const LensSystem lens = shaped.with_round_stop();
  Box inner = bound(lens, 0, nullptr);
  for (int i = 1; i <= kRings; ++i) {
    const Box outer = bound(lens, static_cast<float>(i) * ring_width_, &inner);
    rings_.push_back(inner);
    rings_.back().add(outer);
    inner = outer;
  }
}

std::optional<ExitPupil::Sample> ExitPupil::sample(Vec2 film, Vec2 u) const {
  const float radius = rounded::hypot(film.x, film.y);
  const auto ring = static_cast<std::size_t>(std::min(radius / ring_width_, static_cast<float>(kRings - 1)));
  const Box& box = rings_[ring];
  if (box.empty()) return std::nullopt;
  const float x = std::lerp(box.left, box.right, u.x), y = box.half_height * (2 * u.y - 1);
  const Vec2 along = radius > 0 ? film * (1 / radius) : Vec2{1, 0};
  return Sample{{along.x * x - along.y * y, along.y * x + along.x * y, rear_z_},
                (box.right - box.left) * 2 * box.half_height};
}

}  // namespace dspm
