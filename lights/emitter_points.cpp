#include "dspm/lights/emitter_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "dspm/base/system/parallel.h"

namespace dspm {
namespace {

// If a transform stretches a curved primitive, its area is the mean over a grid of samples.
float world_area(const PlacedShape& placed, int primitive) {
  const float area = placed.shape->area(primitive);
  if (!(area > 0)) return 0;
  if (!placed.in_object_space()) return area;
  const int n = placed.shape->triangles() ? 1 : 16;
  double sum = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vec2 u{(static_cast<float>(x) + 0.5f) / static_cast<float>(n),
                   (static_cast<float>(y) + 0.5f) / static_cast<float>(n)};
      sum += 1 / static_cast<double>(placed.sample_area(primitive, u).pdf_a);
    }
  return static_cast<float>(sum / (n * n));
}

// Cells of all primitives together, along a side of one primitive's table, and samples along a side of a cell. Few
// enough that random numbers of 24 bits choose even the darkest.
constexpr int kMostCells = 16384, kMostAlongSide = 64, kSamplesAlongCell = 4;
constexpr int kCellsAtOnce = 256;  // at least, by one thread
// The share of its mean that the darkest cell keeps: what the samples of a cell missed is still found.
constexpr float kLeastShare = 0.2f;

float part(int i, float within, int of) { return (static_cast<float>(i) + within) / static_cast<float>(of); }

}  // namespace

EmitterPoints::EmitterPoints(const PlacedShape& placed, Brightness brightness, Measured when, bool two_sided)
    : placed_(placed),
      brightness_(std::move(brightness)),
      two_sided_(two_sided),
      areas_(static_cast<std::size_t>(placed.shape->primitive_count())) {
  for (std::size_t i = 0; i < areas_.size(); ++i) areas_[i] = world_area(placed, static_cast<int>(i));
  area_ = std::accumulate(areas_.begin(), areas_.end(), 0.0);
  if (!brightness_) {
    total_ = Rgb(tables().primitives->total());
  } else if (when == Measured::deferred) {
    total_ = total_of(measure(1, Threads::all));
  } else {
    const std::vector<std::vector<Rgb>> cells = measure(kSamplesAlongCell, Threads::all);
    total_ = total_of(cells);
    std::call_once(made_, [&] { make_tables(cells); });
  }
}

/// A thread that waited within a loop of its own could be given a path that waits for the tables, so there is none.
const EmitterPoints::Tables& EmitterPoints::tables() const {
  std::call_once(made_, [&] {
    if (brightness_)
      make_tables(measure(kSamplesAlongCell, Threads::this_one));
    else
      choose_by(areas_);
  });
  return tables_;
}

int EmitterPoints::cells_along_side() const {
  const double cells = std::sqrt(kMostCells / static_cast<double>(areas_.size()));
  return std::clamp(static_cast<int>(cells), 1, kMostAlongSide);
}

std::vector<std::vector<Rgb>> EmitterPoints::measure(int samples_along_cell, Threads threads) const {
  const int side = cells_along_side();
  std::vector<std::vector<Rgb>> all(areas_.size());
  const auto count = static_cast<std::int64_t>(areas_.size());
  const auto take = [&](std::int64_t p) {
    all[static_cast<std::size_t>(p)] = brightness_of_cells(static_cast<int>(p), samples_along_cell);
  };
  if (threads == Threads::all)
    parallel_for(count, std::max(1, kCellsAtOnce / (side * side)), take);
  else
    for (std::int64_t p = 0; p < count; ++p) take(p);
  return all;
}

Rgb EmitterPoints::total_of(const std::vector<std::vector<Rgb>>& cells) const {
  Rgb total;
  for (std::size_t p = 0; p < areas_.size(); ++p)
    for (const Rgb& cell : cells[p]) total += cell * (areas_[p] / static_cast<float>(cells[p].size()));
  return total;
}

void EmitterPoints::make_tables(const std::vector<std::vector<Rgb>>& all) const {
  const int side = cells_along_side();
  double area = 0, luminous = 0;
  for (std::size_t p = 0; p < areas_.size(); ++p) {
    const float share = areas_[p] / static_cast<float>(side * side);
    for (const Rgb& cell : all[p])
      area += static_cast<double>(share), luminous += static_cast<double>(luminance(cell) * share);
  }
  std::vector<float> weights = areas_;
  const float least = area > 0 ? kLeastShare * static_cast<float>(luminous / area) : 0.f;
  // Without the way back from a point to its numbers, its density in a table would not be known.
  const auto largest = static_cast<int>(std::max_element(areas_.begin(), areas_.end()) - areas_.begin());
  const bool has_numbers =
      placed_.area_numbers(largest, placed_.sample_area(largest, {0.5f, 0.5f}).point.p).has_value();
  // If all is dark it is uniform: degenerate primitives must not be chosen.
  for (std::size_t p = 0; p < areas_.size() && luminous > 0; ++p) {
    std::vector<float> rows;
    std::vector<Distribution1D> columns;
    for (int y = 0; y < side; ++y) {
      std::vector<float> row;
      for (int x = 0; x < side; ++x)
        row.push_back(std::max(least, luminance(all[p][static_cast<std::size_t>(y * side + x)])));
      columns.emplace_back(row);
      rows.push_back(columns.back().total());
    }
    Cells table{Distribution1D(rows), std::move(columns)};
    weights[p] = areas_[p] * table.rows.total() / static_cast<float>(side * side);
    if (has_numbers) tables_.cells.push_back(std::move(table));
  }
  choose_by(weights);
}

/// Returns the mean over samples of each cell, row by row.
std::vector<Rgb> EmitterPoints::brightness_of_cells(int primitive, int samples_along_cell) const {
  const int side = cells_along_side(), n = side * samples_along_cell;
  std::vector<Rgb> cells(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vec2 uv = placed_.shape->sample_area(primitive, {part(x, 0.5f, n), part(y, 0.5f, n)});
      const int cell = y / samples_along_cell * side + x / samples_along_cell;
      cells[static_cast<std::size_t>(cell)] += brightness_(placed_.surface_point(primitive, uv));
    }
  for (Rgb& cell : cells) cell = cell / static_cast<float>(samples_along_cell * samples_along_cell);
  return cells;
}

void EmitterPoints::choose_by(std::span<const float> weights) const {
  tables_.primitives.emplace(weights);
  tables_.sight.emplace(placed_, weights, two_sided_);
}

EmitterPoints::Start EmitterPoints::sample(Vec2 u) const {
  const auto [primitive, probability, rest] = tables().primitives->choose(u.x);
  return point_of(primitive, probability, {rest, u.y});
}

EmitterPoints::Start EmitterPoints::point_of(int primitive, float probability, Vec2 u) const {
  const Cells* cells = cells_of(primitive);
  if (cells == nullptr) {
    Start s{placed_.sample_area(primitive, u), primitive};
    s.pdf_a *= probability;
    return s;
  }
  const Distribution1D::Choice row = cells->rows.choose(u.y);
  const Distribution1D& columns = cells->columns[static_cast<std::size_t>(row.index)];
  const Distribution1D::Choice column = columns.choose(u.x);
  const int side = cells->rows.size();
  Start s{placed_.sample_area(primitive, {part(column.index, column.rest, side), part(row.index, row.rest, side)}),
          primitive};
  s.pdf_a *= probability * row.probability * column.probability * static_cast<float>(side * side);
  return s;
}

float EmitterPoints::pdf_a(int primitive, const Vec3& p, const Vec3& ng) const {
  return pdf_a_of(primitive, tables().primitives->probability(primitive), p, ng);
}

float EmitterPoints::pdf_a_of(int primitive, float probability, const Vec3& p, const Vec3& ng) const {
  const float uniform = probability * placed_.pdf_a(primitive, ng);
  const Cells* cells = cells_of(primitive);
  const auto u = cells == nullptr ? std::nullopt : placed_.area_numbers(primitive, p);
  if (!u) return uniform;
  const int side = cells->rows.size();
  const auto cell = [&](float x) { return std::clamp(static_cast<int>(x * static_cast<float>(side)), 0, side - 1); };
  const int row = cell(u->y);
  return uniform * cells->rows.probability(row) *
         cells->columns[static_cast<std::size_t>(row)].probability(cell(u->x)) * static_cast<float>(side * side);
}

// A density by area times distance^2 / cos is one by solid angle.
EmitterPoints::Seen EmitterPoints::sample_seen(const Vec3& from, Vec2 u) const {
  const EmitterSight& sight = *tables().sight;
  const auto [primitive, probability, rest] = sight.choose(from, u.x);
  if (cells_of(primitive) == nullptr)
    if (const auto seen = sight.sample(from, primitive, {rest, u.y}))
      return {seen->point, primitive, probability * seen->pdf_w};
  const Start start = point_of(primitive, probability, {rest, u.y});
  const Vec3 d = start.point.p - from;
  return {start.point, primitive, start.pdf_a * length2(d) * length(d) / std::abs(dot(start.point.ng, d))};
}

float EmitterPoints::seen_pdf_w(const Vec3& from, int primitive, const Vec3& p, const Vec3& ng) const {
  const EmitterSight& sight = *tables().sight;
  const float probability = sight.probability(from, primitive);
  if (cells_of(primitive) == nullptr)
    if (const auto pdf_w = sight.pdf_w(from, primitive)) return probability * *pdf_w;
  const Vec3 d = p - from;
  return pdf_a_of(primitive, probability, p, ng) * length2(d) * length(d) / std::abs(dot(ng, d));
}

std::optional<Vec2> EmitterPoints::numbers(int primitive, const Vec3& p) const {
  const auto u = placed_.area_numbers(primitive, p);
  if (!u) return std::nullopt;
  const Cells* cells = cells_of(primitive);
  if (cells == nullptr) return Vec2{tables().primitives->number(primitive, std::clamp(u->x, 0.f, 1.f)), u->y};
  const auto number = [](const Distribution1D& distribution, float x, int& index) {
    const float scaled = std::clamp(x, 0.f, 1.f) * static_cast<float>(distribution.size());
    index = std::min(static_cast<int>(scaled), distribution.size() - 1);
    return distribution.number(index, scaled - static_cast<float>(index));
  };
  int row = 0, column = 0;
  const float y = number(cells->rows, u->y, row);
  const float x = number(cells->columns[static_cast<std::size_t>(row)], u->x, column);
  return Vec2{tables().primitives->number(primitive, x), y};
}

}  // namespace dspm
