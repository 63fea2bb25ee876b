#include "bench/report/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace dspm {
namespace {

constexpr std::string_view kBegin = "<!-- figures: ", kBeginEnd = " -->", kEnd = "<!-- end -->";

/// A block's name and the range of its content, from after the first mark to the second.
struct Block {
  std::string_view name;
  std::size_t begin, end;
};

std::vector<Block> blocks(std::string_view document) {
  std::vector<Block> found;
  for (std::size_t at = 0; (at = document.find(kBegin, at)) != document.npos;) {
    const std::size_t name = at + kBegin.size(), name_end = document.find(kBeginEnd, name);
    const std::size_t content = name_end == document.npos ? name_end : name_end + kBeginEnd.size();
    const std::size_t end = document.find(kEnd, std::min(content, document.size()));
    if (end == document.npos || document.find(kBegin, content) < end)
      throw std::runtime_error(fmt::format("block {} of figures has no end", found.size() + 1));
    const std::string_view word = document.substr(name, name_end - name);
    if (std::any_of(found.begin(), found.end(), [&](const Block& b) { return b.name == word; }))
      throw std::runtime_error(fmt::format("two blocks of figures are named {}", word));
    found.push_back({word, content, end});
    at = end;
  }
  return found;
}

}  // namespace

std::vector<std::string> block_names(std::string_view document) {
  std::vector<std::string> names;
  for (const Block& block : blocks(document)) names.emplace_back(block.name);
  return names;
}

std::string with_block(std::string_view document, std::string_view name, std::string_view content) {
  for (const Block& block : blocks(document))
    if (block.name == name)
      return fmt::format("{}\n{}\n{}", document.substr(0, block.begin), content, document.substr(block.end));
  throw std::runtime_error(fmt::format("there is no block of figures named {}", name));
}

}  // namespace dspm
