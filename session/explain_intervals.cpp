#include "dspm/session/explain_intervals.h"

#include <fmt/format.h>

#include <map>

namespace dspm {

std::vector<std::string> explain_intervals(const World& world, const std::vector<FrameList>& intervals) {
  constexpr std::size_t kMostShown = 12;
  std::vector<std::vector<std::string>> pages;  // each begins with which frames it is about
  std::map<std::string, std::size_t> counts;    // by line
  for (const FrameList& interval : intervals) {
    pages.push_back(world.explain(interval));
    for (const std::string& line : pages.back()) ++counts[line];
  }
  if (pages.size() == 1) return pages.front();
  const auto is_common = [&](const std::string& line) { return counts[line] == pages.size(); };
  std::vector<std::string> lines{
      fmt::format("{} intervals are rendered, one after the other. In each of them:", pages.size())};
  for (const std::string& line : pages.front())
    if (is_common(line)) lines.push_back(line);
  for (std::size_t i = 0; i < pages.size() && i < kMostShown; ++i)
    for (const std::string& line : pages[i])
      if (&line == &pages[i].front() || !is_common(line)) lines.push_back(line);
  if (pages.size() > kMostShown) lines.push_back(fmt::format("... and {} more intervals.", pages.size() - kMostShown));
  return lines;
}

}  // namespace dspm
