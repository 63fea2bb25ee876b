// Where each frame's image lies on the contact sheet. Variations at several moments: a row per variation, a column per
// moment. Variations of several axes: the last axis in columns, the others in rows. Otherwise one after the other.
#pragma once

#include <map>

#include "dspm/math/frames.h"
#include "dspm/output/contact_sheet.h"
#include "dspm/world/job.h"

namespace dspm {

class SheetPlaces {
 public:
  explicit SheetPlaces(const Job& job);

  SheetLayout layout(int width, int height, const SheetStyle& style = {}) const;
  /// Counted row by row.
  int of(FileFrame frame) const { return places_.at(frame); }
  /// Of a table; 0: the frames lie one after the other.
  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  int columns_ = 0, rows_ = 0;  // 0: as SheetLayout chooses
  std::map<FileFrame, int> places_;
};

}  // namespace dspm
