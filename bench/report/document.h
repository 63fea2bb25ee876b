// A Markdown document whose figures a program writes and whose prose people write. The program's text lies between
// `<!-- figures: NAME -->` and the next `<!-- end -->`; the rest stays as it is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dspm {

/// The names of the blocks, in order. Throws std::runtime_error if a block has no end or two have the same name.
std::vector<std::string> block_names(std::string_view document);

/// The document with other content in the block; throws if there is no such block.
std::string with_block(std::string_view document, std::string_view name, std::string_view content);

}  // namespace dspm
