// A table in Markdown, row by row.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace dspm {

class Table {
 public:
  explicit Table(const std::vector<std::string>& head) {
    row(head);
    row(std::vector<std::string>(head.size(), "---"));
  }

  void row(const std::vector<std::string>& cells) { text_ += fmt::format("| {} |\n", fmt::join(cells, " | ")); }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Figures as tables show them; a missing ratio (0) is empty.
inline std::string seconds_cell(double seconds) { return fmt::format("{:.3f}", seconds); }
inline std::string ratio_cell(double ratio) { return ratio > 0 ? fmt::format("{:.2f}", ratio) : ""; }
inline std::string percent_cell(double share) { return fmt::format("{:.1f}%", 100 * share); }
inline std::string megabytes_cell(double bytes) { return fmt::format("{:.0f}", bytes / 1e6); }

}  // namespace dspm
