#include "dspm/output/sheet_places.h"

#include <set>
#include <utility>
#include <vector>

#include "dspm/math/frames.h"

namespace dspm {
namespace {

using Key = std::vector<int>;

/// The keys that decide a frame's row and column.
std::pair<Key, Key> row_and_column(const Job& job, FileFrame frame, bool moments_in_columns, std::size_t last_axis) {
  const FileFrames& file = job.description->frames;
  Key row = file.combinations()[file.combination_of(frame)].choices;
  if (moments_in_columns) return {row, {file.moment_index(frame)}};
  const int column = std::exchange(row[last_axis], 0);
  return {row, {column}};
}

/// Numbers from 0 in ascending order of the keys.
std::map<Key, int> numbered(const std::set<Key>& keys) {
  std::map<Key, int> numbers;
  for (const Key& key : keys) numbers.emplace(key, static_cast<int>(numbers.size()));
  return numbers;
}

}  // namespace

SheetPlaces::SheetPlaces(const Job& job) {
  const FileFrames& file = job.description->frames;
  std::set<std::size_t> variations;
  std::set<int> moments;
  std::vector<std::set<int>> choices(job.description->axes.size());
  for (const FileFrame frame : job.frames) {
    variations.insert(file.combination_of(frame));
    moments.insert(file.moment_index(frame));
    for (std::size_t axis = 0; axis < choices.size(); ++axis) choices[axis].insert(file.choice(frame, axis));
  }
  std::vector<std::size_t> axes;  // along which the job's frames differ
  for (std::size_t axis = 0; axis < choices.size(); ++axis)
    if (choices[axis].size() > 1) axes.push_back(axis);

  const bool moments_in_columns = moments.size() > 1;
  if (variations.size() < 2 || (!moments_in_columns && axes.size() < 2)) {
    for (const FileFrame frame : job.frames) places_.emplace(frame, static_cast<int>(places_.size()));
    return;
  }
  std::set<Key> row_keys, column_keys;
  for (const FileFrame frame : job.frames) {
    const auto [row, column] = row_and_column(job, frame, moments_in_columns, axes.back());
    row_keys.insert(row), column_keys.insert(column);
  }
  const std::map<Key, int> rows = numbered(row_keys), columns = numbered(column_keys);
  rows_ = static_cast<int>(rows.size()), columns_ = static_cast<int>(columns.size());
  for (const FileFrame frame : job.frames) {
    const auto [row, column] = row_and_column(job, frame, moments_in_columns, axes.back());
    places_.emplace(frame, rows.at(row) * columns_ + columns.at(column));
  }
}

SheetLayout SheetPlaces::layout(int width, int height, const SheetStyle& style) const {
  if (columns_ == 0) return {static_cast<int>(places_.size()), width, height, style};
  return SheetLayout::table(columns_, rows_, width, height, style);
}

}  // namespace dspm
