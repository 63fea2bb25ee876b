#include "dspm/output/sheet_places.h"

#include <functional>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

using Key = std::vector<int>;

/// The keys that decide a frame's row and column.
std::pair<Key, Key> row_and_column(const Job& job, FileFrame frame, std::span<const std::size_t> axes_in_columns) {
  const FileFrames& file = job.description->frames;
  Key row = file.combinations()[file.combination_of(frame)].choices, column;
  if (axes_in_columns.empty()) return {row, {file.moment_index(frame)}};
  for (const std::size_t axis : axes_in_columns) column.push_back(std::exchange(row[axis], 0));
  return {row, column};
}

/// Numbers the keys from 0 in ascending order.
std::map<Key, int> numbered(const std::set<Key>& keys) {
  std::map<Key, int> numbers;
  for (const Key& key : keys) numbers.emplace(key, static_cast<int>(numbers.size()));
  return numbers;
}

/// The axes along which the job's frames differ, and how many choices of each they have.
struct UsedAxes {
  std::vector<std::size_t> axes;
  std::vector<int> choices;
};

UsedAxes used_axes(const Job& job) {
  UsedAxes used;
  for (std::size_t axis = 0; axis < job.description->axes.size(); ++axis) {
    std::set<int> choices;
    for (const FileFrame frame : job.frames) choices.insert(job.description->frames.choice(frame, axis));
    if (choices.size() < 2) continue;
    used.axes.push_back(axis), used.choices.push_back(static_cast<int>(choices.size()));
  }
  return used;
}

}  // namespace

SheetPlaces::SheetPlaces(const Job& job, std::size_t axes_in_columns) {
  const FileFrames& file = job.description->frames;
  std::set<std::size_t> variations;
  std::set<int> moments;
  for (const FileFrame frame : job.frames)
    variations.insert(file.combination_of(frame)), moments.insert(file.moment_index(frame));
  const auto [axes, choices] = used_axes(job);

  const bool moments_in_columns = moments.size() > 1;
  if (variations.size() < 2 || (!moments_in_columns && axes.size() < 2)) {
    for (const FileFrame frame : job.frames) places_.emplace(frame, static_cast<int>(places_.size()));
    return;
  }
  const std::size_t across = moments_in_columns ? 0 : axes_in_columns, down = axes.size() - across;
  const std::span<const std::size_t> in_columns = std::span(axes).subspan(down);
  std::set<Key> row_keys, column_keys;
  for (const FileFrame frame : job.frames) {
    const auto [row, column] = row_and_column(job, frame, in_columns);
    row_keys.insert(row), column_keys.insert(column);
  }
  const std::map<Key, int> rows = numbered(row_keys), columns = numbered(column_keys);
  rows_ = static_cast<int>(rows.size()), columns_ = static_cast<int>(columns.size());
  for (const FileFrame frame : job.frames) {
    const auto [row, column] = row_and_column(job, frame, in_columns);
    places_.emplace(frame, rows.at(row) * columns_ + columns.at(column));
  }
  const auto product = [&counts = choices](std::size_t from, std::size_t to) {
    return std::accumulate(counts.begin() + static_cast<long>(from), counts.begin() + static_cast<long>(to), 1,
                           std::multiplies<>());
  };
  if (across > 1 && columns_ == product(down, axes.size())) inner_ = product(down + 1, axes.size());
  if (rows_ != product(0, down)) return;  // some are left out
  for (std::size_t first = down; first-- > 0;) together_.push_back(product(first, down));
}

SheetPlaces SheetPlaces::suited(const Job& job, int width, int height, const SheetStyle& style) {
  SheetPlaces best(job);
  const std::size_t axes = used_axes(job).axes.size();
  // Of moments, or one after the other: there is no choice.
  if (best.columns_ == 0 || SheetPlaces(job, axes).rows_ != 1) return best;
  double least = best.layout(width, height, style).unsuited();
  for (std::size_t across = 2; across <= axes; ++across) {
    if (style.columns > 0 ? best.columns_ >= style.columns : least < kUnsuited) break;
    SheetPlaces other(job, across);
    const double unsuited = other.layout(width, height, style).unsuited();
    if (style.columns == 0 && unsuited >= least) continue;
    best = std::move(other), least = unsuited;
  }
  return best;
}

SheetLayout SheetPlaces::layout(int width, int height, const SheetStyle& style) const {
  if (columns_ == 0) return {static_cast<int>(places_.size()), width, height, style};
  return {SheetTable{columns_, rows_, inner_, together_}, width, height, style};
}

}  // namespace dspm
