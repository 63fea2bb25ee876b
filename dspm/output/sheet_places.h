// Where each frame's image lies on the contact sheet. Variations at several moments: a row a variation, a column a
// moment. Variations of several axes: the last axis's in columns, those of the others in rows. Else one after the
// other.
#pragma once

#include <map>

#include "dspm/math/frames.h"
#include "dspm/output/contact_sheet.h"
#include "dspm/world/job.h"

namespace dspm {

class SheetPlaces {
 public:
  explicit SheetPlaces(const Job& job);

  SheetLayout layout(int width, int height) const;
  /// Counted row by row.
  int of(Frame frame) const { return places_.at(frame); }

 private:
  int columns_ = 0, rows_ = 0;  // 0: as it looks best
  std::map<Frame, int> places_;
};

}  // namespace dspm
