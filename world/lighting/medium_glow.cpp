#include "dspm/world/lighting/medium_glow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "dspm/base/math/sampling.h"
#include "dspm/base/math/z_curve.h"
#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

constexpr int kMostCells = 24;     // along the longest axis
constexpr int kPointsOfACell = 2;  // along each axis
// What every cell may give off at least, over the mean of all: a few points do not see everything.
constexpr float kLeastGlow = 0.05f;

Vec3 point_in(const Bounds3& box, float x, float y, float z) {
  const Vec3 size = box.extent();
  return box.low + Vec3{x * size.x, y * size.y, z * size.z};
}

float volume(const Bounds3& box) {
  const Vec3 size = box.extent();
  return size.x * size.y * size.z;
}

}  // namespace

MediumGlow::MediumGlow(std::shared_ptr<const Medium> medium, const Bounds3& box)
    : medium_(std::move(medium)), cells_(cells_in(box)) {
  set_spectrum(medium_->spectra().emitted);
  float sum = 0;
  for (const Cell& cell : cells_) power_ += 4 * kPi * volume(cell.box) * cell.emitted, sum += luminance(cell.emitted);
  if (!(sum > 0)) return;
  const float least = kLeastGlow * sum / static_cast<float>(cells_.size());
  std::vector<float> weights;
  for (const Cell& cell : cells_) weights.push_back(volume(cell.box) * std::max(least, luminance(cell.emitted)));
  choice_ = std::make_unique<const Distribution1D>(weights);
}

std::vector<MediumGlow::Cell> MediumGlow::cells_in(const Bounds3& box) const {
  const Vec3 size = box.extent();
  const float longest = max_component(size);
  int counts[3];
  for (int axis = 0; axis < 3; ++axis)
    counts[axis] =
        medium_->everywhere() ? 1 : std::clamp(static_cast<int>(kMostCells * size[axis] / longest), 1, kMostCells);
  std::vector<std::pair<AlongZCurve, Bounds3>> boxes;
  for (int z = 0; z < counts[2]; ++z)
    for (int y = 0; y < counts[1]; ++y)
      for (int x = 0; x < counts[0]; ++x) {
        const auto corner = [&](int more) {
          const auto share = [&](int i, int axis) {
            return static_cast<float>(i + more) / static_cast<float>(counts[axis]);
          };
          return point_in(box, share(x, 0), share(y, 1), share(z, 2));
        };
        const Bounds3 cell{corner(0), corner(1)};
        boxes.push_back({{place_along_z_curve(cell.center(), box), static_cast<std::uint32_t>(boxes.size())}, cell});
      }
  std::sort(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Cell> cells(boxes.size());
  parallel_for(static_cast<std::int64_t>(boxes.size()), 1 << 6, [&](std::int64_t i) {
    cells[static_cast<std::size_t>(i)] = cell_of(boxes[static_cast<std::size_t>(i)].second);
  });
  std::erase_if(cells, [](const Cell& cell) { return !cell.may_glow; });
  return cells;
}

MediumGlow::Cell MediumGlow::cell_of(const Bounds3& box) const {
  Cell cell{box, {}, !is_black(medium_->majorant(box))};
  if (!cell.may_glow) return cell;
  const auto middle = [](int i) { return (static_cast<float>(i) + 0.5f) / kPointsOfACell; };
  for (int x = 0; x < kPointsOfACell; ++x)
    for (int y = 0; y < kPointsOfACell; ++y)
      for (int z = 0; z < kPointsOfACell; ++z)
        cell.emitted += medium_->at(point_in(box, middle(x), middle(y), middle(z))).emitted;
  cell.emitted *= 1.f / (kPointsOfACell * kPointsOfACell * kPointsOfACell);
  return cell;
}

/// The second number gives two coordinates: what its first digits leave is uniform, too.
std::optional<Emission> MediumGlow::emit(Vec2 u_position, Vec2 u_direction) const {
  constexpr float kFirstDigits = 1 << 12;
  if (choice_ == nullptr) return std::nullopt;
  const auto [index, probability, rest] = choice_->choose(u_position.x);
  const Bounds3& box = cells_[static_cast<std::size_t>(index)].box;
  const float digits = kFirstDigits * u_position.y;
  const Vec3 p = point_in(box, rest, u_position.y, digits - std::floor(digits));
  const float density = probability / volume(box);
  const Rgb emitted = medium_->at(p).emitted;
  if (is_black(emitted)) return std::nullopt;
  return Emission{{p, uniform_sphere(u_direction)}, emitted * (4 * kPi / density), {density, kUniformSpherePdfW}};
}

}  // namespace dspm
