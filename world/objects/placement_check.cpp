#include "dspm/world/objects/placement_check.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "dspm/base/math/moments.h"
#include "dspm/base/math/vanishing.h"
#include "dspm/world/objects/in_frame.h"

namespace dspm {

bool is_sound(const Matrix4& matrix) {
  for (const auto& row : matrix.m)
    for (const double v : row)
      if (!(std::abs(v) <= double{std::numeric_limits<float>::max()})) return false;
  return matrix.is_affine() && matrix.inverse();
}

void report_singular(const std::string& subject, const std::string& frame, const SourceLocation& where,
                     Diagnostics& diagnostics) {
  diagnostics.error(where, fmt::format("the transform of {} is singular{}", subject, frame),
                    "keys that mirror it, or that are far apart in scale, have nothing usable between them");
}

void leave_out_unplaced(Timeline<Matrix4>& matrices, const FileFrames& frames, const std::string& subject,
                        const SourceLocation& where, Diagnostics& diagnostics) {
  enum class Fate { placed, hidden, wrong };
  std::vector<Fate> fates;
  for (const Matrix4& matrix : matrices.states)
    fates.push_back(vanishes(matrix) ? Fate::hidden : is_sound(matrix) ? Fate::placed : Fate::wrong);
  int hidden = 0;
  bool is_reported = false;
  for (FileFrame f(0); f.index() < frames.count(); ++f) {
    int& state = matrices.state_of[f.slot()];
    if (state < 0 || fates[static_cast<std::size_t>(state)] == Fate::placed) continue;
    const bool hides = fates[static_cast<std::size_t>(state)] == Fate::hidden;
    if (hides) ++hidden;
    if (!hides && !is_reported) report_singular(subject, in_frame(frames, f), where, diagnostics), is_reported = true;
    state = -1;
  }
  if (hidden == 0) return;
  const std::string note = fmt::format("a scale of 0 hides {} in {} of {} frames", subject, hidden, frames.count());
  const auto& before = diagnostics.all();  // an instance has many shapes
  if (before.empty() || before.back().message != note || before.back().where.line != where.line)
    diagnostics.note(where, note);
}

}  // namespace dspm
