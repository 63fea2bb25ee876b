// Where each frame's image lies on the contact sheet. Variations at several moments: a row per variation, a column per
// moment. Variations of several axes: the last ones in columns, the others in rows. Otherwise one after the other.
#pragma once

#include <map>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/output/contact_sheet.h"
#include "dspm/session/job/job.h"

namespace dspm {

class SheetPlaces {
 public:
  explicit SheetPlaces(const Job& job, std::size_t axes_in_columns = 1);
  /// With the last axis in columns or, if that makes pages too narrow for images of width x height pixels, more of them.
  static SheetPlaces suited(const Job& job, int width, int height, const SheetStyle& style = {});

  SheetLayout layout(int width, int height, const SheetStyle& style = {}) const;
  /// Returns the frame's place, counted row by row.
  int of(FileFrame frame) const { return places_.at(frame); }
  /// Returns the columns of a table; 0 if the frames lie one after the other.
  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  int columns_ = 0, rows_ = 0;      // 0: as SheetLayout chooses
  int inner_ = 1;                   // columns of the axes after the first one in columns
  std::vector<int> together_ = {};  // rows that differ along the last axes only, the last one first
  std::map<FileFrame, int> places_;
};

}  // namespace dspm
